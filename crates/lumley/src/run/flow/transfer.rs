//! What either way to the fixed grid loses and costs, on the last state.

use crate::case::RecordChoice;
use crate::model::{FlowModel, StepError};
use crate::summary::{MethodError, TransferErrors};
use lumley_fem::transfer::{PlanarFlow, PlanarTransfer, Transfer};
use lumley_fem::{Point, UniformGrid};
use std::time::{Duration, Instant};

/// The fastest of so many is what a transfer costs; the first takes memory.
const REPEATS: usize = 3;

/// Measures both.
pub(super) fn errors(
    model: &FlowModel,
    RecordChoice { grid, inverse_distance, .. }: &RecordChoice,
) -> Result<TransferErrors, StepError> {
    let (finite_element, exact) = measure(model, grid, Transfer::FiniteElement {})?;
    let (mut inverse_distance, values) = measure(model, grid, *inverse_distance)?;
    let square = |sum: f64, v: f64| sum + v * v;
    let distance = values.iter().zip(&exact).map(|(v, exact)| v - exact).fold(0.0, square);
    inverse_distance.nodes = share(distance, exact.iter().copied().fold(0.0, square)).sqrt();
    Ok(TransferErrors::Flow { finite_element, inverse_distance })
}

/// Error and cost of a method, and the velocities at the nodes.
fn measure(
    model: &FlowModel,
    grid: &UniformGrid,
    method: Transfer,
) -> Result<(MethodError, Vec<f64>), StepError> {
    let mut transfer = PlanarTransfer::new(method, grid.clone(), model.solids())?;
    let (flow, solids) = (model.flow(), model.solid_velocities());
    let solid = |body: usize, point: Point| solids[body].at(point);
    let (mesh, space) = (flow.mesh(), flow.space());
    let velocity = PlanarFlow { mesh, space, velocity: flow.velocity(), solid: &solid };
    let mut values = vec![0.0; 2 * grid.len()];
    let mut fastest = Duration::MAX;
    for _ in 0..REPEATS {
        let started = Instant::now();
        transfer.update(mesh);
        transfer.transfer(velocity, &mut values)?;
        fastest = fastest.min(started.elapsed());
    }
    let error = transfer.error(velocity, &values);
    let found = MethodError {
        l2: share(error.distance, error.norm),
        max: share(error.largest_distance, error.largest),
        nodes: 0.0,
        ms: 1e3 * fastest.as_secs_f64(),
    };
    Ok((found, values))
}

fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}
