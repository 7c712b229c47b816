//! Trees of bodies in a fluid that turns as a whole: whatever joints they have, they turn with it.

use super::setups::{fluid, ring};
use lumley_body::RigidBody;
use lumley_fem::Point;
use lumley_fom::TimeScheme;
use lumley_fom::coupling::{BodySetup, Coupling};
use lumley_fom::flow::{
    Condition, Flow, FlowMotion, FlowParameters, FlowSetup, FlowStart, Linearisation, SteadyLimits,
    VectorField, ViscousForm,
};
use std::f64::consts::PI;
use std::sync::Arc;

/// Of the fluid, in rad/s.
const SPIN: f64 = 0.7;
/// About which it turns, in m.
const AXIS: Point = [-0.3, 0.1];
/// A disc that hangs on a bar, which turns about the axis.
const HUNG: &str =
    "name = 'disc'\nmass = 0\ncentre = [0, 0]\nboundary = 'bottom'\nstart = { velocity = [0.7] }
     joint = { kind = 'revolute', at = [0.2, -0.1], to = 'bar' }";
const BAR: &str =
    "name = 'bar'\nmass = 2\ninertia = 0.3\ncentre = [-0.1, 0.3]\nstart = { velocity = [0.7] }
     joint = { kind = 'revolute', at = [-0.3, 0.1] }";
const TURNTABLE: &str = "name = 'bar'\ncentre = [0.2, 0.4]
     joint = { kind = 'prescribed', at = [-0.3, 0.1], angle = { times = [0, 10], values = [0, 7] } }";

fn turning([x, y]: Point, _: f64) -> Point {
    [-SPIN * (y - AXIS[1]), SPIN * (x - AXIS[0])]
}

/// Keeps the fluid on its circles without a pressure.
fn centripetal([x, y]: Point, _: f64) -> Point {
    [x - AXIS[0], y - AXIS[1]].map(|arm| -SPIN * SPIN * arm)
}

fn bodies(described: &[&str]) -> Vec<RigidBody> {
    described.iter().map(|text| toml::from_str(text).expect("a body")).collect()
}

fn flow(n: usize, parameters: FlowParameters, start: FlowStart, setup: BodySetup) -> Flow {
    Flow::new(FlowSetup {
        mesh: ring(n),
        parameters,
        conditions: vec![
            ("bottom".into(), Condition::NoSlip),
            ("top".into(), Condition::Velocity(Arc::new(turning))),
        ],
        start,
        motion: FlowMotion::Bodies(setup),
        parallel: false,
    })
    .expect("a flow")
}

/// Largest error of positions and velocities of bodies whose coordinates are all angles or rest.
fn error(flow: &Flow) -> f64 {
    let scheme = flow.bodies().expect("bodies");
    let start = scheme.tree().start(0.0).expect("a start");
    let moved = start.position.iter().zip(&start.velocity).map(|(q, v)| q + v * flow.time());
    let positions = scheme.position().iter().zip(moved).map(|(q, exact)| (q - exact).abs());
    let velocities = scheme.velocity().iter().zip(&start.velocity).map(|(v, w)| (v - w).abs());
    positions.chain(velocities).fold(0.0, f64::max)
}

/// Fluid and bodies turn about the axis as one. The force that keeps the fluid on its circles leaves no pressure, so
/// that bodies feel nothing: the answer is in the space of the velocity, and coordinates go with the time, so that
/// Newton's method finds it for any steps. The body's centre is not that of its outline, hinges are off both, and bodies without mass
/// hang on prescribed ones.
#[test]
fn trees_turn_with_the_fluid() {
    let hinged = "name = 'disc'\nmass = 3\ninertia = 0.5\ncentre = [0.1, 0.05]\nboundary = 'bottom'
         start = { velocity = [0.7] }\njoint = { kind = 'revolute', at = [-0.3, 0.1] }";
    let fixed = "name = 'disc'\nmass = 3\ninertia = 0.5\ncentre = [0, 0]\nboundary = 'bottom'
         joint = { kind = 'fixed', to = 'bar' }";
    let slides = "name = 'disc'\nmass = 0\ncentre = [0, 0]\nboundary = 'bottom'
         joint = { kind = 'prismatic', along = [0.6, 0.8], to = 'bar' }";
    let trees: [&[&str]; 5] =
        [&[hinged], &[BAR, HUNG], &[HUNG, TURNTABLE], &[BAR, fixed], &[TURNTABLE, slides]];
    for tree in trees {
        for form in [ViscousForm::Stress, ViscousForm::Laplacian] {
            let parameters = FlowParameters {
                linearisation: Linearisation::Newton,
                body_force: Some(Arc::new(centripetal)),
                ..fluid(form)
            };
            let setup = BodySetup { bodies: bodies(tree), ..BodySetup::default() };
            let mut flow = flow(3, parameters, FlowStart::Velocity(Arc::new(turning)), setup);
            for dt in [0.05, 0.08, 0.03, 0.1, 0.1] {
                flow.step(dt).expect("a step");
            }
            let (found, load) = (error(&flow), flow.loads()[0]);
            let felt = load.force[0].hypot(load.force[1]) + load.moment.abs();
            assert!(found < 1e-7 && felt < 1e-6, "{tree:?}, {form:?}: {found:e} {load:?}");
        }
    }
}

/// A body that nothing but the time moves has the velocity of (23), not that of the chords of its nodes.
#[test]
fn a_prescribed_body_turns_with_the_fluid() {
    let fixed = "name = 'disc'\ncentre = [0, 0]\nboundary = 'bottom'
         joint = { kind = 'fixed', to = 'bar' }";
    let body_force: Option<Arc<dyn VectorField>> = Some(Arc::new(centripetal));
    let parameters = FlowParameters { body_force, ..fluid(ViscousForm::Stress) };
    let setup = BodySetup { bodies: bodies(&[TURNTABLE, fixed]), ..BodySetup::default() };
    let mut flow = flow(3, parameters, FlowStart::Velocity(Arc::new(turning)), setup);
    for _ in 0..10 {
        flow.step(0.1).expect("a step");
    }
    let force = flow.loads()[0].force;
    assert!(force[0].hypot(force[1]) < 1e-5, "{force:?}");
}

/// Without the force: the pressure keeps a body on its circle that weighs as much as the fluid it displaces.
#[test]
fn bodies_as_heavy_as_the_fluid_turn_with_it() {
    let errors = [4, 8].map(|n| {
        let parameters = fluid(ViscousForm::Stress);
        let mut tree = bodies(&[BAR, HUNG]);
        let mass = parameters.density * PI * 0.25;
        (tree[1].mass, tree[1].inertia) = (Some(mass), Some(0.125 * mass));
        let setup = BodySetup { bodies: tree, ..BodySetup::default() };
        let mut flow = flow(n, parameters, FlowStart::Velocity(Arc::new(turning)), setup);
        for _ in 0..8 {
            flow.step(0.1).expect("a step");
        }
        error(&flow)
    });
    assert!(errors[1] < 1e-3 && errors[1] < 0.3 * errors[0], "{errors:?}");
}

/// Moments are about the centre of mass, where the body is: (16) for a body whose centre is not that of its outline.
#[test]
fn loads_are_about_the_centre_of_mass() {
    for form in [ViscousForm::Stress, ViscousForm::Laplacian] {
        let text =
            "name = 'disc'\nmass = 2\ninertia = 0.7\ncentre = [0.2, -0.1]\nboundary = 'bottom'
             joint = { kind = 'free' }\nstart = { position = [0.1, 0.05, 0.3] }";
        let gravity = [3.0, -4.0];
        let setup = BodySetup { bodies: bodies(&[text]), gravity, ..BodySetup::default() };
        let mut flow = flow(4, fluid(form), FlowStart::Rest, setup);
        let dt = 1e-4;
        flow.step(dt).expect("a step");
        let (scheme, load) = (flow.bodies().expect("bodies"), flow.loads()[0]);
        let lifted = scheme.tree().bodies()[0].displaced.expect("it is wet");
        let v = scheme.velocity();
        for d in 0..2 {
            let gap = 2.0 * v[d] / dt - (2.0 - lifted.mass) * gravity[d] - load.force[d];
            assert!(gap.abs() < 1e-6, "{form:?}: force {gap:e}");
        }
        let kinematics = scheme.kinematics();
        let (centre, outline) =
            (kinematics.centre(0), kinematics.placement(0).place(lifted.centre));
        let arm = [outline[0] - centre[0], outline[1] - centre[1]];
        let lift = -lifted.mass * (arm[0] * gravity[1] - arm[1] * gravity[0]);
        let gap = 0.7 * v[2] / dt - lift - load.moment;
        assert!(gap.abs() < 1e-5 && load.moment.abs() > 0.1, "{form:?}: moment {gap:e}");
    }
}

/// Bodies that no fluid touches, beside or on ones that it does, move as they would without it.
#[test]
fn dry_bodies_move_by_themselves() {
    let wet =
        "name = 'disc'\ncentre = [0, 0]\nboundary = 'bottom'\njoint = { kind = 'prescribed' }";
    let block = "name = 'block'\nmass = 1\ncentre = [0, 0]\nstart = { position = [1] }
         joint = { kind = 'prismatic', along = [1, 0], to = 'disc', spring = { stiffness = 8 } }";
    for coupling in [Coupling::Monolithic, Coupling::Explicit] {
        let parameters =
            FlowParameters { scheme: TimeScheme::ImplicitEuler, ..fluid(ViscousForm::Stress) };
        let setup = BodySetup { bodies: bodies(&[wet, block]), coupling, ..BodySetup::default() };
        let mut flow = flow(2, parameters, FlowStart::Rest, setup);
        let (dt, mut q, mut v) = (0.1, 1.0, 0.0);
        for _ in 0..5 {
            flow.step(dt).expect("a step");
            v = (v - dt * 8.0 * q) / (1.0 + 8.0 * dt * dt);
            q += dt * v;
        }
        let found = flow.bodies().expect("bodies").position()[3];
        assert!((found - q).abs() < 1e-9, "{coupling:?}: {found}, expected {q}");
    }
}

/// In a steady flow, and in the creeping one at the start, bodies are held, whatever moves them later.
#[test]
fn steady_flows_hold_their_bodies() {
    let loads = [true, false].map(|moved| {
        let held =
            "name = 'disc'\ncentre = [0, 0]\nboundary = 'bottom'\njoint = { kind = 'fixed' }";
        let tree: &[&str] = if moved { &[TURNTABLE, HUNG] } else { &[held] };
        let setup = BodySetup { bodies: bodies(tree), ..BodySetup::default() };
        let mut flow = flow(3, fluid(ViscousForm::Stress), FlowStart::Stokes, setup);
        let creeping = flow.loads()[0];
        flow.settle(SteadyLimits::default(), |_, _| {}).expect("a steady flow");
        [creeping, flow.loads()[0]]
    });
    for (moved, held) in loads[0].iter().zip(&loads[1]) {
        for (a, b) in moved.force.iter().zip(&held.force) {
            assert!((a - b).abs() < 1e-7 * held.force[0].hypot(held.force[1]), "{loads:?}");
        }
    }
}

/// A body so heavy that nothing changes its velocity makes the flow of a prescribed one.
#[test]
fn a_heavy_body_leaves_the_fluid_accurate() {
    let prescribed = "name = 'disc'\ncentre = [0, 0]\nboundary = 'bottom'
         joint = { kind = 'prescribed', x = { times = [0, 10], values = [0, 4] } }";
    let heavy = "name = 'disc'\nmass = 1e12\ncentre = [0, 0]\nboundary = 'bottom'
         joint = { kind = 'prismatic', along = [1, 0] }\nstart = { velocity = [0.4] }";
    let loads = [prescribed, heavy].map(|body| {
        let setup = BodySetup { bodies: bodies(&[body]), ..BodySetup::default() };
        let mut flow = flow(4, fluid(ViscousForm::Stress), FlowStart::Rest, setup);
        for _ in 0..4 {
            flow.step(0.05).expect("a step");
        }
        flow.loads()[0]
    });
    for d in 0..2 {
        let gap = loads[0].force[d] - loads[1].force[d];
        let size = loads[0].force[0].hypot(loads[0].force[1]);
        assert!(gap.abs() < 1e-6 * size, "{loads:?}");
    }
}
