use crate::run::Work;
use serde::{Deserialize, Serialize};

/// The full-order model's work.
///
/// ```
/// assert_eq!(lumley::summary::FullOrder::default().steps, 0);
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FullOrder {
    /// Time steps made.
    pub steps: usize,
    /// Time of one, in µs.
    pub step_us: f64,
    /// Time of one, in ms.
    #[serde(default)]
    pub step_ms: f64,
    /// Unknowns of one.
    pub unknowns: usize,
    /// Iterations per step, in the mean: Newton's of a piston, those of the linear solver of a flow.
    pub iterations_mean: f64,
    /// Factorisations made, of a flow, whose steps share them.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub renewals: Option<usize>,
    /// Most memory that the process had, in bytes, where the system tells and the model is a flow.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub memory_bytes: Option<f64>,
    /// Of a steady flow, the change of the velocity in each iteration over the largest velocity.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub residuals: Vec<f64>,
    /// Coarser models of the same scheme, each cheaper than all that are more accurate.
    pub variants: Vec<Variant>,
}

impl FullOrder {
    /// A model of so many `unknowns` that did this `work`.
    pub fn new(unknowns: usize, work: &Work) -> Self {
        let step_us = work.step_us().unwrap_or_default();
        Self {
            steps: work.steps,
            step_us,
            step_ms: step_us / 1e3,
            unknowns,
            iterations_mean: work.iterations_mean(),
            renewals: None,
            memory_bytes: None,
            residuals: Vec::new(),
            variants: Vec::new(),
        }
    }
}

/// The load on a boundary over the last full periods of the lift, ten or as many as there are, or, without
/// periods, over the later half of the run; a steady flow has the one value. Coefficients `2 F/(rho U² L)` are
/// null without a reference in the case.
///
/// ```
/// assert_eq!(lumley::summary::LoadStatistics::default().strouhal, None);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct LoadStatistics {
    /// Whether the boundary goes round a body.
    pub is_body: bool,
    /// Largest drag coefficient, along x.
    pub drag_coefficient_max: Option<f64>,
    /// Mean drag coefficient.
    pub drag_coefficient_mean: Option<f64>,
    /// Largest lift coefficient, along y.
    pub lift_coefficient_max: Option<f64>,
    /// Mean lift coefficient.
    pub lift_coefficient_mean: Option<f64>,
    /// Root of the mean square of the lift coefficient about its mean.
    pub lift_coefficient_rms: Option<f64>,
    /// f L/U of the lift; null below three full periods.
    pub strouhal: Option<f64>,
    /// Frequency of the lift, in Hz; null below three full periods.
    pub frequency: Option<f64>,
    /// Mean force, in N for each m of span.
    pub force_mean: [f64; 2],
    /// Full periods over which these numbers are taken.
    pub periods: usize,
    /// From when to when, in s.
    pub window: [f64; 2],
    /// How far the surface integral (17) is from the consistent force at the end, over this; null where there
    /// is no force.
    pub cross_check: Option<f64>,
}

/// A model of another resolution.
///
/// ```
/// assert_eq!(lumley::summary::Variant::default().size, 0);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Variant {
    /// Cells of the mesh of a full-order model, modes of a reduced one.
    pub size: usize,
    /// Time step, in s.
    pub step: f64,
    /// Steps to the end.
    pub steps: usize,
    /// Time of one, in µs.
    pub step_us: f64,
    /// Res (32) against the run's own full-order model, in percent.
    pub res_percent: f64,
}

impl Variant {
    /// Time of all steps, in ms.
    pub fn milliseconds(&self) -> f64 {
        self.steps as f64 * self.step_us / 1e3
    }
}
