//! Every wrong input is an error that names it.

use crate::{LENGTH, MAPPED, PENALTY, basis_for, build, grid_basis, physics, start};
use faer::Mat;
use lumley_fem::UniformGrid;
use lumley_rom::{
    Basis, ClosureKind, EddyViscosity, Integrator, ModelChoice, Multiplier, Penalty, PistonPhysics,
    PistonStart, ProjectionKind, ReducedError, ReducedPiston, Rosenbrock,
};

const RK4: Integrator = Integrator::Rk4 {};

/// The message of a construction that must fail.
fn refusal<T>(outcome: Result<T, ReducedError>) -> String {
    match outcome {
        Ok(_) => panic!("wrong input was accepted"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn unphysical_constants_are_named() {
    type Change = fn(&mut PistonPhysics);
    let cases: [(&str, Change); 9] = [
        ("viscosity is 0 m²/s", |p| p.viscosity = 0.0),
        ("viscosity is NaN m²/s", |p| p.viscosity = f64::NAN),
        ("domain_length is -1 m", |p| p.domain_length = -1.0),
        ("force_factor is -1 kg/m", |p| p.force_factor = -1.0),
        ("mass is -0.5 kg", |p| p.joint.mass = -0.5),
        ("mass is inf kg", |p| p.joint.mass = f64::INFINITY),
        ("stiffness is -3 N/m", |p| p.joint.stiffness = -3.0),
        ("damping is NaN N s/m", |p| p.joint.damping = f64::NAN),
        ("rest length is NaN m", |p| p.joint.rest_length = f64::NAN),
    ];
    for (expected, change) in cases {
        let mut physics = physics(1.0);
        change(&mut physics);
        let text = refusal(build(&physics, PENALTY, RK4, &basis_for(PENALTY)));
        assert!(text.starts_with(expected), "{text}");
    }
}

/// A spring may be slack behind the wall.
#[test]
fn a_negative_rest_length_is_physical() -> Result<(), ReducedError> {
    let mut physics = physics(1.0);
    physics.joint.rest_length = -0.1;
    build(&physics, PENALTY, RK4, &basis_for(PENALTY)).map(drop)
}

#[test]
fn parameters_out_of_range_are_named() {
    let eddy = |rate| ClosureKind::EddyViscosity(EddyViscosity { rate });
    let penalty = |sigma| ProjectionKind::Penalty(Penalty { sigma });
    let multiplier = |beta| ProjectionKind::Multiplier(Multiplier { beta });
    let none = ClosureKind::default();
    for (projection, closure, expected) in [
        (penalty(-1.0), none, "sigma is -1 m/s"),
        (penalty(f64::INFINITY), none, "sigma is inf m/s"),
        (multiplier(f64::NAN), none, "beta is NaN 1/s"),
        (multiplier(50.0), eddy(-0.1), "closure.rate is -0.1"),
    ] {
        let text = refusal(ModelChoice { projection, closure }.validate());
        assert!(text.starts_with(expected), "{text}");
    }
    let integrator = Integrator::Rosenbrock(Rosenbrock { tolerance: 0.0 });
    for text in [
        refusal(integrator.validate()),
        refusal(build(&physics(1.0), PENALTY, integrator, &basis_for(PENALTY))),
    ] {
        assert!(text.contains("integrator.tolerance is 0"), "{text}");
    }
}

#[test]
fn starts_that_do_not_fit_are_named() {
    let model = ModelChoice { projection: PENALTY, closure: ClosureKind::default() };
    let basis = basis_for(PENALTY);
    let refuse = |start: &PistonStart| {
        refusal(ReducedPiston::new(&physics(1.0), &model, RK4, &basis, start))
    };
    let cases: [(&str, PistonStart); 5] = [
        ("initial coefficients: 3 given", start(3)),
        ("initial_position is 1.1 m", PistonStart { position: 1.1, ..start(4) }),
        ("initial_position is NaN m", PistonStart { position: f64::NAN, ..start(4) }),
        ("initial_velocity is inf m/s", PistonStart { velocity: f64::INFINITY, ..start(4) }),
        ("an initial coefficient", PistonStart { coefficients: vec![f64::NAN; 4], ..start(4) }),
    ];
    for (expected, start) in cases {
        let text = refuse(&start);
        assert!(text.starts_with(expected), "{text}");
    }
}

#[test]
fn a_basis_in_the_wrong_frame_or_domain_is_refused() {
    let text = refusal(build(&physics(1.0), MAPPED, RK4, &grid_basis(61, 4)));
    assert!(text.contains("`mapped` needs modes on the reference frame"), "{text}");
    let text = refusal(build(&physics(1.0), PENALTY, RK4, &basis_for(MAPPED)));
    assert!(text.contains("`penalty` needs modes on a fixed grid"), "{text}");
    let mut longer = physics(1.0);
    longer.domain_length = 1.2;
    let text = refusal(build(&longer, PENALTY, RK4, &basis_for(PENALTY)));
    assert!(text.contains("to 1.1 m") && text.contains("domain length"), "{text}");
}

#[test]
fn bad_modes_are_refused() {
    let grid = UniformGrid::line(0.0, LENGTH, 5);
    let constant = (1.0 / LENGTH).sqrt();
    let on_grid = |modes: &Mat<f64>| refusal(Basis::on_grid(&grid, modes.as_ref(), None));
    assert!(on_grid(&Mat::zeros(5, 0)).contains("no mode"));
    assert!(on_grid(&Mat::zeros(4, 1)).contains("4 given, but there must be 5"));
    let text = on_grid(&Mat::from_fn(5, 1, |_, _| 2.0 * constant));
    assert!(text.contains("modes 1 and 1 have the inner product 4.0"), "{text}");
    let text = on_grid(&Mat::from_fn(5, 2, |_, _| constant));
    assert!(text.contains("modes 1 and 2"), "{text}");
    let hole = |i, _| if i == 3 { f64::NAN } else { constant };
    assert!(on_grid(&Mat::from_fn(5, 1, hole)).contains("a mode at node 3 is NaN"));

    let square = UniformGrid::rectangle([0.0; 2], [1.0; 2], [3, 3]);
    let text = refusal(Basis::on_grid(&square, Mat::zeros(9, 1).as_ref(), None));
    assert!(text.contains("2 dimension(s)"), "{text}");
    let modes = Mat::from_fn(5, 1, |_, _| constant);
    let text = refusal(Basis::on_grid(&grid, modes.as_ref(), Some(&[0.0; 3])));
    assert!(text.contains("the mean: 3 given"), "{text}");
    let basis = Basis::on_grid(&grid, modes.as_ref(), None).expect("one constant mode");
    assert!(refusal(basis.project(&[0.0; 4])).contains("4 given"));
}

#[test]
fn bad_reference_frames_are_refused() {
    let one = Mat::from_fn(5, 1, |_, _| 1.0);
    let refuse =
        |nodes: &[f64], degree| refusal(Basis::on_reference(nodes, degree, one.as_ref(), None));
    let even = [0.0, 0.25, 0.5, 0.75, 1.0];
    assert!(refuse(&even, 3).contains("is 3"));
    assert!(refuse(&even[..4], 2).contains("4 given, but there must be 3"));
    assert!(refuse(&[], 1).contains("0 given"));
    assert!(refuse(&[0.0, 0.3, 0.5, 0.75, 1.0], 2).contains("node 1"));
    assert!(refuse(&[0.0, 0.5, 0.25, 0.75, 1.0], 1).contains("node 2"));
    assert!(refuse(&[0.0, 0.25, 0.5, 0.75, 1.1], 1).contains("node 4"));
    assert!(refuse(&[0.0, 0.25, f64::NAN, 0.75, 1.0], 1).contains("node 2"));
    assert!(refuse(&even, 1).contains("a mode is 1e0 at the end 0"));
}

/// What round-off is depends on how large the field is.
#[test]
fn means_vanish_at_the_ends_relative_to_their_size() {
    let modes = Mat::from_fn(3, 1, |k, _| if k == 1 { 30_f64.sqrt() / 4.0 } else { 0.0 });
    let with = |mean: [f64; 3]| {
        Basis::on_reference(&[0.0, 0.5, 1.0], 2, modes.as_ref(), Some(&mean)).map(drop)
    };
    assert_eq!(with([0.0, 1e4, 1e-7]), Ok(()));
    assert_eq!(with([0.0; 3]), Ok(()));
    assert!(refusal(with([0.0, 1e-9, 5e-9])).contains("the mean is 5e-9 at the end 1"));
}

#[test]
fn bad_steps_and_samples_are_refused() -> Result<(), ReducedError> {
    let mut piston = build(&physics(1.0), PENALTY, RK4, &basis_for(PENALTY))?;
    for dt in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
        assert!(refusal(piston.step(dt)).contains("time step"), "{dt}");
    }
    let mut sample = [0.0; 3];
    let beyond = UniformGrid::line(0.0, 1.2, 3);
    assert!(refusal(piston.sample(&beyond, &mut sample)).contains("1.2 m"));
    let inside = UniformGrid::line(0.0, LENGTH, 4);
    assert!(refusal(piston.sample(&inside, &mut sample)).contains("3 given"));
    Ok(())
}
