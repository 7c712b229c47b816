//! Running a case: one loop for every model, and the stages from the full-order model to the report.

mod basis;
mod checkpoint;
mod compare;
mod cost;
mod decompose;
mod ground;
mod modes;
mod parallel;
mod pipeline;
mod pod;
mod probes;
mod recorder;
mod reduce;
mod report;
mod rerun;
mod scratch;
mod simulate;
mod transfer;

pub use basis::BasisFile;
pub use ground::grid_product;
pub use modes::FileModes;
pub use pipeline::{Task, run};
pub use pod::{PodInput, decompose_snapshots};
pub use recorder::{Gauge, Plan, Recorder};
pub use report::{read_summary, write as write_report};
pub use rerun::rerun;
pub use simulate::full_order;

use crate::Error;
use crate::case::Schedule;
use crate::model::{Model, Observer, StepReport};
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
    /// Newton iterations made.
    pub iterations: usize,
    /// Time spent in them.
    pub time: Duration,
}

impl Work {
    /// This work and `other` together.
    #[must_use]
    pub fn and(self, other: &Self) -> Self {
        Self {
            steps: self.steps + other.steps,
            iterations: self.iterations + other.iterations,
            time: self.time + other.time,
        }
    }

    /// Time of one step, in µs; `None` where no step was made.
    pub fn step_us(&self) -> Option<f64> {
        (self.steps > 0).then(|| self.time.as_secs_f64() * 1e6 / self.steps as f64)
    }
}

/// Runs `model` to the end of `schedule`. `done` snapshots were observed before: with 0 the model is at its
/// start, which `observer` sees first; else it stands at the last of them.
///
/// # Errors
/// What the model or the observer says.
pub fn advance<M: Model>(
    model: &mut M,
    schedule: &Schedule,
    done: usize,
    observer: &mut dyn Observer<M>,
) -> Result<Work, Error> {
    let mut work = Work::default();
    if done == 0 {
        observer.observe(model, 0, &work)?;
    }
    for snapshot in done.max(1)..=schedule.intervals {
        let started = Instant::now();
        for _ in 0..schedule.steps_per_snapshot {
            let StepReport { iterations, .. } = model.step(schedule.step)?;
            work.iterations += iterations;
        }
        work.time += started.elapsed();
        work.steps += schedule.steps_per_snapshot;
        observer.observe(model, snapshot, &work)?;
    }
    Ok(work)
}
