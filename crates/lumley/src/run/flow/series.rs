//! What is recorded of a flow: its frames, and the series beside them.

use super::Plan;
use crate::case::{FlowCase, RecordChoice};
use crate::model::{FlowModel, Frame};
use crate::record::{FrameDescription, Quantity, Support};
use crate::run::{self, Gauge};
use lumley_body::{ImplicitScheme, Placement, Tree};

/// Snapshots and pictures that wait in memory.
const SNAPSHOTS: usize = 16;
const PICTURES: usize = 4;
/// Characters of the name of a boundary or a body in that of a series.
const LONGEST_NAME: usize = 40;

/// The record on the fixed grid.
pub(super) fn record(case: &FlowCase, choice: &RecordChoice) -> run::Plan<FlowModel> {
    let RecordChoice { grid, transfer, .. } = choice.clone();
    let frame = Frame::Fixed { grid: grid.clone(), transfer };
    let described = frame.describe(Support::Grid(grid), velocity().into());
    plan(case, (frame, described), SNAPSHOTS)
}

/// The pictures for the report.
pub(super) fn pictures(of: &Plan) -> run::Plan<FlowModel> {
    let frame = Frame::Picture { grid: of.picture.clone() };
    let scalars = [Quantity::new("p", "Pa"), Quantity::new("vorticity", "1/s")];
    let components = velocity().into_iter().chain(scalars).collect();
    let described = frame.describe(Support::Grid(of.picture.clone()), components);
    plan(of.case, (frame, described), PICTURES.min(of.timeline.pictures()))
}

fn velocity() -> [Quantity; 2] {
    ["u", "v"].map(|name| Quantity::new(name, "m/s"))
}

fn plan(
    case: &FlowCase,
    frame: (Frame, FrameDescription),
    gathered: usize,
) -> run::Plan<FlowModel> {
    let mut gauges = vec![courant(), iterations()];
    let mut names = Names::default();
    let boundaries = case.mesh.topology().boundaries().iter().enumerate();
    gauges.extend(boundaries.map(|(k, boundary)| load(names.of("loads", &boundary.name), k)));
    gauges.extend(case.bodies.iter().flat_map(|choice| of_bodies(&choice.tree)));
    let (name, case_file) = (case.name.clone(), case.kept().case);
    run::Plan { case: name, case_file, gathered: Some(gathered), frames: vec![frame], gauges }
}

/// Names of series, all different and such as a record takes.
#[derive(Default)]
struct Names(Vec<String>);

impl Names {
    fn of(&mut self, what: &str, whose: &str) -> String {
        let plain =
            |c: char| if c.is_ascii_alphanumeric() || c == '-' || c == '_' { c } else { '_' };
        let plain: String = whose.chars().map(plain).take(LONGEST_NAME).collect();
        let mut name = format!("{what}-{plain}");
        for k in 2.. {
            if !self.0.contains(&name) {
                break;
            }
            name = format!("{what}-{plain}-{k}");
        }
        self.0.push(name.clone());
        name
    }
}

fn quantities<const N: usize>(names: [(&str, &str); N]) -> Vec<Quantity> {
    names.map(|(name, unit)| Quantity::new(name, unit)).into()
}

/// Force and moment on the boundary of this number.
fn load(name: String, number: usize) -> Gauge<FlowModel> {
    let entries = quantities([("fx", "N/m"), ("fy", "N/m"), ("moment", "N")]);
    Gauge::new(name, entries, move |model: &FlowModel| {
        let load = model.flow().loads()[number];
        Ok(vec![load.force[0], load.force[1], load.moment])
    })
}

/// The series of where the bodies are, in their order.
pub(super) fn positions(tree: &Tree) -> Vec<String> {
    let mut names = Names::default();
    tree.bodies().iter().map(|body| names.of("position", &body.name)).collect()
}

/// Where each body is, and its coordinates.
fn of_bodies(tree: &Tree) -> Vec<Gauge<FlowModel>> {
    let positions = positions(tree).into_iter().enumerate();
    let mut names = Names::default();
    let coordinates = tree.coordinates().iter().enumerate();
    let coordinates = coordinates.map(|(k, found)| {
        let unit = if found.name == "angle" { "rad" } else { "m" };
        coordinate(names.of("body", &tree.label(k)), k, unit)
    });
    positions.map(|(body, name)| position(name, body)).chain(coordinates).collect()
}

fn bodies(model: &FlowModel) -> &ImplicitScheme {
    model.flow().bodies().expect("the flow of a case with bodies has them")
}

/// The rigid motion (23) of the body of this number from the mesh as given.
fn position(name: String, body: usize) -> Gauge<FlowModel> {
    let entries = quantities([("x", "m"), ("y", "m"), ("angle", "rad")]);
    Gauge::new(name, entries, move |model: &FlowModel| {
        let Placement { translation: [x, y], rotation, .. } =
            bodies(model).kinematics().placement(body);
        Ok(vec![x, y, rotation])
    })
}

/// The generalised coordinate of this number and its velocity.
fn coordinate(name: String, k: usize, unit: &str) -> Gauge<FlowModel> {
    let rate = format!("{unit}/s");
    let entries = quantities([("position", unit), ("velocity", &rate)]);
    Gauge::new(name, entries, move |model: &FlowModel| {
        Ok(vec![bodies(model).position()[k], bodies(model).velocity()[k]])
    })
}

/// Cells that fluid crossed in the last step.
fn courant() -> Gauge<FlowModel> {
    Gauge::new("cfl", quantities([("CFL", "1")]), |model: &FlowModel| {
        Ok(vec![model.courant_number()])
    })
}

/// Iterations of the linear solver in the last step.
fn iterations() -> Gauge<FlowModel> {
    Gauge::new("iterations", quantities([("GMRES", "1")]), |model: &FlowModel| {
        Ok(vec![model.last_step().iterations as f64])
    })
}
