use super::checkpoint::{Checkpoint, Progressed};
use super::{Stops, Task, Work, advance};
use crate::directory::Workplace;
use crate::error::{Error, Kept};
use crate::model::{Model, Observer, StepReport, Stop};
use crate::progress::Progress;
use std::time::{Duration, Instant};

/// Least time between two looks at a run.
const REFRESH: Duration = Duration::from_millis(100);

/// What a run writes while it goes.
pub(super) trait Outputs<M: Model>: Observer<M> {
    /// Brings everything to the disk.
    fn flush(&mut self) -> Result<(), Error>;
    /// Lengths of the tables that are cut when the run goes on from here, in bytes.
    fn lengths(&self) -> Vec<u64> {
        Vec::new()
    }
    /// Where the run is, in a few words.
    fn status(&self, model: &M) -> String;
}

/// Runs `model` to the last of `stops` from where it stands, `before`, and returns the work of all sessions.
///
/// A checkpoint is taken at stops that depend on the case alone, whoever is watching and however long the steps
/// take: a solver that forgets its factor then does so at the same steps in every run, and the bits do not depend
/// on when a run was stopped. To the disk it goes when the last one there is older than the task says, when
/// the run is interrupted, and when the model fails.
pub(super) fn simulate<M: Model>(
    model: &mut M,
    stops: &dyn Stops,
    outputs: &mut dyn Outputs<M>,
    before: Option<Progressed>,
    (task, place): (&Task, &Workplace),
    progress: &mut Progress,
) -> Result<Work, Error> {
    let checkpoint = before.is_some().then(|| model.time());
    let before = before.unwrap_or_default();
    let (done, parts) = stops.progress(model.time());
    progress.part(parts, done);
    let now = Instant::now();
    let mut keeper = Keeper {
        outputs,
        stops,
        task,
        place,
        progress,
        shown: now,
        latest: Checkpoint::default(),
        checkpoint,
        unwritten: false,
        written: now,
        before: before.work,
    };
    let _held = task.interrupt.hold();
    let work = advance(model, stops, before.stops, &mut keeper);
    let work = before.work.and(&work.map_err(|error| keeper.stopped(error))?);
    // A run that is stopped in a later stage does not compute this one again.
    keeper.take(model, stops.count(), work)?;
    keeper.write()?;
    Ok(work)
}

/// Observes a run for its outputs, and keeps a checkpoint that matches what is on disk.
struct Keeper<'a, M> {
    outputs: &'a mut dyn Outputs<M>,
    stops: &'a dyn Stops,
    task: &'a Task,
    place: &'a Workplace,
    progress: &'a mut Progress,
    /// When the person was last told.
    shown: Instant,
    /// The last checkpoint of this session.
    latest: Checkpoint,
    /// Simulated time of the last checkpoint, in s.
    checkpoint: Option<f64>,
    /// Whether it is not on the disk yet.
    unwritten: bool,
    /// When one last went there.
    written: Instant,
    /// Work of the sessions before.
    before: Work,
}

impl<M: Model> Keeper<'_, M> {
    fn show(&mut self, model: &M) {
        let (done, _) = self.stops.progress(model.time());
        self.progress.advance(done, &self.outputs.status(model));
        self.shown = Instant::now();
    }

    fn take(&mut self, model: &M, stops: usize, work: Work) -> Result<(), Error> {
        let progressed = Progressed { stops, work, lengths: self.outputs.lengths() };
        self.latest.take(model, &progressed)?;
        (self.checkpoint, self.unwritten) = (Some(model.time()), true);
        Ok(())
    }

    fn write(&mut self) -> Result<(), Error> {
        self.outputs.flush()?;
        if self.unwritten {
            self.latest.write(self.place)?;
        }
        (self.unwritten, self.written) = (false, Instant::now());
        Ok(())
    }

    /// Keeps what there is of a run that cannot go on.
    fn stopped(&mut self, error: Error) -> Error {
        let written = self.write();
        if !error.is_of_run() {
            return error;
        }
        if let Err(unkept) = written {
            return unkept;
        }
        let (path, command) = (self.place.path().to_owned(), self.task.command.clone());
        let kept = Kept { path, checkpoint: self.checkpoint, command };
        Error::Stopped { source: Box::new(error), kept }
    }
}

impl<M: Model> Observer<M> for Keeper<'_, M> {
    fn observe(&mut self, model: &M, stop: Stop, work: &Work) -> Result<(), Error> {
        self.outputs.observe(model, stop, work)?;
        self.show(model);
        if self.stops.keeps(stop.number) {
            self.take(model, stop.number + 1, self.before.and(work))?;
            if self.written.elapsed() >= self.task.checkpoint {
                self.write()?;
            }
        }
        Ok(())
    }

    fn stepped(&mut self, model: &M, report: &StepReport, dt: f64) -> Result<(), Error> {
        self.outputs.stepped(model, report, dt)?;
        if self.shown.elapsed() >= REFRESH {
            self.show(model);
        }
        if self.task.interrupt.wanted() { Err(Error::Interrupted) } else { Ok(()) }
    }
}
