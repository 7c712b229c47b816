//! Loads with known answers.

use super::setups::{INNER, OUTER, fluid, order, ring};
use lumley_fem::Point;
use lumley_fom::flow::{
    Condition, Flow, FlowMotion, FlowParameters, FlowSetup, FlowStart, SteadyLimits, ViscousForm,
};
use lumley_fom::motion::{
    MeshMotion, MotionFunction, MotionParameters, MovingBoundary, PrescribedMotion, RigidMotion,
};
use std::f64::consts::PI;
use std::sync::Arc;

const SPIN: f64 = 0.8;

/// Flow between cylinders, the inner of which turns (Couette): the moment on it is `−4π μ Ω a² b²/(b² − a²)`, whatever
/// the viscous form.
#[test]
fn moment_on_a_turning_cylinder() {
    let spin = |[x, y]: Point, _: f64| [-SPIN * y, SPIN * x];
    for form in [ViscousForm::Stress, ViscousForm::Laplacian] {
        let errors = [3, 6].map(|n| {
            let parameters = fluid(form);
            let (a, b) = (INNER * INNER, OUTER * OUTER);
            let exact = -4.0 * PI * parameters.viscosity * SPIN * a * b / (b - a);
            let mut flow = Flow::new(FlowSetup {
                mesh: ring(n),
                parameters,
                conditions: vec![
                    ("bottom".into(), Condition::Velocity(Arc::new(spin))),
                    ("top".into(), Condition::NoSlip),
                ],
                start: FlowStart::Stokes,
                motion: FlowMotion::Still,
                parallel: false,
            })
            .expect("a flow");
            flow.settle(SteadyLimits::default(), |_, _| {}).expect("a steady flow");
            let inner = flow.loads()[0];
            assert!(inner.force.iter().all(|f| f.abs() < 1e-8), "{inner:?}");
            // In the fluid nothing is lost: the outer cylinder takes the moment.
            let outer = flow.loads()[1].moment;
            assert!((inner.moment + outer).abs() < 2e-3 * outer, "{form:?}: {inner:?} {outer}");
            let surface = flow.surface_load("bottom").expect("a boundary").moment;
            [inner.moment, surface].map(|moment| (moment / exact - 1.0).abs())
        });
        let order = order(errors[0][0], errors[1][0]);
        assert!(errors[1][0] < 2e-3 && order > 3.0, "{form:?}: {errors:?}, order {order}");
        assert!(errors[1][1] < 0.02, "{form:?}: {errors:?}");
    }
}

/// A cylinder that starts to move in a fluid at rest carries the added mass of the potential flow,
/// `ρ π a² (b² + a²)/(b² − a²)` between cylinders: the force of the first short step is that times V/dt, and that of
/// the layer of fluid, a cell thick, that sticks to it.
#[test]
fn impulse_of_an_impulsive_start() {
    let density = fluid(ViscousForm::Stress).density;
    let (a, b) = (INNER * INNER, OUTER * OUTER);
    let mass = density * PI * a * (b + a) / (b - a);
    let [coarse, fine] = [12, 24].map(|n| impulse(n) / mass - 1.0);
    assert!(coarse > 0.0 && fine < 0.6 * coarse, "{coarse} {fine}");
    assert!((2.0 * fine - coarse).abs() < 0.01, "{coarse} {fine}");
}

/// Force of the first step times its length, over the velocity of the cylinder.
fn impulse(n: usize) -> f64 {
    let mesh = ring(n);
    let boundary = MovingBoundary { name: "bottom".into(), pivot: [0.0, 0.0] };
    let motion = MeshMotion::new(&mesh, &[boundary], &MotionParameters::default());
    let shift = |t: f64| RigidMotion { translation: [0.1 * t, 0.0], angle: 0.0 };
    let functions: Vec<MotionFunction> = vec![Arc::new(shift)];
    let motion = PrescribedMotion::new(motion.expect("a motion"), functions).expect("one function");
    let mut flow = Flow::new(FlowSetup {
        mesh,
        parameters: FlowParameters { viscosity: 1e-6, ..fluid(ViscousForm::Stress) },
        conditions: ["bottom", "top"].map(|name| (name.into(), Condition::NoSlip)).into(),
        start: FlowStart::Rest,
        motion: FlowMotion::Given(Box::new(motion)),
        parallel: false,
    })
    .expect("a flow");
    let dt = 1e-3;
    flow.step(dt).expect("a step");
    -flow.loads()[0].force[0] * dt / 0.1
}

/// A body that turns in a closed ring: its nodes move along chords, which is no flux.
#[test]
fn a_turning_body_in_a_closed_domain() {
    let mesh = ring(4);
    let boundary = MovingBoundary { name: "bottom".into(), pivot: [0.0, 0.0] };
    let motion = MeshMotion::new(&mesh, &[boundary], &MotionParameters::default());
    let turn = |t: f64| RigidMotion { translation: [0.0; 2], angle: SPIN * t };
    let functions: Vec<MotionFunction> = vec![Arc::new(turn)];
    let motion = PrescribedMotion::new(motion.expect("a motion"), functions).expect("one function");
    let mut flow = Flow::new(FlowSetup {
        mesh,
        parameters: fluid(ViscousForm::Stress),
        conditions: ["bottom", "top"].map(|name| (name.into(), Condition::NoSlip)).into(),
        start: FlowStart::Rest,
        motion: FlowMotion::Given(Box::new(motion)),
        parallel: false,
    })
    .expect("a flow");
    for _ in 0..3 {
        flow.step(0.05).expect("a step");
    }
    assert!(flow.loads()[0].moment < 0.0, "the fluid resists");
}
