use super::Variant;
use serde::{Deserialize, Serialize};

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
