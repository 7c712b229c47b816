use super::{Interface, Interfacial, ViscousForm, add_scaled};
use crate::piston::PistonPhysics;
use crate::projection::Response;

/// The paper's system (37)(38) as printed. It blows up; kept for comparison.
///
/// ```text
/// a_n' + (B a a)_n + ν int_0^X Φ_n' v' dx + 2 ν v'(X) Φ_n(X) = X'' int_0^L Φ_n dx
/// ```
///
/// What does not hold: the sign of the boundary term (it is that of the solid's normal), its factor 2
/// (of `2 μ D(v)`, which Burgers' equation does not have) and the right-hand side (over Ω, not over the
/// solid). X'' is taken from (34) with `τ = ν v'(X-)`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Printed;

impl Interface for Printed {
    fn viscous_form(&self) -> ViscousForm {
        ViscousForm::Fluid { boundary: 2.0 }
    }

    fn couple(&self, at: &Interfacial, physics: &PistonPhysics, rates: &mut [f64]) -> Response {
        let traction = physics.viscosity * at.shear;
        let acceleration = physics.acceleration(at.body, traction);
        add_scaled(rates, acceleration, &at.whole);
        Response { traction, acceleration }
    }
}
