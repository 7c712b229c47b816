use super::transfer;
use crate::Error;
use crate::case::PistonCase;
use crate::directory::Workplace;
use crate::model::{Frame, Model, Observer, Stop};
use crate::progress::Progress;
use crate::record::{FrameDescription, Quantity, Support};
use crate::run::keeper::{self, Outputs};
use crate::run::{Gauge, Plan, Recorder, Task, Work, checkpoint};
use lumley_fom::Piston;

/// Where the velocity is probed, in m.
const MIDDLE: f64 = 0.5;

/// The full-order model of `case`, at its initial state.
///
/// # Errors
/// What the model does not accept.
pub fn full_order(case: &PistonCase) -> Result<Piston, Error> {
    Ok(Piston::new(&case.piston, case.cells, case.degree, case.scheme)?)
}

/// Runs the full-order model of `case` into `place`/record, from the checkpoint when there is one.
pub(super) fn simulate(
    case: &PistonCase,
    task: &Task,
    place: &Workplace,
    progress: &mut Progress,
) -> Result<Work, Error> {
    let mut model = full_order(case)?;
    progress.begin("full-order model", case.schedule.intervals);
    let folder = place.path().join("record");
    let plan = plan(case, &model);
    let before = checkpoint::restore(place, &mut model)?;
    let recorder = if let Some(before) = &before {
        Recorder::resume(&folder, plan, before.stops)?
    } else {
        place.fresh_folder("record")?;
        Recorder::create(&folder, plan)?
    };
    let mut outputs = Record(recorder);
    let to = (task, place);
    keeper::simulate(&mut model, &case.schedule, &mut outputs, before, to, progress)
}

/// What is recorded of the full-order model.
fn plan(case: &PistonCase, model: &Piston) -> Plan<Piston> {
    let [position, velocity] = Gauge::of_body();
    let one = |name, unit| vec![Quantity::new(name, unit)];
    let nodes = model.nodes().map(|xi| [xi, 0.0]).collect();
    let reference = Frame::Reference.describe(Support::Nodes(nodes), velocity_components());
    Plan {
        case: case.name.clone(),
        case_file: case.to_toml(),
        gathered: None,
        frames: vec![fixed_and_described(case), (Frame::Reference, reference)],
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

/// The fixed grid of `case` as a frame, and what a record says of it.
pub(super) fn fixed_and_described(case: &PistonCase) -> (Frame, FrameDescription) {
    let frame = fixed(case);
    let description = frame.describe(Support::Grid(case.grid.clone()), velocity_components());
    (frame, description)
}

fn velocity_components() -> Vec<Quantity> {
    vec![Quantity::new("u", "m/s")]
}

/// The record is all that the full-order model leaves.
struct Record(Recorder<Piston>);

impl Observer<Piston> for Record {
    fn observe(&mut self, model: &Piston, stop: Stop, work: &Work) -> Result<(), Error> {
        self.0.observe(model, stop, work)
    }
}

impl Outputs<Piston> for Record {
    fn flush(&mut self) -> Result<(), Error> {
        self.0.flush()
    }

    fn status(&self, model: &Piston) -> String {
        format!("t = {:.3} s, X = {:.4} m", Model::time(model), model.interface())
    }
}
