//! What a report needs of `summary.json`; its other keys are passed over.

use crate::Error;
use crate::report::{FlowWork, LoadNumbers};
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
    pub warnings: Vec<String>,
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
