//! Without force from the fluid the block is the damped oscillator, whose motion is known.

mod canonical;

use lumley_fom::{Piston, PistonError, TimeScheme};

/// Largest error of position and velocity over a second.
fn worst_error(scheme: TimeScheme, steps: u32) -> Result<f64, PistonError> {
    let parameters = canonical::parameters(0.0);
    let mut piston = Piston::new(&parameters, 10, 1, scheme)?;
    let mut worst = 0.0_f64;
    for step in 1..=steps {
        let dt = 1.0 / f64::from(steps);
        piston.step(dt)?;
        let (x, v) = parameters.joint.free_motion(0.9, 0.0, f64::from(step) * dt);
        let found = piston.body();
        worst = worst.max((found.position[0] - x).abs()).max((found.velocity[0] - v).abs());
    }
    Ok(worst)
}

#[test]
fn motion_converges_with_the_order_of_the_scheme() -> Result<(), PistonError> {
    for (scheme, expected, accuracy) in [
        (TimeScheme::ImplicitEuler, 1.0, 0.05),
        (TimeScheme::CrankNicolson, 2.0, 5e-5),
        (TimeScheme::Bdf2, 2.0, 2e-4),
    ] {
        let [coarse, fine] = [worst_error(scheme, 1000)?, worst_error(scheme, 4000)?];
        let order = (coarse / fine).log2() / 2.0;
        assert!((order - expected).abs() < 0.1, "{scheme:?}: order {order}");
        assert!(coarse < accuracy, "{scheme:?}: {coarse:e}");
    }
    Ok(())
}
