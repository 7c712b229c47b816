//! Bodies that the fluid moves, with known answers.

use super::setups::{INNER, OUTER, fluid, order, ring};
use lumley_body::joint::{Cartesian, Free, Joint, Revolute, Slider, Spring};
use lumley_body::{BodyState, RigidBody};
use lumley_fem::generate::Channel;
use lumley_fem::{PlanarMesh, Point};
use lumley_fom::TimeScheme;
use lumley_fom::coupling::{BodySetup, Coupling};
use lumley_fom::flow::{
    Condition, Flow, FlowError, FlowMotion, FlowParameters, FlowSetup, FlowStart, Linearisation,
    ViscousForm,
};
use std::f64::consts::PI;

/// A disc in the ring's hole.
fn disc(mass: f64, joint: Joint) -> RigidBody {
    RigidBody {
        name: "disc".into(),
        mass: Some(mass),
        inertia: Some(0.5 * mass * INNER * INNER),
        shape: None,
        centre: [0.0; 2],
        angle: 0.0,
        joint,
        boundary: Some("bottom".into()),
        start: BodyState::default(),
        displaced: None,
    }
}

fn cartesian() -> Joint {
    Joint::Cartesian(Cartesian::default())
}

fn flow(n: usize, parameters: FlowParameters, setup: BodySetup) -> Result<Flow, FlowError> {
    Flow::new(FlowSetup {
        mesh: ring(n),
        parameters,
        conditions: ["bottom", "top"].map(|name| (name.into(), Condition::NoSlip)).into(),
        start: FlowStart::Rest,
        motion: FlowMotion::Bodies(setup),
        parallel: false,
    })
}

fn positions(flow: &Flow) -> Vec<f64> {
    flow.bodies().expect("bodies").position().to_vec()
}

fn velocities(flow: &Flow) -> Vec<f64> {
    flow.bodies().expect("bodies").velocity().to_vec()
}

/// The velocity after one short step from rest under gravity in a fluid almost without viscosity is `F dt/(m + m_a)`,
/// with the added mass of a disc in a concentric ring, `ρ π a² (b² + a²)/(b² − a²)`: for any mass, also none.
#[test]
fn a_disc_feels_its_added_mass() {
    let parameters = FlowParameters { viscosity: 1e-6, ..fluid(ViscousForm::Stress) };
    let (a, b) = (INNER * INNER, OUTER * OUTER);
    let displaced = parameters.density * PI * a;
    let added = displaced * (b + a) / (b - a);
    let (dt, gravity) = (1e-3, [3.0, -4.0]);
    for mass in [0.0, 0.1 * displaced, 2.0 * displaced, 50.0 * displaced] {
        let errors = [12, 24].map(|n| {
            let bodies = vec![disc(mass, cartesian())];
            let setup = BodySetup { bodies, gravity, ..BodySetup::default() };
            let mut flow = flow(n, parameters.clone(), setup).expect("a flow");
            flow.step(dt).expect("a step");
            // Of the polygon with curved edges that the disc is.
            let lifted = flow.bodies().expect("bodies").tree().bodies()[0].displaced;
            let weight = gravity.map(|g| (mass - lifted.expect("it is wet").mass) * g);
            let velocity = velocities(&flow);
            for d in 0..2 {
                let gap = mass * velocity[d] / dt - weight[d] - flow.loads()[0].force[d];
                assert!(gap.abs() < 1e-9 * displaced, "{mass}: the load is that of (16), {gap:e}");
            }
            let expected = (mass - displaced) * gravity[0] * dt / (mass + added);
            velocity[0] / expected - 1.0
        });
        let [coarse, fine] = errors.map(f64::abs);
        assert!(fine < 0.04 && fine <= 0.6 * coarse, "{mass}: {errors:?}");
    }
}

/// A body that goes with a uniform stream stays in it, whatever its joint leaves free.
#[test]
fn a_uniform_flow_carries_its_bodies() {
    let velocity = [0.3, -0.2];
    let stream = move |_: Point, _: f64| velocity;
    for mass in [0.0, 3.0] {
        let start = BodyState { position: vec![], velocity: vec![0.3, -0.2, 0.0] };
        let body = RigidBody { start, ..disc(mass, Joint::Free(Free::default())) };
        let setup = BodySetup { bodies: vec![body], ..BodySetup::default() };
        let mut flow = Flow::new(FlowSetup {
            mesh: ring(5),
            parameters: fluid(ViscousForm::Stress),
            conditions: vec![
                ("bottom".into(), Condition::NoSlip),
                ("top".into(), Condition::Velocity(std::sync::Arc::new(stream))),
            ],
            start: FlowStart::Velocity(std::sync::Arc::new(stream)),
            motion: FlowMotion::Bodies(setup),
            parallel: false,
        })
        .expect("a flow");
        for _ in 0..5 {
            let step = flow.step(0.1).expect("a step");
            assert_eq!(step.systems, 1, "foreseen");
        }
        let end = positions(&flow);
        let errors = [end[0] - 0.15, end[1] + 0.1, end[2]];
        assert!(errors.iter().all(|e| e.abs() < 1e-9), "{mass}: {errors:?}");
        for u in flow.velocity() {
            assert!((u[0] - 0.3).abs() < 1e-8 && (u[1] + 0.2).abs() < 1e-8, "{mass}: {u:?}");
        }
        let load = flow.loads()[0];
        assert!(load.force[0].hypot(load.force[1]) < 1e-7, "{mass}: {load:?}");
    }
}

/// A heavy disc that spins in a thin fluid slows down by the moment of Couette's flow, `−4π μ Ω a² b²/(b² − a²)`:
/// exponentially, and alike in both viscous forms.
#[test]
fn a_disc_spins_down() {
    for form in [ViscousForm::Stress, ViscousForm::Laplacian] {
        let parameters = FlowParameters { density: 1e-4, viscosity: 0.05, ..fluid(form) };
        let (a, b) = (INNER * INNER, OUTER * OUTER);
        let moment = 4.0 * PI * parameters.viscosity * a * b / (b - a);
        let start = BodyState { position: vec![], velocity: vec![0.5] };
        let joint = Joint::Revolute(Revolute { at: [0.0; 2], to: None, spring: None });
        let body = RigidBody { start, inertia: Some(1.0), ..disc(1.0, joint) };
        let setup = BodySetup { bodies: vec![body], ..BodySetup::default() };
        let mut flow = flow(6, parameters, setup).expect("a flow");
        let (dt, steps) = (0.05, 60);
        for _ in 0..steps {
            flow.step(dt).expect("a step");
        }
        let exact = 0.5 * (-moment * dt * f64::from(steps)).exp();
        let error = velocities(&flow)[0] / exact - 1.0;
        assert!(error.abs() < 2e-3, "{form:?}: {error:e}");
    }
}

/// A disc on a spring in fluid at rest, after so many steps since it was let go.
fn swing(n: usize, dt: f64, scheme: TimeScheme, mass: f64, steps: usize) -> Flow {
    let spring = Some(Spring { stiffness: 8.0, rest: 0.0, damping: 0.0 });
    let joint = Joint::Prismatic(Slider { along: [0.6, 0.8], to: None, spring });
    let start = BodyState { position: vec![0.2], velocity: vec![0.0] };
    let bodies = vec![RigidBody { start, ..disc(mass, joint) }];
    let parameters = FlowParameters { scheme, ..fluid(ViscousForm::Stress) };
    let setup = BodySetup { bodies, ..BodySetup::default() };
    let mut flow = flow(n, parameters, setup).expect("a flow");
    for _ in 0..steps {
        flow.step(dt).expect("a step");
    }
    flow
}

/// A disc on a spring that is let go: its position has the order of the scheme, with mass and without.
#[test]
fn bodies_have_the_order_of_the_scheme() {
    for (scheme, expected) in [(TimeScheme::ImplicitEuler, 1.0), (TimeScheme::Bdf2, 2.0)] {
        for mass in [0.0, 2.0] {
            let [a, b, c] =
                [20, 40, 80].map(|n| positions(&swing(3, 0.8 / n as f64, scheme, mass, n))[0]);
            let found = order((a - b).abs(), (b - c).abs());
            assert!((found - expected).abs() < 0.3, "{scheme:?}, {mass}: order {found}");
        }
    }
}

/// The mesh ends where the bodies are: (23).
#[test]
fn boundary_nodes_are_where_the_rigid_motion_puts_them() {
    let flow = swing(3, 0.05, TimeScheme::Bdf2, 2.0, 7);
    let moved = positions(&flow)[0];
    assert!((moved - 0.2).abs() > 0.01, "it moves");
    let boundary = flow.mesh().topology().boundary("bottom").expect("the disc");
    for &edge in &boundary.edges {
        for [x, y] in flow.mesh().edge(edge) {
            let distance = (x - 0.6 * moved).hypot(y - 0.8 * moved);
            assert!((distance - INNER).abs() < 1e-15, "{distance}");
        }
    }
}

fn bits(flow: &Flow) -> Vec<u64> {
    let mut state = Vec::new();
    flow.save(&mut state).expect("memory does not fail");
    state.as_chunks().0.iter().map(|bytes| u64::from_le_bytes(*bytes)).collect()
}

#[test]
fn a_restart_with_bodies_makes_the_same_bits() {
    let mut whole = swing(3, 0.05, TimeScheme::Bdf2, 2.0, 4);
    whole.forget_factor();
    let mut saved = Vec::new();
    whole.save(&mut saved).expect("memory does not fail");
    let mut resumed = swing(3, 0.05, TimeScheme::Bdf2, 2.0, 0);
    resumed.restore(&mut saved.as_slice()).expect("a sound checkpoint");
    assert_eq!(whole.mesh().nodes(), resumed.mesh().nodes());
    for flow in [&mut whole, &mut resumed] {
        for _ in 0..3 {
            flow.step(0.05).expect("a step");
        }
    }
    assert_eq!(bits(&whole), bits(&resumed));
}

#[test]
fn two_threads_move_bodies_by_the_same_bits() {
    let [one, two] = [false, true].map(|parallel| {
        let mut flow = mounted(parallel);
        for _ in 0..3 {
            flow.step(0.1).expect("a step");
        }
        bits(&flow)
    });
    assert_eq!(one, two);
}

/// A cylinder that a force of 7.5 N/m pulls across a stream against a spring: it goes three diameters.
fn mounted(parallel: bool) -> Flow {
    let channel: Channel = toml::from_str(
        "x = [-10, 20]\ny = [-10, 10]\nsize = 2.5\ngrowth = 0.3
         [[bodies]]\nname = 'cylinder'\nsize = 0.25\nshape = { kind = 'disc', centre = [0, 0], radius = 0.5 }
         layers = { first = 0.06, growth = 1.4, count = 3 }",
    )
    .expect("a channel");
    let cylinder: RigidBody = toml::from_str(
        "name = 'cylinder'\nmass = 2.5\ncentre = [0, 0]\nboundary = 'cylinder'
         joint = { kind = 'prismatic', along = [0, 1], spring = { stiffness = 2.37, damping = 3 } }",
    )
    .expect("a cylinder");
    let stream: fn(Point, f64) -> Point = |_, _| [1.0, 0.0];
    let sides = ["left", "bottom", "top"]
        .map(|side| (side.to_owned(), Condition::Velocity(std::sync::Arc::new(stream))));
    let rest = [("right", Condition::TractionFree), ("cylinder", Condition::NoSlip)]
        .map(|(name, condition)| (name.to_owned(), condition));
    let setup = BodySetup { bodies: vec![cylinder], gravity: [0.0, 4.4], ..BodySetup::default() };
    Flow::new(FlowSetup {
        mesh: PlanarMesh::new(channel.mesh().expect("a mesh")).expect("a sound mesh"),
        parameters: FlowParameters { density: 1.0, viscosity: 0.01, ..fluid(ViscousForm::Stress) },
        conditions: sides.into_iter().chain(rest).collect(),
        start: FlowStart::Velocity(std::sync::Arc::new(stream)),
        motion: FlowMotion::Bodies(setup),
        parallel,
    })
    .expect("a flow")
}

#[test]
fn a_mounted_cylinder_goes_three_diameters() {
    let mut flow = mounted(false);
    let mut farthest = 0.0_f64;
    for _ in 0..150 {
        flow.step(0.05).expect("a step");
        farthest = farthest.max(positions(&flow)[0]);
    }
    assert!(farthest > 3.0, "{farthest}");
}

/// The same bodies by both couplings: close where the added mass is small.
#[test]
fn explicit_coupling_agrees_where_it_is_stable() {
    let found = [Coupling::Monolithic, Coupling::Explicit].map(|coupling| {
        let bodies = vec![disc(20.0, cartesian())];
        let setup = BodySetup { bodies, gravity: [1.0, 0.0], coupling, ..BodySetup::default() };
        let parameters =
            FlowParameters { scheme: TimeScheme::ImplicitEuler, ..fluid(ViscousForm::Stress) };
        let mut flow = flow(3, parameters, setup).expect("a flow");
        for _ in 0..20 {
            flow.step(0.02).expect("a step");
        }
        assert_eq!(flow.added_mass_share().is_some(), coupling == Coupling::Explicit);
        positions(&flow)[0]
    });
    let gap = found[1] / found[0] - 1.0;
    assert!(gap.abs() < 0.02 && gap != 0.0, "{found:?}");
}

#[test]
fn bodies_that_cannot_be_are_refused() {
    let refusal = |bodies: Vec<RigidBody>, coupling: Coupling| {
        let setup = BodySetup { bodies, coupling, ..BodySetup::default() };
        let parameters =
            FlowParameters { linearisation: Linearisation::Tangent, ..fluid(ViscousForm::Stress) };
        flow(2, parameters, setup).err().expect("an error").to_string()
    };
    let monolithic = Coupling::Monolithic;
    let dry = RigidBody { boundary: None, ..disc(1.0, cartesian()) };
    let said = refusal(vec![dry.clone()], monolithic);
    assert!(said.starts_with("no body has a boundary"), "{said}");
    let nowhere = RigidBody { boundary: Some("cylinder".into()), ..disc(1.0, cartesian()) };
    let said = refusal(vec![nowhere], monolithic);
    assert!(said.contains("no boundary `cylinder`; it has bottom, top"), "{said}");
    let ghost = RigidBody { name: "ghost".into(), mass: Some(0.0), inertia: None, ..dry };
    let said = refusal(vec![disc(1.0, cartesian()), ghost], monolithic);
    assert!(said.starts_with("ghost.x moves no mass"), "{said}");
    let said = refusal(vec![disc(0.0, cartesian())], Coupling::Explicit);
    assert!(said.contains("disc.x"), "{said}");
    let wall = RigidBody { boundary: Some("top".into()), ..disc(1.0, cartesian()) };
    let said = refusal(vec![wall], monolithic);
    assert!(said.contains("goes round the fluid"), "{said}");
}

/// A disc that is pulled against the wall ends the run with an error that names both.
#[test]
fn a_body_that_meets_the_wall_is_an_error() {
    let bodies = vec![disc(3.0, cartesian())];
    let setup = BodySetup { bodies, gravity: [30.0, 0.0], ..BodySetup::default() };
    let mut flow = flow(3, fluid(ViscousForm::Stress), setup).expect("a flow");
    let error = (0..400).find_map(|_| flow.step(0.02).err()).expect("it arrives").to_string();
    assert!(error.contains("`bottom` meets `top`"), "{error}");
}
