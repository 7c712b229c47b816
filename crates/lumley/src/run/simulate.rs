use super::checkpoint::{self, Progressed};
use super::recorder::{Gauge, Plan, Recorder};
use super::{Work, advance, transfer};
use crate::Error;
use crate::case::PistonCase;
use crate::directory::Workplace;
use crate::model::{Frame, Model, Observer};
use crate::progress::Progress;
use crate::record::{Quantity, Support};
use lumley_fom::Piston;
use std::time::{Duration, Instant};

/// Where the velocity is probed, in m.
const MIDDLE: f64 = 0.5;

/// The full-order model of `case`, at its initial state.
///
/// # Errors
/// What the model does not accept.
pub fn full_order(case: &PistonCase) -> Result<Piston, Error> {
    Ok(Piston::new(&case.piston, case.cells, case.degree, case.scheme)?)
}

/// Runs the full-order model of `case` into `place`/record, from the checkpoint when there is one, with
/// checkpoints at least `between` apart.
pub(super) fn simulate(
    case: &PistonCase,
    place: &Workplace,
    between: Duration,
    progress: &mut Progress,
) -> Result<Work, Error> {
    let mut model = full_order(case)?;
    let schedule = &case.schedule;
    progress.begin("full-order model", schedule.intervals);
    let folder = place.path().join("record");
    let plan = plan(case, &model);
    let (recorder, before) = if let Some(before) = checkpoint::restore(place, &mut model)? {
        (Recorder::resume(&folder, plan, before.snapshots)?, before)
    } else {
        place.fresh_folder("record")?;
        let before = Progressed { snapshots: 0, work: Work::default() };
        (Recorder::create(&folder, case, plan)?, before)
    };
    let now = Instant::now();
    let mut keeper = Keeper { recorder, place, progress, between, saved: now, before: before.work };
    let work = advance(&mut model, schedule, before.snapshots, &mut keeper)?;
    let work = before.work.and(&work);
    // A run that is stopped in a later stage does not compute this one again.
    keeper.save(&model, &Progressed { snapshots: schedule.snapshots(), work })?;
    Ok(work)
}

/// What is recorded of the full-order model.
fn plan(case: &PistonCase, model: &Piston) -> Plan<Piston> {
    let [position, velocity] = Gauge::of_body();
    let one = |name, unit| vec![Quantity::new(name, unit)];
    let nodes = model.nodes().map(|xi| [xi, 0.0]).collect();
    Plan {
        interval: case.schedule.interval,
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
pub(super) fn fixed(case: &PistonCase) -> Frame {
    Frame::Fixed { grid: case.grid.clone(), transfer: case.transfer }
}

/// Records every snapshot, and keeps a checkpoint that matches what is on disk.
struct Keeper<'a> {
    recorder: Recorder<Piston>,
    place: &'a Workplace,
    progress: &'a mut Progress,
    between: Duration,
    saved: Instant,
    /// Work of the sessions before.
    before: Work,
}

impl Keeper<'_> {
    fn save(&mut self, model: &Piston, progressed: &Progressed) -> Result<(), Error> {
        self.recorder.flush()?;
        checkpoint::save(self.place, model, progressed)?;
        self.saved = Instant::now();
        Ok(())
    }
}

impl Observer<Piston> for Keeper<'_> {
    fn observe(&mut self, model: &Piston, snapshot: usize, work: &Work) -> Result<(), Error> {
        self.recorder.observe(model, snapshot, work)?;
        let time = Model::time(model);
        let message = format!("t = {time:.3} s, X = {:.4} m", model.interface());
        self.progress.advance(snapshot, &message);
        if self.saved.elapsed() >= self.between {
            let work = self.before.and(work);
            self.save(model, &Progressed { snapshots: snapshot + 1, work })?;
        }
        Ok(())
    }
}
