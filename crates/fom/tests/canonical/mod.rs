//! The canonical piston, shared by the tests.

use lumley_body::joint::Prismatic;
use lumley_fom::{InitialFlow, PistonParameters};

/// The paper's constants; `force_factor` 0 is case A, 1 is case B.
pub fn parameters(force_factor: f64) -> PistonParameters {
    PistonParameters {
        viscosity: 0.2,
        domain_length: 1.1,
        force_factor,
        joint: Prismatic { mass: 0.5, stiffness: 39.5, damping: 0.1, rest_length: 0.95 },
        initial_position: 0.9,
        initial_velocity: 0.0,
        initial_flow: InitialFlow::Zero,
    }
}
