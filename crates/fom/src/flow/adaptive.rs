use super::{Flow, FlowError, FlowStep};
use crate::TimeScheme;
use serde::{Deserialize, Serialize};

/// Share of the step that would just do.
const SAFETY: f64 = 0.9;
/// How much longer or shorter a step may be than the one before; BDF2 stays within its limit.
const LARGEST_GROWTH: f64 = 1.5;
const LARGEST_CUT: f64 = 0.3;
/// Steps in a row that may be too long because they are the shortest: what a sudden change of the flow takes.
const MOST_FORCED: u32 = 20;
/// A step is made again if its error is this many times too large.
const REFUSED: f64 = 2.0;

/// How long the steps are: so that the new velocity is near the extrapolated one.
///
/// The error that is kept at `tolerance` is [`FlowStep::extrapolation_error`]: it goes with dt² for BDF2, with dt for
/// implicit Euler, and bounds that of the linearisation.
///
/// ```
/// use lumley_fom::{TimeScheme, flow::StepControl};
/// let control = StepControl { tolerance: 1e-3, shortest: 1e-4, longest: 0.1, velocity: 0.0 };
/// assert!((control.next(0.01, 4e-3, TimeScheme::Bdf2) - 0.0045).abs() < 1e-15);
/// assert_eq!(control.next(0.09, 0.0, TimeScheme::Bdf2), 0.1);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StepControl {
    /// Largest distance from the extrapolated velocity, over the largest velocity.
    pub tolerance: f64,
    /// Shortest step, in s.
    pub shortest: f64,
    /// Longest step, in s.
    pub longest: f64,
    /// Velocity that counts as large, in m/s: where the flow is slower all over, as at the beginning of a ramp, errors
    /// are relative to this.
    #[serde(default)]
    pub velocity: f64,
}

impl StepControl {
    /// The step, in s, after one of `dt` with this error.
    pub fn next(&self, dt: f64, error: f64, scheme: TimeScheme) -> f64 {
        let order = if scheme == TimeScheme::Bdf2 { 0.5 } else { 1.0 };
        let factor = SAFETY * (self.tolerance / error.max(f64::MIN_POSITIVE)).powf(order);
        let next = dt * factor.clamp(LARGEST_CUT, LARGEST_GROWTH);
        next.min(self.longest).max(self.shortest)
    }

    /// The error of a step, relative to the larger of the flow's velocity and that which counts.
    fn error(&self, step: &FlowStep) -> f64 {
        if self.velocity > step.largest_velocity {
            step.extrapolation_error * step.largest_velocity / self.velocity
        } else {
            step.extrapolation_error
        }
    }
}

impl Flow {
    /// How long the next adaptive step would be, in s; none before the first where none was suggested.
    pub fn wanted_step(&self) -> Option<f64> {
        self.wanted_step
    }

    /// The first adaptive step shall be so long, in s; else it is the shortest.
    pub fn suggest_step(&mut self, dt: f64) {
        self.wanted_step = Some(dt);
    }

    /// One step towards `end`, in s, no longer than `control` likes, such that the rest is whole steps of its length;
    /// shorter than `control` likes only to meet `end`. A step with too large an error is made again, shorter.
    ///
    /// # Errors
    /// As [`step`](Self::step), and [`FlowError::ShortestStep`] where the shortest step was too long again and again.
    pub fn step_towards(&mut self, end: f64, control: &StepControl) -> Result<FlowStep, FlowError> {
        let mut wanted = self.wanted_step.unwrap_or(control.shortest);
        loop {
            let rest = end - self.time;
            let dt = rest / (rest / wanted * (1.0 - 1e-9)).ceil().max(1.0);
            let step = self.compute(dt)?;
            let error = control.error(&step);
            let next = control.next(dt, error, self.parameters.scheme);
            // The first steps follow an impulsive start, which no extrapolation foresees.
            let fits = self.steps < 2 || error <= REFUSED * control.tolerance;
            let shortest = dt <= control.shortest * (1.0 + 1e-9);
            if !fits && !shortest {
                wanted = next;
                continue;
            }
            let time = self.time + dt;
            self.forced_steps = if fits { 0 } else { self.forced_steps + 1 };
            if self.forced_steps > MOST_FORCED {
                let (shortest, tolerance) = (control.shortest, control.tolerance);
                let error = FlowError::ShortestStep { time, shortest, error, tolerance };
                return Err(self.explain(error));
            }
            let unforeseen = self.steps < 2;
            self.accept(time, dt);
            // A step that was cut to meet `end` says nothing against longer ones.
            let cut = dt < 0.5 * wanted && error <= control.tolerance;
            self.wanted_step = Some(if cut || unforeseen { next.max(wanted) } else { next });
            return Ok(step);
        }
    }
}
