//! Reduced-order models: a flow with a moving body projected on few POD modes, paper section 4.
//!
//! The paper's Galerkin system (37)(38) needs care that the paper does not take: where the viscous
//! integral ends, what ties the reduced velocity to the body, and which frame the modes live in.
//! Each answer is a choice ([`ModelChoice`]) of a projection, an interface condition and a closure;
//! [`ReducedPiston`] runs any of them on the same physics with the same [`Integrator`].
//!
//! This crate knows no moving mesh, no full-order solver and no file.

mod basis;
mod choice;
mod closure;
mod error;
mod integrator;
mod interface;
mod piston;
mod projection;

#[cfg(test)]
mod manufactured;

pub use basis::Basis;
pub use choice::ModelChoice;
pub use closure::{ClosureKind, EddyViscosity};
pub use error::{Divergence, ReducedError};
pub use integrator::{Integrator, Rosenbrock};
pub use interface::{Multiplier, Penalty};
pub use piston::{PistonPhysics, PistonStart, ReducedPiston};
pub use projection::ProjectionKind;
