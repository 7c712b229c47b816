//! Projections: from modes to the rates of their coefficients.
//!
//! A new projection is one file here and one variant of [`ProjectionKind`].

mod fixed_grid;
mod mapped;
mod prefix;
mod quadratic;

use crate::basis::{Basis, Frame};
use crate::closure::ClosureKind;
use crate::interface::{Corrected, Interface, Multiplier, Penalty, Printed};
use crate::piston::{Motion, PistonPhysics};
use crate::{ModelChoice, ReducedError};
use fixed_grid::FixedGrid;
use mapped::Mapped;
use serde::{Deserialize, Serialize};

/// The body's side of an evaluation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Response {
    /// τ, the fluid's `ν u_x(X-)`, in m²/s².
    pub traction: f64,
    /// X'', in m/s².
    pub acceleration: f64,
}

/// A Galerkin system with the body in it.
pub(crate) trait Projection: Send + Sync {
    /// Writes `a'` for the coefficients `a`, the frozen one of a mean included (its rate is zero), and
    /// returns the traction and the body's acceleration.
    fn rates(&mut self, body: Motion, a: &[f64], rates: &mut [f64]) -> Response;
}

/// The projections of a case file, by their key `projection`.
///
/// ```
/// use lumley_rom::{ModelChoice, ProjectionKind};
/// let model: ModelChoice = toml::from_str(r#"projection = "mapped""#)?;
/// assert_eq!(model.projection, ProjectionKind::Mapped {});
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "projection", rename_all = "kebab-case", deny_unknown_fields)]
pub enum ProjectionKind {
    /// Fixed grid, (37)(38) as printed: blows up, kept for comparison.
    Printed {},
    /// Fixed grid, (37)(38) corrected, the interface free: inaccurate, kept for comparison.
    Corrected {},
    /// Fixed grid, the interface held by a multiplier (c2).
    Multiplier(Multiplier),
    /// Fixed grid, the interface held by a penalty (c3).
    Penalty(Penalty),
    /// Reference frame ξ = x/X: nothing to hold, constant tensors, the most accurate.
    Mapped {},
}

impl ProjectionKind {
    /// The name in a case file.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Printed {} => "printed",
            Self::Corrected {} => "corrected",
            Self::Multiplier(_) => "multiplier",
            Self::Penalty(_) => "penalty",
            Self::Mapped {} => "mapped",
        }
    }

    /// Whether its modes live in the reference frame ξ = x/X of the fluid, made by
    /// [`Basis::on_reference`], and not on a fixed grid.
    pub fn reference_frame(&self) -> bool {
        matches!(self, Self::Mapped {})
    }

    pub(crate) fn validate(&self) -> Result<(), ReducedError> {
        match self {
            Self::Multiplier(c) => ReducedError::check_positive("beta", c.beta, "1/s"),
            Self::Penalty(c) => ReducedError::check_positive("sigma", c.sigma, "m/s"),
            Self::Printed {} | Self::Corrected {} | Self::Mapped {} => Ok(()),
        }
    }

    /// The condition at the interface; the reference frame needs none.
    fn interface(self) -> Option<Box<dyn Interface>> {
        match self {
            Self::Printed {} => Some(Box::new(Printed)),
            Self::Corrected {} => Some(Box::new(Corrected)),
            Self::Multiplier(c) => Some(Box::new(c)),
            Self::Penalty(c) => Some(Box::new(c)),
            Self::Mapped {} => None,
        }
    }
}

/// Builds the Galerkin system of `model` on `basis`.
pub(crate) fn project(
    model: &ModelChoice,
    physics: &PistonPhysics,
    basis: &Basis,
) -> Result<Box<dyn Projection>, ReducedError> {
    let expected = match (model.projection.interface(), basis.frame()) {
        (Some(interface), Frame::Grid) => {
            return Ok(Box::new(FixedGrid::new(*physics, model.closure, interface, basis)?));
        }
        (None, Frame::Reference) => {
            return Ok(Box::new(Mapped::new(*physics, model.closure, basis)));
        }
        (Some(_), Frame::Reference) => "a fixed grid of the whole domain",
        (None, Frame::Grid) => "the reference frame of the fluid",
    };
    Err(ReducedError::Frame { projection: model.projection.name(), expected })
}

/// `rates −= closure(viscous)` in the equations of the modes; a frozen mean has no equation.
fn subtract_viscous(closure: ClosureKind, frozen: usize, viscous: &mut [f64], rates: &mut [f64]) {
    use crate::closure::Closure;
    closure.correct(&mut viscous[frozen..]);
    for (rate, v) in rates.iter_mut().zip(viscous) {
        *rate -= *v;
    }
    rates[..frozen].fill(0.0);
}

#[cfg(test)]
mod tests;
