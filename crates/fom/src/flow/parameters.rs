use super::VectorField;
use crate::TimeScheme;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::sync::Arc;

/// The weak form of the viscous term, which decides what an outlet without traction means.
///
/// ```
/// use lumley_fom::flow::ViscousForm;
/// assert_eq!(ViscousForm::default(), ViscousForm::Stress);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ViscousForm {
    /// `∫ μ (∇u + ∇uᵀ) : ∇v`: free boundaries have `σ·n = 0`, the paper's.
    #[default]
    Stress,
    /// `∫ μ ∇u : ∇v`: free boundaries have `μ ∂u/∂n = p n`, the do-nothing outlet of Schäfer and Turek (1996),
    /// which a developed channel flow leaves undisturbed.
    Laplacian,
}

/// How the convective term becomes linear.
///
/// ```
/// use lumley_fom::flow::Linearisation;
/// assert_eq!(Linearisation::default(), Linearisation::Tangent);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Linearisation {
    /// `(u*·∇) u` with the velocity u* that is extrapolated from the steps before, to the order of the time
    /// scheme: one linear system a step, the paper's.
    Extrapolation,
    /// `(u*·∇) u + (u·∇) u* − (u*·∇) u*`, one iteration of Newton's method from the extrapolated velocity: one linear
    /// system a step, and what it neglects is the square of what was extrapolated wrongly.
    #[default]
    Tangent,
    /// Newton's method: the equations hold at the new instant, whatever the step.
    Newton,
}

/// What flows, and how its equations are discretised in time.
///
/// ```
/// use lumley_fom::TimeScheme;
/// use lumley_fom::flow::{FlowParameters, Linearisation, ViscousForm};
/// let air = FlowParameters {
///     density: 1.2,
///     viscosity: 1.8e-5,
///     viscous_form: ViscousForm::Stress,
///     linearisation: Linearisation::Tangent,
///     scheme: TimeScheme::Bdf2,
///     body_force: None,
/// };
/// assert!(air.check().is_ok());
/// ```
#[derive(Clone)]
pub struct FlowParameters {
    /// Density ρ, in kg/m³.
    pub density: f64,
    /// Dynamic viscosity μ, in Pa s.
    pub viscosity: f64,
    /// Weak form of the viscous term.
    pub viscous_form: ViscousForm,
    /// How the convective term becomes linear.
    pub linearisation: Linearisation,
    /// [`TimeScheme::ImplicitEuler`] or [`TimeScheme::Bdf2`].
    pub scheme: TimeScheme,
    /// Force per mass, in m/s².
    pub body_force: Option<Arc<dyn VectorField>>,
}

impl FlowParameters {
    /// Whether these can be computed with.
    ///
    /// # Errors
    /// [`FlowError::Parameter`](super::FlowError::Parameter) and
    /// [`FlowError::Scheme`](super::FlowError::Scheme).
    pub fn check(&self) -> Result<(), super::FlowError> {
        for (name, value, unit) in
            [("density", self.density, "kg/m3"), ("viscosity", self.viscosity, "Pa s")]
        {
            if !(value.is_finite() && value > 0.0) {
                return Err(super::FlowError::Parameter { name, value, unit });
            }
        }
        match self.scheme {
            TimeScheme::CrankNicolson => Err(super::FlowError::Scheme),
            TimeScheme::ImplicitEuler | TimeScheme::Bdf2 => Ok(()),
        }
    }
}

impl fmt::Debug for FlowParameters {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FlowParameters")
            .field("density", &self.density)
            .field("viscosity", &self.viscosity)
            .field("viscous_form", &self.viscous_form)
            .field("linearisation", &self.linearisation)
            .field("scheme", &self.scheme)
            .finish_non_exhaustive()
    }
}
