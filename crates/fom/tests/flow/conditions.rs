//! Boundary conditions: what they let through, and what they refuse.

use super::exact;
use super::setups::{Kind, Wobble, errors, mesh, order, parameters};
use lumley_fem::{MeshDescription, PlanarMesh, Point};
use lumley_fom::TimeScheme;
use lumley_fom::flow::{
    Condition, Flow, FlowError, FlowMotion, FlowParameters, FlowSetup, FlowStart, Linearisation,
    SteadyLimits, StepControl, VectorField, ViscousForm,
};
use std::sync::Arc;

fn given(field: impl VectorField + 'static) -> Condition {
    Condition::Velocity(Arc::new(field))
}

fn fluid(form: ViscousForm) -> FlowParameters {
    let linearisation = Linearisation::default();
    FlowParameters { body_force: None, ..parameters(TimeScheme::Bdf2, form, linearisation) }
}

/// A flow with the conditions of bottom, right, top and left.
fn flow(
    mesh: PlanarMesh,
    parameters: FlowParameters,
    conditions: [Condition; 4],
    start: FlowStart,
    motion: FlowMotion,
) -> Result<Flow, FlowError> {
    let names = ["bottom", "right", "top", "left"].map(str::to_owned);
    let conditions = names.into_iter().zip(conditions).collect();
    Flow::new(FlowSetup { mesh, parameters, conditions, start, motion, parallel: false })
}

fn rectangle(cells: [usize; 2], size: Point) -> PlanarMesh {
    let cut = |[i, j]: [usize; 2]| (i + j) % 3 == 0;
    let mesh = MeshDescription::structured(cells, cut, |[x, y]| [size[0] * x, size[1] * y]);
    PlanarMesh::new(mesh).expect("a rectangle")
}

/// The geometric conservation law: a uniform flow stays, whatever the mesh does.
#[test]
fn a_moving_mesh_keeps_a_uniform_flow() {
    let stream = |_: Point, _: f64| [0.7, -0.4];
    for scheme in [TimeScheme::ImplicitEuler, TimeScheme::Bdf2] {
        let grid = mesh(Kind::Both, 6);
        let motion = Wobble::of(&grid, 9.0);
        let parameters = FlowParameters { scheme, ..fluid(ViscousForm::Stress) };
        let sides = [given(stream), Condition::TractionFree, given(stream), given(stream)];
        let start = FlowStart::Velocity(Arc::new(stream));
        let mut flow =
            flow(grid, parameters, sides, start, FlowMotion::Given(motion)).expect("a flow");
        for k in 0..12 {
            flow.step(if k % 3 == 0 { 0.04 } else { 0.05 }).expect("a step");
            let away = flow.velocity().iter().map(|u| (u[0] - 0.7).hypot(u[1] + 0.4));
            let away = away.fold(0.0, f64::max);
            assert!(away < 2e-11, "{scheme:?}, step {k}: {away:e}");
        }
    }
}

/// The outlets of both forms are what they say: with the traction of the exact flow taken off, nothing is left.
#[test]
fn a_free_boundary_carries_no_traction() {
    // Couette flow along a channel has no stress across its ends, in either form but the shear: σ n = μ u_y e_y.
    let shear = |[_, y]: Point, _: f64| [y, 0.0];
    let expected = [(ViscousForm::Laplacian, true), (ViscousForm::Stress, false)];
    for (form, stays) in expected {
        let sides = [given(shear), Condition::TractionFree, given(shear), given(shear)];
        let start = FlowStart::Velocity(Arc::new(shear));
        let mut flow =
            flow(rectangle([6, 4], [2.0, 1.0]), fluid(form), sides, start, FlowMotion::Still)
                .expect("a flow");
        flow.settle(SteadyLimits::default(), |_, _| {}).expect("a steady flow");
        let pairs = flow.velocity().iter().zip(flow.dof_points());
        let away = pairs.map(|(u, p)| (u[0] - p[1]).hypot(u[1])).fold(0.0, f64::max);
        assert_eq!(away < 1e-9, stays, "{form:?}: {away:e}");
    }
}

/// Poiseuille flow between a wall and its line of symmetry, which slips; driven by gravity round a periodic channel.
#[test]
fn slip_and_periodic_boundaries() {
    let with = |name: &str| Condition::Periodic { with: name.into() };
    for cells in [[3, 4], [1, 2]] {
        let mut parameters = fluid(ViscousForm::Stress);
        parameters.body_force = Some(Arc::new(|_: Point, _: f64| [0.5, -9.81]));
        let factor = 0.5 * parameters.density / parameters.viscosity;
        let sides = [Condition::NoSlip, with("left"), Condition::Slip, with("right")];
        let mut flow = flow(
            rectangle(cells, [0.8, 0.6]),
            parameters,
            sides,
            FlowStart::Rest,
            FlowMotion::Still,
        )
        .expect("a flow");
        flow.settle(SteadyLimits::default(), |_, _| {}).expect("a steady flow");
        for (u, &[_, y]) in flow.velocity().iter().zip(flow.dof_points()) {
            let away = (u[0] - factor * y * (0.6 - 0.5 * y)).hypot(u[1]);
            assert!(away < 1e-8, "{cells:?}: {away:e} at y = {y}");
        }
        // All of the force along the channel goes to the wall, all of the weight to the two.
        let [bottom, _, top, _] = [0, 1, 2, 3].map(|k| flow.loads()[k].force);
        let mass = exact::DENSITY * 0.48;
        assert!((bottom[0] - 0.5 * mass).abs() < 1e-8 && top[0].abs() < 1e-8, "{bottom:?} {top:?}");
        assert!((bottom[1] + top[1] + 9.81 * mass).abs() < 1e-7, "{bottom:?} {top:?}");
    }
}

/// Rigid rotation slips along a curved wall: its stress vanishes, so that it goes on for ever.
#[test]
fn slip_on_a_curved_wall_lets_nothing_through() {
    let ring = |[x, y]: Point| {
        let (sin, cos) = (-std::f64::consts::FRAC_PI_2 * x).sin_cos();
        [(1.0 + y) * cos, (1.0 + y) * sin]
    };
    let turn = |[x, y]: Point, _: f64| [-y, x];
    let errors = [4, 8].map(|n| {
        let mesh = MeshDescription::structured([2 * n, n], |[i, _]| i % 2 == 0, ring);
        let mesh = PlanarMesh::new(mesh).expect("a quarter of a ring");
        let sides = [Condition::Slip, given(turn), Condition::Slip, given(turn)];
        let start = FlowStart::Velocity(Arc::new(turn));
        let mut flow = flow(mesh, fluid(ViscousForm::Stress), sides, start, FlowMotion::Still)
            .expect("a flow");
        flow.settle(SteadyLimits::default(), |_, _| {}).expect("a steady flow");
        let pairs = flow.velocity().iter().zip(flow.dof_points());
        pairs.map(|(u, p)| (u[0] + p[1]).hypot(u[1] - p[0])).fold(0.0, f64::max)
    });
    let order = order(errors[0], errors[1]);
    assert!(errors[1] < 5e-4 && order > 2.8, "{errors:?}, order {order}");
}

/// A vortex that comes back in through the outlet does not blow up.
#[test]
fn backflow_at_an_outlet_stays_bounded() {
    let jet = |[_, y]: Point, _: f64| [20.0 * y * (1.0 - y), 0.0];
    let swirl = |[x, y]: Point, _: f64| {
        let (x, y) = (x - 1.7, y - 0.5);
        let decay = 60.0 * (-12.0 * (x * x + y * y)).exp();
        [-decay * y, decay * x]
    };
    let mut parameters = fluid(ViscousForm::Laplacian);
    parameters.viscosity = 2e-3;
    let sides = [Condition::NoSlip, Condition::TractionFree, Condition::NoSlip, given(jet)];
    let start = FlowStart::Velocity(Arc::new(swirl));
    let mut flow =
        flow(rectangle([24, 12], [2.0, 1.0]), parameters, sides, start, FlowMotion::Still)
            .expect("a flow");
    for _ in 0..150 {
        flow.step(0.01).expect("a step");
    }
    let largest = flow.velocity().iter().map(|u| u[0].hypot(u[1])).fold(0.0, f64::max);
    assert!(largest < 20.0, "{largest} m/s");
}

/// No outlet: the pressure has mean zero, and what flows in must flow out.
#[test]
fn a_closed_domain_levels_its_pressure_and_counts_its_flux() {
    let sides = [0, 1, 2, 3].map(|_| given(exact::velocity));
    let start = || FlowStart::Velocity(Arc::new(exact::velocity));
    let flow_in =
        flow(mesh(Kind::Both, 8), fluid(ViscousForm::Stress), sides, start(), FlowMotion::Still);
    let mut closed = flow_in.expect("a flow");
    assert!(closed.has_level_pressure());
    closed.step(0.1).expect("a step");
    assert!(errors(&closed)[0] < 0.1);

    let sides = [Condition::NoSlip, Condition::NoSlip, Condition::NoSlip, given(|_, _| [1.0, 0.0])];
    let mut blocked = flow(
        rectangle([3, 3], [1.0, 1.0]),
        fluid(ViscousForm::Stress),
        sides,
        FlowStart::Rest,
        FlowMotion::Still,
    )
    .expect("a flow");
    let error = blocked.step(0.1).expect_err("nowhere to go").to_string();
    assert!(error.contains("no boundary is traction-free"), "{error}");
}

/// A lid that slides along its own line lets nothing through, however the cavity is turned.
#[test]
fn a_turned_cavity_has_no_flux() {
    let (sin, cos) = 0.7_f64.sin_cos();
    let turned = MeshDescription::structured(
        [3, 3],
        |_| false,
        |[x, y]| [cos * x - sin * y, sin * x + cos * y],
    );
    let lid = given(move |_: Point, _: f64| [cos, sin]);
    let sides = [Condition::NoSlip, Condition::NoSlip, lid, Condition::NoSlip];
    let mesh = PlanarMesh::new(turned).expect("a square");
    let mut flow =
        flow(mesh, fluid(ViscousForm::Stress), sides, FlowStart::Rest, FlowMotion::Still)
            .expect("a flow");
    flow.step(0.1).expect("a step");
}

/// Two squares that share nothing: the pressure of each would be undetermined.
#[test]
fn parts_without_outlet_are_refused() {
    let square = |x: f64| MeshDescription::structured([2, 2], |_| false, move |p| [p[0] + x, p[1]]);
    let (mut mesh, other) = (square(0.0), square(5.0));
    let shift = mesh.points.len();
    mesh.points.extend(other.points);
    mesh.quadrilaterals.extend(other.quadrilaterals.iter().map(|cell| cell.map(|k| k + shift)));
    for (boundary, more) in mesh.boundaries.iter_mut().zip(&other.boundaries) {
        boundary.edges.extend(more.edges.iter().map(|edge| edge.map(|k| k + shift)));
    }
    let mesh = PlanarMesh::new(mesh).expect("two squares");
    let closed = [0, 1, 2, 3].map(|_| Condition::NoSlip);
    let found =
        flow(mesh.clone(), fluid(ViscousForm::Stress), closed, FlowStart::Rest, FlowMotion::Still);
    assert!(matches!(found.err(), Some(FlowError::Parts { parts: 2, cell: 0 })));
    let open = [0, 1, 2, 3].map(|_| Condition::TractionFree);
    flow(mesh, fluid(ViscousForm::Stress), open, FlowStart::Rest, FlowMotion::Still)
        .expect("each has an outlet");
}

/// A ramp from rest: errors are relative to the velocity that counts.
#[test]
fn adaptive_steps_follow_a_ramp() {
    let ramp = |[_, y]: Point, t: f64| [4.0 * y * (1.0 - y) * (1.5 * t).sin().powi(2), 0.0];
    let sides = [Condition::NoSlip, Condition::TractionFree, Condition::NoSlip, given(ramp)];
    let mut flow = flow(
        rectangle([6, 4], [2.0, 1.0]),
        fluid(ViscousForm::Laplacian),
        sides,
        FlowStart::Rest,
        FlowMotion::Still,
    )
    .expect("a flow");
    let control = StepControl { tolerance: 2e-3, shortest: 1e-4, longest: 0.1, velocity: 0.1 };
    let mut steps = 0;
    // The stop just after another costs a step, not the length of those that follow.
    for end in [0.5, 0.500_01, 1.0] {
        while flow.time() < end - 1e-12 {
            flow.step_towards(end, &control).expect("a step");
            steps += 1;
        }
    }
    assert!(steps < 120, "{steps}");
}

#[test]
fn bad_setups_are_refused() {
    let grid = || rectangle([3, 3], [1.0, 1.0]);
    let free = || Condition::TractionFree;
    let periodic = |name: &str| Condition::Periodic { with: name.into() };
    let refused = |mesh, sides| {
        let found =
            flow(mesh, fluid(ViscousForm::Stress), sides, FlowStart::Rest, FlowMotion::Still);
        found.err().expect("a bad setup").to_string()
    };
    let message = refused(grid(), [free(), periodic("left"), free(), free()]);
    assert!(message.contains("`right` and `left`") && message.contains("too"), "{message}");
    let message = refused(grid(), [free(), periodic("right"), free(), free()]);
    assert!(message.contains("its own partner"), "{message}");
    let message = refused(grid(), [periodic("nowhere"), free(), free(), free()]);
    assert!(message.contains("nowhere"), "{message}");
    let bent = refused(mesh(Kind::Both, 4), [free(), periodic("left"), free(), periodic("right")]);
    assert!(bent.contains("do not meet"), "{bent}");
    let sides = [free(), free(), free(), given(|_, _| [f64::NAN, 0.0])];
    let setup = flow(grid(), fluid(ViscousForm::Stress), sides, FlowStart::Rest, FlowMotion::Still);
    let error = setup.expect("sound but for its numbers").step(0.1).expect_err("no number");
    assert!(matches!(error, FlowError::NotFinite { .. }), "{error}");
    let error = Flow::step(&mut plain(), f64::NAN).expect_err("no step");
    assert!(matches!(error, FlowError::Step { .. }), "{error}");
}

fn plain() -> Flow {
    let sides = [0, 1, 2, 3].map(|_| Condition::TractionFree);
    flow(
        rectangle([3, 3], [1.0, 1.0]),
        fluid(ViscousForm::Stress),
        sides,
        FlowStart::Rest,
        FlowMotion::Still,
    )
    .expect("a flow")
}
