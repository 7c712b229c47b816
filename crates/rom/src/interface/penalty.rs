use super::{Interface, Interfacial, apply_force};
use crate::piston::PistonPhysics;
use crate::projection::Response;
use serde::{Deserialize, Serialize};

/// Interface penalty (c3): an interface force against the slip of the fluid on the body.
///
/// ```text
/// a_n' + (B a a)_n + ν (G a)_n = X'' int_X^L Φ_n dx + τ Φ_n(X),   τ = −σ (v_N(X) − X')
/// ```
///
/// Explicit RK4 needs `(σ (|Φ|² + (1 − Φ.s) c_F/m) + ν ρ(G)) dt < 2.78`, with Φ at X,
/// `s_n = int_X^L Φ_n` and ρ the spectral radius.
///
/// ```
/// use lumley_rom::Penalty;
/// assert_eq!(Penalty::default().sigma, 100.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Penalty {
    /// σ, in m/s: interface force per slip velocity.
    pub sigma: f64,
}

impl Default for Penalty {
    fn default() -> Self {
        Self { sigma: 100.0 }
    }
}

impl Interface for Penalty {
    fn couple(&self, at: &Interfacial, physics: &PistonPhysics, rates: &mut [f64]) -> Response {
        apply_force(-self.sigma * at.slip(), at, physics, rates)
    }
}
