//! Bodies in a flow that goes wrong: what is said, and what is left.

use super::setups::{fluid, ring};
use lumley_body::RigidBody;
use lumley_fem::PlanarMesh;
use lumley_fem::generate::Channel;
use lumley_fom::coupling::{BodySetup, Coupling};
use lumley_fom::flow::{
    Condition, Flow, FlowError, FlowMotion, FlowSetup, FlowStart, StepControl, ViscousForm,
};

fn disc(joint: &str) -> RigidBody {
    let text = format!(
        "name = 'disc'\nmass = 3\ninertia = 0.4\ncentre = [0.1, 0]\nboundary = 'bottom'\njoint = {joint}"
    );
    toml::from_str(&text).expect("a body")
}

fn flow(bodies: Vec<RigidBody>, coupling: Coupling) -> Flow {
    Flow::new(FlowSetup {
        mesh: ring(3),
        parameters: fluid(ViscousForm::Stress),
        conditions: ["bottom", "top"].map(|name| (name.into(), Condition::NoSlip)).into(),
        start: FlowStart::Rest,
        motion: FlowMotion::Bodies(BodySetup {
            bodies,
            gravity: [1.0, -0.5],
            coupling,
            ..BodySetup::default()
        }),
        parallel: false,
    })
    .expect("a flow")
}

fn steps(flow: &mut Flow, dt: f64) {
    for _ in 0..3 {
        flow.step(dt).expect("a step");
    }
}

fn bytes(flow: &Flow) -> Vec<u8> {
    let mut state = Vec::new();
    flow.save(&mut state).expect("memory does not fail");
    state
}

/// Explicit coupling goes on from the loads, a body that hangs on a prescribed one from what that does.
#[test]
fn restarts_of_other_bodies_make_the_same_bits() {
    let bar: RigidBody = toml::from_str(
        "name = 'bar'\ncentre = [0, 0]
         joint = { kind = 'prescribed', angle = { times = [0, 1], values = [0, 0.7] } }",
    )
    .expect("a bar");
    let hung = disc("{ kind = 'revolute', at = [0.2, 0], to = 'bar', spring = { stiffness = 2 } }");
    let free = RigidBody { mass: Some(30.0), ..disc("{ kind = 'free' }") };
    for (bodies, coupling) in
        [(vec![bar, hung], Coupling::Monolithic), (vec![free], Coupling::Explicit)]
    {
        let new = || flow(bodies.clone(), coupling);
        let mut whole = new();
        steps(&mut whole, 0.05);
        whole.forget_factor();
        let mut resumed = new();
        resumed.restore(&mut bytes(&whole).as_slice()).expect("a sound checkpoint");
        assert_eq!(whole.surface_load("bottom"), resumed.surface_load("bottom"));
        for flow in [&mut whole, &mut resumed] {
            steps(flow, 0.04);
        }
        assert!(bytes(&whole) == bytes(&resumed), "{coupling:?}");
    }
}

/// After a step that failed the flow of the step before is saved, and goes on.
#[test]
fn a_failed_step_leaves_no_trace() {
    for coupling in [Coupling::Monolithic, Coupling::Explicit] {
        let free = RigidBody { mass: Some(30.0), ..disc("{ kind = 'free' }") };
        let [mut whole, mut failed] = [0, 1].map(|_| flow(vec![free.clone()], coupling));
        for flow in [&mut whole, &mut failed] {
            steps(flow, 0.05);
            flow.forget_factor();
        }
        let error = failed.step(30.0).expect_err("it is too long").to_string();
        assert!(error.contains("meets `top`"), "{coupling:?}: {error}");
        let mut resumed = flow(vec![free.clone()], coupling);
        resumed.restore(&mut bytes(&failed).as_slice()).expect("a sound checkpoint");
        assert!(bytes(&whole) == bytes(&failed), "{coupling:?}: what is saved");
        failed.forget_factor();
        for flow in [&mut whole, &mut failed, &mut resumed] {
            flow.step(0.05).expect("a step");
        }
        assert!(bytes(&whole) == bytes(&failed), "{coupling:?}");
        assert!(bytes(&whole) == bytes(&resumed), "{coupling:?}");
    }
}

/// Two cylinders side by side in a closed box.
fn pair(bodies: Vec<RigidBody>) -> Result<Flow, FlowError> {
    let channel: Channel = toml::from_str(
        "x = [-4, 4]\ny = [-4, 4]\nsize = 0.8\ngrowth = 0.3
         [[bodies]]\nname = 'one'\nsize = 0.2\nshape = { kind = 'disc', centre = [-1, 0], radius = 0.5 }
         [[bodies]]\nname = 'two'\nsize = 0.2\nshape = { kind = 'disc', centre = [1, 0], radius = 0.5 }",
    )
    .expect("a channel");
    let names = ["left", "right", "bottom", "top", "one", "two"];
    Flow::new(FlowSetup {
        mesh: PlanarMesh::new(channel.mesh().expect("a mesh")).expect("a sound mesh"),
        parameters: fluid(ViscousForm::Stress),
        conditions: names.map(|name| (name.to_owned(), Condition::NoSlip)).into(),
        start: FlowStart::Rest,
        motion: FlowMotion::Bodies(BodySetup { bodies, ..BodySetup::default() }),
        parallel: false,
    })
}

/// A cylinder of the pair on a spring that is slack at `rest`, in m.
fn sliding(name: &str, x: f64, rest: f64) -> RigidBody {
    let text = format!(
        "name = '{name}'\nmass = 1\ncentre = [{x}, 0]\nboundary = '{name}'
         joint = {{ kind = 'prismatic', along = [1, 0], spring = {{ stiffness = 20, rest = {rest} }} }}"
    );
    toml::from_str(&text).expect("a body")
}

#[test]
fn bodies_that_start_in_each_other_or_outside_are_refused() {
    for (start, with) in [(-1.6, "one"), (3.2, "right"), (30.0, "right")] {
        let mut body = sliding("two", 1.0, 0.0);
        body.start.position = vec![start];
        let said = pair(vec![sliding("one", -1.0, 0.0), body]).err().expect("an error");
        let FlowError::Collision { with: met, .. } = &said else { panic!("{start}: {said}") };
        let pair = said.to_string().contains("`one` meets `two`");
        assert!(met == with || pair && with == "one", "{start}: {said}");
    }
}

/// Springs pull two free bodies to each other: alike, until no cell between them is left.
#[test]
fn bodies_that_come_together_are_an_error() {
    let mut flow =
        pair(vec![sliding("one", -1.0, 2.0), sliding("two", 1.0, -2.0)]).expect("a flow");
    let error = (0..100).find_map(|_| flow.step(0.02).err()).expect("they meet").to_string();
    let q = flow.bodies().expect("bodies").position();
    assert!(q[0] > 0.3 && (q[0] + q[1]).abs() < 1e-4, "{q:?}");
    assert!(error.contains("the boundary `one` is") && error.contains("m from `two`"), "{error}");
}

/// Whatever explicit coupling of light bodies leads to: it is said that it does, with fixed and with adaptive steps.
#[test]
fn explicit_coupling_of_light_bodies_says_so() {
    let control = StepControl { tolerance: 0.02, shortest: 1e-4, longest: 0.05, velocity: 0.1 };
    for mass in [0.3, 1e-3, 1e-9] {
        let light = || {
            let disc = disc("{ kind = 'cartesian' }");
            flow(vec![RigidBody { mass: Some(mass), ..disc }], Coupling::Explicit)
        };
        let (mut fixed, mut adaptive) = (light(), light());
        let errors = [
            (0..300).find_map(|_| fixed.step(0.01).err()),
            (0..2000).find_map(|_| adaptive.step_towards(2.0, &control).err()),
        ];
        for error in errors {
            let said = error.expect("it blows up").to_string();
            assert!(said.contains("take the monolithic coupling"), "{mass}: {said}");
        }
    }
}
