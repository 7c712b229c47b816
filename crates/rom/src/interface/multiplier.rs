use super::{Interface, Interfacial, apply_force};
use crate::basis::dot;
use crate::piston::PistonPhysics;
use crate::projection::Response;
use serde::{Deserialize, Serialize};

/// Interface multiplier (c2): the interface force that makes the slip decay, Baumgarte's way.
///
/// The force τ of the equations of [`Penalty`](super::Penalty) is the one for which
///
/// ```text
/// d/dt (v_N(X) − X') = −β (v_N(X) − X')
/// ```
///
/// holds exactly. With `r_n = −(B a a)_n − ν (G a)_n`, `α0` the block's acceleration without fluid, Φ at X and
/// `s_n = int_X^L Φ_n`:
///
/// ```text
/// τ = −[Φ.r + (Φ.s − 1) α0 + X' v_N,x(X) + β (v_N(X) − X')] / [|Φ|² − (Φ.s − 1) c_F/m]
/// ```
///
/// ```
/// use lumley_rom::Multiplier;
/// assert_eq!(Multiplier::default().beta, 50.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Multiplier {
    /// β, in 1/s: rate at which a slip decays.
    pub beta: f64,
}

impl Default for Multiplier {
    fn default() -> Self {
        Self { beta: 50.0 }
    }
}

impl Interface for Multiplier {
    fn couple(&self, at: &Interfacial, physics: &PistonPhysics, rates: &mut [f64]) -> Response {
        let free = physics.acceleration(at.body, 0.0);
        let slip_rate = dot(&at.mode, rates)
            + (dot(&at.mode, &at.solid) - 1.0) * free
            + at.body.velocity * at.shear;
        let traction = -(slip_rate + self.beta * at.slip()) / at.mobility(physics);
        apply_force(traction, at, physics, rates)
    }
}
