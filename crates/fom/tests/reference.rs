//! The reference rows of the canonical piston: 800 cells, BDF2, steps of 5e-4 s.

mod canonical;

use lumley_fom::{Piston, PistonError, TimeScheme};

/// The probes of a canonical case: X(1), X'(1), u(0.5, 1), nu u_x(X−, 1), X(2), X'(2).
fn probes(force_factor: f64) -> Result<[f64; 6], PistonError> {
    let mut piston = Piston::new(&canonical::parameters(force_factor), 800, 1, TimeScheme::Bdf2)?;
    let run = |piston: &mut Piston| (0..2000).try_for_each(|_| piston.step(5e-4).map(drop));
    run(&mut piston)?;
    let [x, v] = [piston.interface(), piston.body().velocity[0]];
    let [u, traction] = [piston.velocity_at(0.5), piston.traction()];
    run(&mut piston)?;
    Ok([x, v, u, traction, piston.interface(), piston.body().velocity[0]])
}

const TOLERANCES: [f64; 6] = [5e-6, 5e-5, 5e-6, 1e-4, 5e-6, 5e-5];

fn compare(force_factor: f64, reference: [f64; 6]) -> Result<(), PistonError> {
    let found = probes(force_factor)?;
    for ((found, reference), tolerance) in found.iter().zip(reference).zip(TOLERANCES) {
        assert!((found - reference).abs() <= tolerance, "{found}, expected {reference}");
    }
    Ok(())
}

/// Case A: the block does not feel the fluid.
#[test]
fn driven_piston() -> Result<(), PistonError> {
    compare(0.0, [0.988_610_1, 0.205_772, 0.039_826_5, -0.167_003, 0.930_904_7, -0.319_938])
}

/// Case B: the block feels the viscous traction.
#[test]
fn coupled_piston() -> Result<(), PistonError> {
    compare(1.0, [0.951_241_1, 0.177_792, 0.003_237_8, 0.110_525, 0.959_638_1, -0.018_564])
}
