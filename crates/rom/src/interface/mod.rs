//! Interface conditions of the fixed grid: what ties the reduced velocity to the body.
//!
//! Smooth modes of the global velocity have at the interface the middle of the slope's jump, so the
//! Galerkin system alone does not know that the fluid sticks to the body. A new condition is one file
//! here and one variant of [`ProjectionKind`](crate::ProjectionKind).

mod corrected;
mod multiplier;
mod penalty;
mod printed;

pub(crate) use corrected::Corrected;
pub use multiplier::Multiplier;
pub use penalty::Penalty;
pub(crate) use printed::Printed;

use crate::basis::dot;
use crate::piston::{Motion, PistonPhysics};
use crate::projection::Response;

/// What an interface condition sees: modes and reduced velocity at the interface X.
///
/// The arrays have one entry for each function of the basis; those of a frozen mean are zero,
/// because no equation is tested with it.
#[derive(Debug)]
pub(crate) struct Interfacial {
    /// `Φ_n(X)`, in m^(-1/2).
    pub mode: Vec<f64>,
    /// `int_X^L Φ_n dx`, in m^(1/2).
    pub solid: Vec<f64>,
    /// `int_0^L Φ_n dx`, in m^(1/2).
    pub whole: Vec<f64>,
    /// `v_N(X)`, in m/s.
    pub velocity: f64,
    /// `v_N,x(X-)`, the slope in the cut cell, in 1/s.
    pub shear: f64,
    /// Position and velocity of the body.
    pub body: Motion,
}

impl Interfacial {
    /// `v_N(X) − X'`: how much the fluid slips, in m/s.
    pub fn slip(&self) -> f64 {
        self.velocity - self.body.velocity
    }

    /// Mobility of the slip: minus what a unit of interface force τ adds to its rate,
    /// `|Φ|² + (1 − Φ.s) c_F/m` with `Φ = Φ(X)` and `s_n = int_X^L Φ_n`, in 1/m.
    pub fn mobility(&self, physics: &PistonPhysics) -> f64 {
        let recoil =
            (1.0 - dot(&self.mode, &self.solid)) * physics.force_factor / physics.joint.mass;
        dot(&self.mode, &self.mode) + recoil
    }
}

/// Where the viscous integral of the projected equations is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ViscousForm {
    /// `ν int_0^L Φ_n' v' dx`. Exact: v' = 0 in the solid, and the jump of the slope at X is the
    /// interface force.
    Whole,
    /// `ν int_0^X Φ_n' v' dx + boundary ν v'(X-) Φ_n(X)`.
    Fluid {
        /// Factor of the boundary term: −1 by partial integration, +2 as printed in (38).
        boundary: f64,
    },
}

/// Closes the projected equations at the interface.
pub(crate) trait Interface: Send + Sync {
    /// Form of the viscous term.
    fn viscous_form(&self) -> ViscousForm {
        ViscousForm::Whole
    }

    /// The traction on the body and its acceleration; `rates` holds `−(B a a)_n − viscous_n` on
    /// entry and `a_n'` on return.
    fn couple(&self, at: &Interfacial, physics: &PistonPhysics, rates: &mut [f64]) -> Response;
}

/// `rates += factor * direction`.
fn add_scaled(rates: &mut [f64], factor: f64, direction: &[f64]) {
    for (rate, d) in rates.iter_mut().zip(direction) {
        *rate += factor * d;
    }
}

/// `a' += X'' s + τ Φ(X)` with the block's acceleration under τ: the end of every condition that
/// acts by an interface force.
fn apply_force(
    traction: f64,
    at: &Interfacial,
    physics: &PistonPhysics,
    rates: &mut [f64],
) -> Response {
    let acceleration = physics.acceleration(at.body, traction);
    add_scaled(rates, acceleration, &at.solid);
    add_scaled(rates, traction, &at.mode);
    Response { traction, acceleration }
}
