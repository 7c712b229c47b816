use super::recorder::{Gauge, Plan, Recorder};
use super::{Work, advance, transfer};
use crate::Error;
use crate::case::Case;
use crate::directory::{DirectoryError, Workplace};
use crate::model::{Frame, Model, Observer};
use crate::progress::Progress;
use crate::record::{Quantity, Support};
use lumley_fom::Piston;
use std::fs;
use std::io;
use std::path::Path;
use std::time::{Duration, Instant};

/// Where a checkpoint stands in a run directory; gone when the run is complete.
const CHECKPOINT: &str = "checkpoint";
/// Where the velocity is probed, in m.
const MIDDLE: f64 = 0.5;

/// The full-order model of `case`, at its initial state.
///
/// # Errors
/// What the model does not accept.
pub fn full_order(case: &Case) -> Result<Piston, Error> {
    Ok(Piston::new(&case.piston, case.cells, case.degree, case.scheme)?)
}

/// Runs the full-order model of `case` into `place`/record, from the checkpoint when there is one, with
/// checkpoints at least `between` apart.
pub(super) fn simulate(
    case: &Case,
    place: &Workplace,
    between: Duration,
    progress: &mut Progress,
) -> Result<Work, Error> {
    let mut model = full_order(case)?;
    let schedule = &case.schedule;
    progress.begin("full-order model", schedule.intervals);
    let folder = place.path().join("record");
    let plan = plan(case, &model);
    let (recorder, first) = if let Some(snapshots) = checkpoint(place, &mut model)? {
        (Recorder::resume(&folder, plan, snapshots)?, snapshots - 1)
    } else {
        place.fresh_folder("record")?;
        (Recorder::create(&folder, case, plan, &model)?, 0)
    };
    let mut observer = Keeper { recorder, place, progress, between, saved: Instant::now() };
    let work = advance(&mut model, schedule, first, &mut observer)?;
    observer.recorder.finish()?;
    let checkpoint = place.path().join(CHECKPOINT);
    if checkpoint.exists() {
        fs::remove_file(&checkpoint).map_err(|e| io_error("remove", &checkpoint, e))?;
    }
    Ok(work)
}

/// What is recorded of the full-order model.
fn plan(case: &Case, model: &Piston) -> Plan<Piston> {
    let [position, velocity] = Gauge::of_body();
    let one = |name, unit| vec![Quantity::new(name, unit)];
    let nodes = model.nodes().map(|xi| [xi, 0.0]).collect();
    Plan {
        frames: vec![
            (fixed(case), Support::Grid(case.grid.clone())),
            (Frame::Reference, Support::Nodes(nodes)),
        ],
        gauges: vec![
            position,
            velocity,
            Gauge::new("traction", one("nu u_x", "m2/s2"), |m: &Piston| Ok(vec![m.traction()])),
            Gauge::new("velocity-mid", one("u(0.5)", "m/s"), |m: &Piston| {
                Ok(vec![m.velocity_at(MIDDLE)])
            }),
            transfer::errors(case),
        ],
    }
}

/// The fixed grid of `case` as a frame.
pub(super) fn fixed(case: &Case) -> Frame {
    Frame::Fixed { grid: case.grid.clone(), transfer: case.transfer }
}

/// Restores `model` from the checkpoint of an unfinished run; says how many snapshots stand before it.
fn checkpoint(place: &Workplace, model: &mut Piston) -> Result<Option<usize>, Error> {
    let path = place.path().join(CHECKPOINT);
    if !place.resumed() || !path.exists() {
        return Ok(None);
    }
    let bytes = fs::read(&path).map_err(|e| io_error("read", &path, e))?;
    let damaged =
        |message: &str| Error::Damaged { path: path.clone(), message: message.to_owned() };
    let (count, mut state) = bytes.split_at_checked(8).ok_or_else(|| damaged("it is too short"))?;
    let count = u64::from_le_bytes(count.try_into().expect("eight bytes were split off"));
    Model::restore(model, &mut state).map_err(|e| damaged(&e.to_string()))?;
    let count = usize::try_from(count).ok().filter(|count| *count >= 1);
    count.map(Some).ok_or_else(|| damaged("it stands before the first snapshot"))
}

/// Records every snapshot, and keeps a checkpoint that matches what is on disk.
struct Keeper<'a> {
    recorder: Recorder<Piston>,
    place: &'a Workplace,
    progress: &'a mut Progress,
    between: Duration,
    saved: Instant,
}

impl Observer<Piston> for Keeper<'_> {
    fn observe(&mut self, model: &Piston, snapshot: usize) -> Result<(), Error> {
        self.recorder.observe(model, snapshot)?;
        let time = Model::time(model);
        self.progress
            .advance(snapshot, &format!("t = {time:.3} s, X = {:.4} m", model.interface()));
        if self.saved.elapsed() >= self.between {
            self.recorder.flush()?;
            let mut bytes = (snapshot as u64 + 1).to_le_bytes().to_vec();
            let path = self.place.path().join(CHECKPOINT);
            Model::save(model, &mut bytes).map_err(|e| io_error("write", &path, e))?;
            self.place.write(CHECKPOINT, &bytes)?;
            self.saved = Instant::now();
        }
        Ok(())
    }
}

fn io_error(action: &'static str, path: &Path, source: io::Error) -> Error {
    DirectoryError::Io { action, path: path.to_owned(), source }.into()
}
