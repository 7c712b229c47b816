//! The paper's disc on a hinged bar in a stream, on a coarse mesh.

use lumley_body::RigidBody;
use lumley_fem::generate::Channel;
use lumley_fem::{PlanarMesh, Point};
use lumley_fom::TimeScheme;
use lumley_fom::coupling::{BodySetup, Coupling};
use lumley_fom::flow::{
    Condition, Flow, FlowError, FlowMotion, FlowParameters, FlowSetup, FlowStart, Linearisation,
    ViscousForm,
};
use std::sync::Arc;

const BODIES: &str = "
    [[bodies]]
    name = 'bar'
    mass = 1
    shape = { kind = 'bar', length = 5.5 }
    centre = [7, 2.75]
    angle = 1.5707963267948966
    joint = { kind = 'revolute', at = [7, 0] }
    [[bodies]]
    name = 'disc'
    mass = 50
    shape = { kind = 'disc', radius = 0.5 }
    centre = [7, 6]
    angle = 1.5707963267948966
    joint = { kind = 'revolute', at = [7, 5.5], to = 'bar' }
    boundary = 'disc'
";
const CHANNEL: &str = "
    x = [0, 21]
    y = [0, 12]
    size = 1.2
    growth = 0.3
    [[bodies]]
    name = 'disc'
    size = 0.2
    shape = { kind = 'disc', centre = [7, 6], radius = 0.5 }
    layers = { first = 0.06, growth = 1.5, count = 2 }
";

#[derive(serde::Deserialize)]
struct Case {
    bodies: Vec<RigidBody>,
}

fn pendulum(density: f64, coupling: Coupling) -> Flow {
    pendulum_by(density, coupling, TimeScheme::ImplicitEuler)
}

fn pendulum_by(density: f64, coupling: Coupling, scheme: TimeScheme) -> Flow {
    let channel: Channel = toml::from_str(CHANNEL).expect("a channel");
    let case: Case = toml::from_str(BODIES).expect("bodies");
    let stream: fn(Point, f64) -> Point = |_, _| [1.0, 0.0];
    let sides = ["left", "bottom", "top"]
        .map(|side| (side.to_owned(), Condition::Velocity(Arc::new(stream))));
    let rest = [("right", Condition::TractionFree), ("disc", Condition::NoSlip)]
        .map(|(name, condition)| (name.to_owned(), condition));
    Flow::new(FlowSetup {
        mesh: PlanarMesh::new(channel.mesh().expect("a mesh")).expect("a sound mesh"),
        parameters: FlowParameters {
            density,
            viscosity: 0.01 * density,
            viscous_form: ViscousForm::Stress,
            linearisation: Linearisation::Extrapolation,
            scheme,
            body_force: None,
        },
        conditions: sides.into_iter().chain(rest).collect(),
        start: FlowStart::Velocity(Arc::new(stream)),
        motion: FlowMotion::Bodies(BodySetup {
            bodies: case.bodies,
            coupling,
            ..BodySetup::default()
        }),
        parallel: false,
    })
    .expect("a flow")
}

/// Angle and load at 0.55 s beside those of a computation on a mesh of ten times the cells, where the impulsive start still
/// shows: 5 %. `lumley verify` has the rows with finer meshes and narrower tolerances.
#[test]
fn the_first_row_of_the_reference() {
    for coupling in [Coupling::Explicit, Coupling::Monolithic] {
        let mut flow = pendulum(1.0, coupling);
        for _ in 0..55 {
            flow.step(0.01).expect("a step");
        }
        let q = flow.bodies().expect("bodies").position();
        let load = flow.loads()[flow.loads().len() - 1];
        let straight = std::f64::consts::FRAC_PI_2;
        let excursion = (q[0] - straight) / (1.568_62 - straight);
        assert!((excursion - 1.0).abs() < 0.05, "{coupling:?}: {q:?} {load:?}");
        assert!((load.force[0] / 0.7161 - 1.0).abs() < 0.05, "{coupling:?}: {q:?} {load:?}");
    }
}

/// The added mass of the disc is that of the body at a density of 64 kg/m³: explicit coupling is stable at 40 and not at
/// 100, monolithic coupling at 1000.
#[test]
fn added_mass_limits_explicit_coupling_alone() {
    let run = |density: f64, coupling: Coupling| -> Result<f64, FlowError> {
        let mut flow = pendulum(density, coupling);
        for _ in 0..60 {
            flow.step(0.01)?;
        }
        Ok(flow.bodies().expect("bodies").velocity()[0].abs())
    };
    let share = pendulum(64.08, Coupling::Explicit).added_mass_share().expect("an estimate");
    assert!((share - 1.0).abs() < 0.01, "{share}");
    let calm = |found: &Result<f64, FlowError>| found.as_ref().is_ok_and(|v| *v < 1.0);
    assert!(calm(&run(40.0, Coupling::Explicit)));
    let wild = run(100.0, Coupling::Explicit).expect_err("it blows up").to_string();
    assert!(wild.contains("take the monolithic coupling"), "{wild}");
    let found = run(1000.0, Coupling::Monolithic);
    assert!(calm(&found), "{found:?}");
}

/// BDF2 for fluid and bodies does not lower the limit: explicit coupling is stable where added mass is less than the body's.
#[test]
fn bdf2_does_not_lower_the_limit_of_explicit_coupling() {
    let mut flow = pendulum_by(50.0, Coupling::Explicit, TimeScheme::Bdf2);
    let mut velocities = Vec::new();
    for _ in 0..100 {
        flow.step(0.01).expect("a step");
        velocities.push(flow.bodies().expect("bodies").velocity()[0]);
    }
    let change = velocities[99] - velocities[98];
    assert!(velocities[99].abs() < 0.2 && change.abs() < 1e-3, "{velocities:?}");
}
