//! The numbers of the summary that are taken from what was measured.

use super::columns::Columns;
use super::instruments::{LOADS, PROBES, column};
use super::points::DIFFERENCE;
use super::steady::{CHANGE, RESIDUALS};
use crate::Error;
use crate::case::FlowCase;
use crate::format::csv::read_columns;
use crate::model::FlowModel;
use crate::summary::LoadStatistics;
use lumley_fom::flow::Load;
use lumley_fom::signal::{Periods, Signal};
use std::collections::BTreeMap;
use std::path::Path;

/// The statistics of the loads on every boundary, from `loads.csv` in `folder`.
pub(super) fn loads(
    case: &FlowCase,
    model: &FlowModel,
    folder: &Path,
) -> Result<BTreeMap<String, LoadStatistics>, Error> {
    let table = Columns::read(folder.join(LOADS))?;
    let boundaries = case.mesh.topology().boundaries().iter().zip(model.flow().loads());
    let of = |(boundary, load): (&lumley_fem::Boundary, &Load)| {
        let name = &boundary.name;
        let mut found = LoadStatistics::default();
        if !table.is_empty() {
            let [drag, lift] = ["fx", "fy"].map(|quantity| table.signal(&column(name, quantity)));
            found = statistics(case, &drag?, &lift?);
        }
        found.cross_check = cross_check(model, name, load);
        found.is_body = model.bodies_in_it().any(|body| body == name);
        Ok((name.clone(), found))
    };
    boundaries.map(of).collect()
}

/// Over the last full periods of the lift, or, where it has none, over the later half of the run.
fn statistics(case: &FlowCase, drag: &Signal<'_>, lift: &Signal<'_>) -> LoadStatistics {
    let periods = Periods::of(lift);
    let window = periods.window().unwrap_or(lift.last_half());
    let (d, l) = (drag.statistics(window), lift.statistics(window));
    let coefficients = |drag: f64, lift: f64| {
        let found = case.reference.map(|reference| reference.coefficients([drag, lift]));
        [0, 1].map(|d| found.map(|coefficients| coefficients[d]))
    };
    let [drag_max, lift_max] = coefficients(d.max, l.max);
    let [drag_mean, lift_mean] = coefficients(d.mean, l.mean);
    let [_, lift_rms] = coefficients(d.rms, l.rms);
    let frequency = periods.frequency();
    LoadStatistics {
        drag_coefficient_max: drag_max,
        drag_coefficient_mean: drag_mean,
        lift_coefficient_max: lift_max,
        lift_coefficient_mean: lift_mean,
        lift_coefficient_rms: lift_rms,
        strouhal: case.reference.zip(frequency).map(|(r, f)| f * r.length / r.velocity),
        frequency,
        force_mean: [d.mean, l.mean],
        periods: periods.count(),
        window: [window.start, window.end],
        cross_check: None,
        is_body: false,
    }
}

/// How far the surface integral (17) is from the consistent force, over this.
fn cross_check(model: &FlowModel, name: &str, load: &Load) -> Option<f64> {
    let surface = model.flow().surface_load(name)?;
    let [dx, dy] = [0, 1].map(|d| surface.force[d] - load.force[d]);
    let size = load.force[0].hypot(load.force[1]);
    (size > 0.0).then(|| dx.hypot(dy) / size)
}

/// The last pressure difference in `probes.csv`, in Pa, where it has one.
pub(super) fn pressure_difference(folder: &Path) -> Result<Option<f64>, Error> {
    let path = folder.join(PROBES);
    if !path.exists() {
        return Ok(None);
    }
    let column = read_columns(&path, |header| header == DIFFERENCE)?.pop();
    // In a body there is no pressure.
    Ok(column.and_then(|(_, values)| values.last().copied()).filter(|p| p.is_finite()))
}

/// The changes of the iteration to a steady flow, from `residuals.csv` in `folder` where it is one.
pub(super) fn residuals(folder: &Path) -> Result<Vec<f64>, Error> {
    let path = folder.join(RESIDUALS);
    if !path.exists() {
        return Ok(Vec::new());
    }
    let changes = read_columns(&path, |header| header == CHANGE)?.pop();
    Ok(changes.map_or_else(Vec::new, |(_, values)| values))
}
