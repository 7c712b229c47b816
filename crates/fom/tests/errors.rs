//! What is refused, and what a failed step says.

mod canonical;

use lumley_fom::{Forcing, InitialFlow, Piston, PistonError, PistonParameters, TimeScheme};

fn build(parameters: &PistonParameters) -> Result<Piston, PistonError> {
    Piston::new(parameters, 20, 1, TimeScheme::Bdf2)
}

/// The message with which parameters are refused, after one change to the canonical ones.
fn refusal(change: impl FnOnce(&mut PistonParameters)) -> String {
    let mut parameters = canonical::parameters(1.0);
    change(&mut parameters);
    build(&parameters).expect_err("out of range").to_string()
}

#[test]
fn quantities_out_of_range_are_named() {
    for bad in [f64::NAN, f64::INFINITY, -1.0] {
        let found = [
            (refusal(|p| p.viscosity = bad), "viscosity"),
            (refusal(|p| p.domain_length = bad), "domain length"),
            (refusal(|p| p.force_factor = bad), "force factor"),
            (refusal(|p| p.joint.mass = bad), "mass"),
            (refusal(|p| p.joint.stiffness = bad), "stiffness"),
            (refusal(|p| p.joint.damping = bad), "damping"),
            (refusal(|p| p.initial_position = bad), "initial position"),
        ];
        for (message, name) in found {
            assert!(message.starts_with(&format!("{name} is {bad}")), "{message}");
        }
    }
    assert!(refusal(|p| p.joint.rest_length = f64::NAN).starts_with("rest length is NaN m"));
    assert!(refusal(|p| p.initial_velocity = f64::NAN).starts_with("initial velocity is NaN m/s"));
    let sine = InitialFlow::Sine(f64::INFINITY);
    assert!(refusal(|p| p.initial_flow = sine).starts_with("initial flow amplitude is inf m/s"));
    assert!(refusal(|p| p.viscosity = 0.0).starts_with("viscosity is 0 m²/s"));
    assert!(refusal(|p| p.initial_position = 1.1).contains("below 1.1 m"));
}

#[test]
fn tables_are_checked() {
    let table = |rows: &[(f64, f64)]| {
        let rows = rows.to_vec();
        refusal(|p| p.initial_flow = InitialFlow::Table(rows))
    };
    assert!(table(&[(0.0, 0.0)]).contains("1 rows"));
    assert!(table(&[(0.0, 0.0), (0.5, 0.1), (0.5, 0.2), (0.9, 0.0)]).contains("row 3"));
    assert!(table(&[(0.0, 0.0), (0.5, f64::NAN), (0.9, 0.0)]).contains("row 2"));
    assert!(table(&[(0.1, 0.0), (0.9, 0.0)]).contains("covers 0.1 m to 0.9 m"));
    assert!(table(&[(0.0, 0.0), (0.8, 0.0)]).contains("covers 0 m to 0.8 m"));
    assert!(table(&[(0.0, 0.2), (0.9, 0.0)]).contains("0.2 m/s at x = 0 m"));
    assert!(table(&[(0.0, 0.0), (0.9, 0.2)]).contains("expected 0 m/s"));
}

#[test]
fn tables_are_taken_as_they_are() -> Result<(), PistonError> {
    let mut parameters = canonical::parameters(1.0);
    parameters.initial_velocity = -0.3;
    parameters.initial_flow = InitialFlow::Table(vec![(0.0, 0.0), (0.3, 0.6), (1.0, -0.45)]);
    let piston = build(&parameters)?;
    for (x, u) in [(0.0, 0.0), (0.09, 0.18), (0.27, 0.54), (0.9, -0.3), (1.05, -0.3)] {
        assert!((piston.velocity_at(x) - u).abs() < 1e-14, "{x}: {}", piston.velocity_at(x));
    }
    Ok(())
}

#[test]
fn meshes_and_steps_are_checked() {
    let parameters = canonical::parameters(1.0);
    let mesh = |cells, degree| {
        Piston::new(&parameters, cells, degree, TimeScheme::Bdf2).expect_err("a bad mesh")
    };
    assert_eq!(mesh(1, 1), PistonError::Cells { cells: 1, largest: 1_000_000 });
    assert!(matches!(mesh(usize::MAX, 2), PistonError::Cells { .. }));
    assert_eq!(mesh(10, 0), PistonError::Degree(0));
    assert_eq!(mesh(10, 3), PistonError::Degree(3));
    let mut piston = build(&parameters).expect("the canonical piston");
    for dt in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        assert!(matches!(piston.step(dt), Err(PistonError::Step(_))), "{dt}");
    }
    assert_eq!(piston.time(), 0.0);
}

#[test]
fn leaving_the_domain_is_an_error_with_the_time() {
    for (velocity, beyond) in [(8.0, 1.1), (-20.0, 0.0)] {
        let parameters = PistonParameters {
            initial_velocity: velocity,
            initial_flow: InitialFlow::Linear,
            ..canonical::parameters(0.0)
        };
        let mut piston = build(&parameters).expect("a fast piston");
        let error = (0..1000).find_map(|_| piston.step(1e-3).err()).expect("it leaves");
        let PistonError::InterfaceLeft { time, position, domain_length } = error else {
            panic!("{error}");
        };
        assert_eq!(domain_length, 1.1);
        assert!((position - beyond) * velocity > 0.0, "{position}");
        let (exact, _) = parameters.joint.free_motion(0.9, velocity, time);
        assert!((position - exact).abs() < 1e-3, "{position} {exact}");
        // The failed step left the piston where it was.
        assert!((time - piston.time() - 1e-3).abs() < 1e-12);
        assert!(piston.interface() > 0.0 && piston.interface() < 1.1);
    }
}

/// A step far too long for the flow: Newton's method wanders, and says so.
#[test]
fn newton_that_does_not_converge_shows_its_residuals() {
    let parameters = PistonParameters {
        viscosity: 1e-6,
        initial_flow: InitialFlow::Sine(50.0),
        ..canonical::parameters(0.0)
    };
    let mut piston =
        Piston::new(&parameters, 20, 1, TimeScheme::ImplicitEuler).expect("a good start");
    let error = piston.step(1.0).expect_err("a step too long");
    let message = error.to_string();
    assert!(message.starts_with("Newton's method did not converge at t = 1 s"), "{message}");
    let PistonError::NotConverged { time, residuals, tolerance } = error else {
        panic!("{error}");
    };
    assert_eq!(time, 1.0);
    assert!(residuals.len() > 5 && residuals.iter().all(|r| *r > tolerance), "{residuals:?}");
    assert_eq!(piston.time(), 0.0);
}

#[derive(Debug)]
struct Broken;

impl Forcing for Broken {
    fn fluid(&self, _: f64, t: f64) -> f64 {
        if t < 0.015 { 0.0 } else { f64::NAN }
    }
}

#[test]
fn values_that_are_not_finite_are_an_error() {
    let parameters = canonical::parameters(1.0);
    for degree in [1, 2] {
        let forcing = Box::new(Broken);
        let mut piston = Piston::forced(&parameters, 20, degree, TimeScheme::Bdf2, forcing)
            .expect("finite at the start");
        piston.step(0.01).expect("still finite");
        assert_eq!(piston.step(0.01), Err(PistonError::NonFinite { time: 0.02 }));
        assert_eq!(piston.time(), 0.01);
    }
    let wild = InitialFlow::Sine(1e200);
    let parameters = PistonParameters { initial_flow: wild, ..parameters };
    assert_eq!(build(&parameters).expect_err("overflow"), PistonError::NonFinite { time: 0.0 });
}
