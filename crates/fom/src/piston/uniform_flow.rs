//! Geometric conservation: whatever the mesh does, uniform flow stays uniform.

use super::{InitialFlow, Piston, PistonError, PistonParameters};
use crate::TimeScheme;
use lumley_body::joint::Prismatic;

const SCHEMES: [TimeScheme; 3] =
    [TimeScheme::ImplicitEuler, TimeScheme::CrankNicolson, TimeScheme::Bdf2];
const SPEED: f64 = 0.37;

/// A free block in a stream that flows with it; the wall lets the stream through.
fn stream(degree: usize, scheme: TimeScheme) -> Result<Piston, PistonError> {
    let parameters = PistonParameters {
        viscosity: 0.2,
        domain_length: 1.1,
        force_factor: 1.0,
        joint: Prismatic { mass: 0.5, stiffness: 0.0, damping: 0.0, rest_length: 0.0 },
        initial_position: 0.3,
        initial_velocity: SPEED,
        initial_flow: InitialFlow::Linear,
    };
    let mut piston = Piston::new(&parameters, 50, degree, scheme)?;
    piston.now.u.fill(SPEED);
    piston.start()?;
    Ok(piston)
}

#[test]
fn uniform_flow_is_kept_while_block_and_mesh_move_with_it() -> Result<(), PistonError> {
    for scheme in SCHEMES {
        for degree in [1, 2] {
            let mut piston = stream(degree, scheme)?;
            for _ in 0..200 {
                piston.step(0.01)?;
            }
            let drift = piston.velocities().map(|u| (u - SPEED).abs()).fold(0.0, f64::max);
            assert!(drift < 1e-13, "{scheme:?}, degree {degree}: {drift:e}");
            assert!((piston.interface() - 0.3 - 2.0 * SPEED).abs() < 1e-12);
            assert!(piston.traction().abs() < 1e-11, "{}", piston.traction());
        }
    }
    Ok(())
}
