//! What a report needs of `summary.json`; its other keys are passed over.

use crate::Error;
use crate::report::{
    BodyNumbers, CoordinateNumbers, FlowWork, LoadNumbers, ThinnedModes, TransferNumbers,
};
use crate::summary::SUMMARY;
use lumley_fem::Point;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Numbers {
    fom: FullOrder,
    loads: BTreeMap<String, Loads>,
    pub pressure_difference: Option<f64>,
    pub projection: Projection,
    pub pod: Pod,
    pub pod_every: Option<ThinnedModes>,
    bodies: BTreeMap<String, Body>,
    /// Times and what is asked for at them; null where there is none.
    probes: Vec<BTreeMap<String, Option<f64>>>,
    transfer: Transfer,
    pub warnings: Vec<String>,
}

#[derive(Debug, Default, Deserialize)]
struct Body {
    #[serde(flatten)]
    numbers: BodyNumbers,
    #[serde(default)]
    coordinates: BTreeMap<String, CoordinateNumbers>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct FullOrder {
    steps: usize,
    step_ms: Option<f64>,
    unknowns: usize,
    iterations_mean: Option<f64>,
    renewals: Option<usize>,
    memory_bytes: Option<f64>,
    residuals: Vec<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Loads {
    drag_coefficient_max: Option<f64>,
    drag_coefficient_mean: Option<f64>,
    lift_coefficient_max: Option<f64>,
    lift_coefficient_mean: Option<f64>,
    lift_coefficient_rms: Option<f64>,
    strouhal: Option<f64>,
    frequency: Option<f64>,
    force_mean: Option<Point>,
    periods: usize,
    window: Option<[f64; 2]>,
    cross_check: Option<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Projection {
    pub res_percent: Vec<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Pod {
    pub divergence: Vec<Option<f64>>,
    pub snapshot_divergence: Option<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
struct Transfer {
    finite_element: Option<Errors>,
    inverse_distance: Option<Errors>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Errors {
    l2: Option<f64>,
    max: Option<f64>,
    nodes: Option<f64>,
    ms: Option<f64>,
}

/// Loads of the body at the instants, behind its coordinates.
const INSTANT_LOADS: [&str; 3] = ["fx", "fy", "mg"];

impl Numbers {
    pub(super) fn read(folder: &Path) -> Result<Self, Error> {
        let path = folder.join(SUMMARY);
        let text = super::text(&path)?;
        serde_json::from_str(&text).map_err(|e| Error::Damaged { path, message: e.to_string() })
    }

    /// Names of the boundaries that have loads.
    pub(super) fn boundaries(&self) -> impl Iterator<Item = &str> {
        self.loads.keys().map(String::as_str)
    }

    pub(super) fn of_loads(&self, name: &str) -> LoadNumbers {
        let Some(loads) = self.loads.get(name) else { return LoadNumbers::default() };
        LoadNumbers {
            drag_max: loads.drag_coefficient_max,
            drag_mean: loads.drag_coefficient_mean,
            lift_max: loads.lift_coefficient_max,
            lift_mean: loads.lift_coefficient_mean,
            lift_rms: loads.lift_coefficient_rms,
            strouhal: loads.strouhal,
            frequency: loads.frequency,
            force_mean: loads.force_mean,
            periods: loads.periods,
            window: loads.window,
            cross_check: loads.cross_check,
        }
    }

    pub(super) fn of_body(&self, name: &str) -> BodyNumbers {
        self.bodies.get(name).map(|body| body.numbers.clone()).unwrap_or_default()
    }

    pub(super) fn of_coordinate(&self, body: &str, coordinate: &str) -> CoordinateNumbers {
        let coordinates = self.bodies.get(body).map(|body| &body.coordinates);
        let label = format!("{body}.{coordinate}");
        coordinates.and_then(|all| all.get(&label)).copied().unwrap_or_default()
    }

    /// The table of the instants: times, the coordinates with these `names` and labels in the order of all
    /// `labels`, loads.
    pub(super) fn instants(
        &self,
        names: &BTreeMap<String, String>,
        labels: &[&str],
    ) -> Vec<(String, Vec<f64>)> {
        if self.probes.is_empty() {
            return Vec::new();
        }
        let mut names: Vec<(&String, &String)> = names.iter().collect();
        names.sort_by_key(|(_, label)| labels.iter().position(|known| known == label));
        let names = names.into_iter().map(|(name, _)| name.as_str());
        let columns = std::iter::once("time").chain(names).chain(INSTANT_LOADS);
        let value = |name: &str, row: &BTreeMap<String, Option<f64>>| {
            row.get(name).copied().flatten().unwrap_or(f64::NAN)
        };
        let column = |name: &str| self.probes.iter().map(|row| value(name, row)).collect();
        columns.map(|name| (name.to_owned(), column(name))).collect()
    }

    pub(super) fn transfer(&self) -> Vec<TransferNumbers> {
        let Transfer { finite_element, inverse_distance } = &self.transfer;
        let ways = [
            ("finite-element evaluation", finite_element),
            ("inverse-distance weighting", inverse_distance),
        ];
        let of = |(name, errors): (&str, &Option<Errors>)| {
            let &Errors { l2, max: largest, nodes, ms: milliseconds } = errors.as_ref()?;
            Some(TransferNumbers { name: name.to_owned(), l2, largest, nodes, milliseconds })
        };
        ways.into_iter().filter_map(of).collect()
    }

    pub(super) fn work(&self) -> FlowWork {
        let fom = &self.fom;
        FlowWork {
            unknowns: fom.unknowns,
            steps: fom.steps,
            step_ms: fom.step_ms,
            iterations: fom.iterations_mean,
            renewals: fom.renewals,
            memory: fom.memory_bytes,
        }
    }

    pub(super) fn residuals(&self) -> Vec<f64> {
        self.fom.residuals.clone()
    }
}
