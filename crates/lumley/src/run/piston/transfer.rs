use crate::case::PistonCase;
use crate::model::StepError;
use crate::record::{Quantity, Series};
use crate::run::Gauge;
use crate::summary::TransferErrors;
use lumley_fem::transfer::{Transfer, grid_error};
use lumley_fom::Piston;

/// The gauge of what either way to the fixed grid loses: distances in L2(Omega) between the full-order
/// velocity and the grid's, and the velocity's norm.
pub(super) fn errors(case: &PistonCase) -> Gauge<Piston> {
    let (grid, inverse_distance) = (case.grid.clone(), case.inverse_distance);
    let entries = ["finite-element", "inverse-distance", "norm"];
    let entries = entries.map(|name| Quantity::new(name, "m3/2/s")).to_vec();
    Gauge::new("transfer", entries, move |model: &Piston| {
        let mut v = vec![0.0; grid.len()];
        let mut lost = [0.0; 3];
        for (k, way) in [Transfer::FiniteElement {}, inverse_distance].into_iter().enumerate() {
            way.transfer(model, &grid, &mut v).map_err(StepError::from)?;
            let error = grid_error(model, &grid, &v).map_err(StepError::from)?;
            (lost[k], lost[2]) = (error.distance, error.norm);
        }
        Ok(lost.to_vec())
    })
}

/// The largest of the series over the largest norm, in percent.
pub(super) fn summary(series: &Series) -> TransferErrors {
    let largest = |k: usize| series.entry(k).fold(0.0, f64::max);
    let percent = |k: usize| if largest(2) > 0.0 { 100.0 * largest(k) / largest(2) } else { 0.0 };
    TransferErrors::Piston {
        finite_element_percent: percent(0),
        inverse_distance_percent: percent(1),
    }
}
