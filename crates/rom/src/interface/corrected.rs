use super::{Interface, Interfacial, ViscousForm, add_scaled};
use crate::piston::PistonPhysics;
use crate::projection::Response;

/// The paper's system (37)(38) with its misprints corrected, and nothing that holds the interface.
///
/// ```text
/// a_n' + (B a a)_n + ν int_0^X Φ_n' v' dx − ν v'(X-) Φ_n(X) = X'' int_X^L Φ_n dx
/// ```
///
/// with the block under `τ = ν v'(X-)`. Smooth modes have half the true slope at X, and nothing ties
/// `v_N(X)` to `X'`: on the canonical piston the error reaches 115 % with 6 modes. Kept to show that.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Corrected;

impl Interface for Corrected {
    fn viscous_form(&self) -> ViscousForm {
        ViscousForm::Fluid { boundary: -1.0 }
    }

    fn couple(&self, at: &Interfacial, physics: &PistonPhysics, rates: &mut [f64]) -> Response {
        let traction = physics.viscosity * at.shear;
        let acceleration = physics.acceleration(at.body, traction);
        add_scaled(rates, acceleration, &at.solid);
        Response { traction, acceleration }
    }
}
