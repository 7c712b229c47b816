use crate::Error;
use crate::case::Schedule;
use crate::model::{Model, Observer, StepError, StepReport, Stop};
use std::time::{Duration, Instant};

/// What the steps of a run cost.
///
/// ```
/// assert_eq!(lumley::run::Work::default().step_us(), None);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Work {
    /// Steps made.
    pub steps: usize,
    /// Iterations made: Newton's of a piston, those of the linear solver of a flow.
    pub iterations: usize,
    /// Factorisations made, of models whose steps share them.
    pub renewals: usize,
    /// Time spent in the steps.
    pub time: Duration,
}

impl Work {
    /// This work and `other` together.
    #[must_use]
    pub fn and(self, other: &Self) -> Self {
        Self {
            steps: self.steps + other.steps,
            iterations: self.iterations + other.iterations,
            renewals: self.renewals + other.renewals,
            time: self.time + other.time,
        }
    }

    /// Time of one step, in µs; `None` where no step was made.
    pub fn step_us(&self) -> Option<f64> {
        (self.steps > 0).then(|| self.time.as_secs_f64() * 1e6 / self.steps as f64)
    }

    /// Iterations of one step, in the mean; 0 where no step was made.
    pub fn iterations_mean(&self) -> f64 {
        self.iterations as f64 / self.steps.max(1) as f64
    }

    fn step<M: Model>(&mut self, model: &mut M, dt: f64) -> Result<StepReport, StepError> {
        let started = Instant::now();
        let report = model.step(dt)?;
        self.time += started.elapsed();
        self.steps += 1;
        self.iterations += report.iterations;
        self.renewals += report.renewals;
        Ok(report)
    }
}

/// When a run is observed, and by which steps it comes there.
///
/// ```
/// use lumley::case::Schedule;
/// use lumley::run::Stops;
/// let schedule = Schedule::new(5e-4, 0.01, 2.0).expect("whole numbers");
/// assert_eq!((schedule.count(), schedule.steps_to(1)), (201, 20));
/// assert_eq!(schedule.progress(0.5), (50, 200));
/// ```
pub trait Stops {
    /// How many there are, the start among them.
    fn count(&self) -> usize;
    /// When stop `k` is, in s.
    fn time_of(&self, k: usize) -> f64;
    /// Steps from the stop before to stop `k`, where they have a length of their own.
    fn steps_to(&self, k: usize) -> usize;
    /// This length, in s.
    fn step(&self) -> f64;
    /// Whether a checkpoint is made at stop `k`.
    fn keeps(&self, k: usize) -> bool;
    /// How many parts of all are done at `time`, in s.
    fn progress(&self, time: f64) -> (usize, usize);
}

/// A stop at each snapshot, a checkpoint at each stop.
impl Stops for Schedule {
    fn count(&self) -> usize {
        self.snapshots()
    }

    fn time_of(&self, k: usize) -> f64 {
        self.time(k)
    }

    fn steps_to(&self, _: usize) -> usize {
        self.steps_per_snapshot
    }

    fn step(&self) -> f64 {
        self.step
    }

    fn keeps(&self, _: usize) -> bool {
        true
    }

    fn progress(&self, time: f64) -> (usize, usize) {
        (whole_part(time / self.interval), self.intervals)
    }
}

/// The whole number at or below `x`, up to round-off.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a negative or huge number becomes the nearest there is"
)]
pub(super) fn whole_part(x: f64) -> usize {
    (x + 1e-6).floor() as usize
}

/// Runs `model` to the last of `stops`. `done` of them were observed before: with 0 the model is at its start,
/// which `observer` sees first; else it stands at the last of them.
///
/// A model that suggests its steps gets them, shortened so that whole steps lead to the next stop.
///
/// # Errors
/// What the model or the observer says.
pub fn advance<M: Model>(
    model: &mut M,
    stops: &dyn Stops,
    done: usize,
    observer: &mut dyn Observer<M>,
) -> Result<Work, Error> {
    let mut work = Work::default();
    for number in done..stops.count() {
        let time = stops.time_of(number);
        let mut left = if number == 0 { 0 } else { stops.steps_to(number) };
        while left > 0 {
            let dt = match model.suggested_step() {
                None => stops.step(),
                Some(step) => {
                    let remaining = time - model.time();
                    left = steps(remaining, step);
                    remaining / left as f64
                }
            };
            let report = work.step(model, dt)?;
            left -= 1;
            observer.stepped(model, &report, dt)?;
        }
        if stops.keeps(number) {
            model.forget();
        }
        observer.observe(model, Stop { number, time }, &work)?;
    }
    Ok(work)
}

/// How many steps of at most `step` the time `remaining` takes, at least one.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "at least one and, if it is huge, the largest there is"
)]
fn steps(remaining: f64, step: f64) -> usize {
    // What is longer by round-off is no step more.
    (remaining / step * (1.0 - 1e-9)).ceil().max(1.0) as usize
}

#[cfg(test)]
mod tests {
    use super::steps;

    #[test]
    fn whole_steps_lead_to_the_next_snapshot() {
        assert_eq!(steps(1.0, 0.25), 4);
        assert_eq!(steps(1.0 + 1e-12, 0.25), 4);
        assert_eq!(steps(1.0, 0.24), 5);
        assert_eq!(steps(0.1, 3.0), 1);
        assert_eq!(steps(-1e-17, 3.0), 1);
    }
}
