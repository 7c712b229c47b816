//! `summary.json`: every number of the report, under names that others rely on.

mod full_order;

pub use full_order::{FullOrder, LoadStatistics, Variant};

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Name of the file in a run directory.
pub const SUMMARY: &str = "summary.json";

/// The numbers of a run.
///
/// ```
/// use lumley::summary::Summary;
/// let json = serde_json::to_string(&Summary::default())?;
/// assert!(json.contains("\"rom\":[]"));
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Name of the case.
    pub case: String,
    /// Where the run is.
    pub directory: String,
    /// The run whose modes these are, where they are not this run's own.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub basis: Option<String>,
    /// The full-order model; absent for snapshots that lumley did not compute.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub fom: Option<FullOrder>,
    /// The snapshots.
    pub record: Snapshots,
    /// The transfer to the fixed grid.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub transfer: Option<TransferErrors>,
    /// The decomposition on the fixed grid.
    pub pod: Decomposition,
    /// The decomposition in the reference frame, when a reduced model stands on it.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub pod_reference: Option<Decomposition>,
    /// Projection on the first modes.
    pub projection: Projection,
    /// The reduced models, in the order of the case file.
    pub rom: Vec<Reduced>,
    /// The full-order model at the times of the reference table.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub probes: Vec<Probe>,
    /// The loads of a flow on the boundaries, by name.
    #[serde(skip_serializing_if = "BTreeMap::is_empty", default)]
    pub loads: BTreeMap<String, LoadStatistics>,
    /// The pressure at the first of the case's two points less that at the second, at the end, in Pa.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub pressure_difference: Option<f64>,
    /// What the reader should know, in sentences.
    pub warnings: Vec<String>,
}

impl Summary {
    /// The summary as JSON, indented.
    ///
    /// # Panics
    /// Never: it is plain data.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a summary is plain data")
    }
}

/// The snapshots that were decomposed.
///
/// ```
/// assert_eq!(lumley::summary::Snapshots::default().snapshots, 0);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Snapshots {
    /// Number M of snapshots.
    pub snapshots: usize,
    /// Their length n on the fixed grid.
    pub unknowns: usize,
    /// max_t ||u|| in the inner product of the decomposition.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub max_norm: Option<f64>,
}

/// Errors of the two ways to the fixed grid against the full-order field itself: max_t of the L2 norm of
/// the difference over max_t of the norm, in percent.
///
/// ```
/// assert_eq!(lumley::summary::TransferErrors::default().finite_element_percent, 0.0);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct TransferErrors {
    /// Finite-element evaluation.
    pub finite_element_percent: f64,
    /// Inverse-distance weighting.
    pub inverse_distance_percent: f64,
}

/// What POD found.
///
/// ```
/// assert!(lumley::summary::Decomposition::default().eigenvalues.is_empty());
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Decomposition {
    /// The algorithm that was used.
    pub method: String,
    /// Why, where lumley chose it.
    #[serde(skip_serializing_if = "String::is_empty", default)]
    pub reason: String,
    /// Number of modes that the asked share of the energy, or the asked count, takes.
    pub modes: usize,
    /// Passes over the snapshots that it took.
    #[serde(default)]
    pub passes: usize,
    /// Sum of all eigenvalues, and what an approximation left out.
    pub total_energy: f64,
    /// Most that an eigenvalue may be smaller than the exact one; absent where they are exact.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub error_bound: Option<f64>,
    /// Eigenvalues lambda, largest first.
    pub eigenvalues: Vec<f64>,
    /// Singular values of W^(1/2) X: sigma² = M lambda.
    pub singular_values: Vec<f64>,
    /// Each mode's share of the energy, in percent.
    pub energy_percent: Vec<f64>,
    /// Share of the first modes (31), in percent.
    pub cumulative_percent: Vec<f64>,
    /// RMS projection error of the first modes, sqrt(1 - E), in percent.
    pub rms_error_percent: Vec<f64>,
}

/// Res(N) (32) of the projection.
///
/// ```
/// assert!(lumley::summary::Projection::default().res_percent.is_empty());
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Projection {
    /// For N = 1, 2, ..., in percent.
    pub res_percent: Vec<f64>,
}

/// A reduced model for several numbers of modes; the lists run in parallel.
///
/// ```
/// assert!(lumley::summary::Reduced::default().modes.is_empty());
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Reduced {
    /// `printed`, `corrected`, `multiplier`, `penalty` or `mapped`.
    pub projection: String,
    /// beta of a multiplier, in 1/s.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub beta: Option<f64>,
    /// sigma of a penalty, in m/s.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub sigma: Option<f64>,
    /// Its closure.
    pub closure: String,
    /// Whether its modes live in the reference frame.
    pub reference_frame: bool,
    /// Name of the model's folder and of its curves.
    pub label: String,
    /// Numbers of modes N.
    pub modes: Vec<usize>,
    /// Res(N) (32) against the full-order record, in percent; null where it blew up or nothing was
    /// there to compare with.
    pub res_percent: Vec<Option<f64>>,
    /// Time of one step, in µs; null where it blew up.
    pub step_us: Vec<Option<f64>>,
    /// When and why it blew up, where it did.
    pub failure: Vec<Option<Failure>>,
    /// Largest stable step of the explicit scheme, in s; null where none is known.
    pub stable_step: Vec<Option<f64>>,
    /// The number of modes whose trajectory is kept.
    pub shown: Option<usize>,
    /// Against the full-order model at equal accuracy.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub speedup: Option<Speedup>,
}

/// How a reduced model blew up.
///
/// ```
/// assert_eq!(lumley::summary::Failure::default().time, 0.0);
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Failure {
    /// When, in s.
    pub time: f64,
    /// What the model said.
    pub message: String,
}

impl Reduced {
    /// Res with the shown number of modes, in percent.
    pub fn shown_res(&self) -> Option<f64> {
        self.res_percent[self.shown_place()?]
    }

    /// Time of a step with the shown number of modes, in µs.
    pub fn shown_step_us(&self) -> Option<f64> {
        self.step_us[self.shown_place()?]
    }

    /// Why the model with the shown number of modes blew up, if it did.
    pub fn shown_failure(&self) -> Option<&Failure> {
        self.failure[self.shown_place()?].as_ref()
    }

    /// Runs whose step, `step` in s, is longer than is stable, in a sentence for each model that has such.
    pub fn warnings(&self, step: f64) -> Option<String> {
        let runs = self.modes.iter().zip(&self.stable_step);
        let exceeded = runs.filter_map(|(n, stable)| Some((n, stable.filter(|s| step > *s)?)));
        let (modes, stable) = exceeded.min_by(|a, b| a.0.cmp(b.0))?;
        Some(format!(
            "{}: from N = {modes} on, the step {step} s exceeds the stable step {stable:.2e} s: set rom.step \
             shorter or rom.integrator to rosenbrock",
            self.label
        ))
    }

    fn shown_place(&self) -> Option<usize> {
        self.modes.iter().position(|n| Some(*n) == self.shown)
    }
}

/// The reduced model beside the cheapest full-order model that is no less accurate, each with the longest
/// step that keeps its accuracy.
///
/// ```
/// assert_eq!(lumley::summary::Speedup::default().ratio, 0.0);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Speedup {
    /// The reduced model.
    pub reduced: Variant,
    /// The full-order model.
    pub full: Variant,
    /// The full-order model's time for the whole simulated time over the reduced model's.
    pub ratio: f64,
}

/// The full-order model at one time.
///
/// ```
/// assert_eq!(lumley::summary::Probe::default().time, 0.0);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Probe {
    /// In s.
    pub time: f64,
    /// The piston.
    pub body: BodyProbe,
    /// u(0.5, t), in m/s.
    pub velocity_mid: f64,
    /// nu u_x(X-), in m²/s².
    pub traction: f64,
}

/// The piston at one time.
///
/// ```
/// assert_eq!(lumley::summary::BodyProbe::default().position, 0.0);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct BodyProbe {
    /// X, in m.
    pub position: f64,
    /// X', in m/s.
    pub velocity: f64,
}
