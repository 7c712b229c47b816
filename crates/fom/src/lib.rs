//! Full-order models of flows with moving bodies.
//!
//! The [`Piston`] is the Burgers equation coupled with a block on a spring, paper §4. This crate
//! knows neither POD nor reduced models, and writes nothing to files or to the terminal.

mod checkpoint;
pub mod coupling;
mod disjoint_sets;
pub mod flow;
pub mod linear;
pub mod motion;
mod piston;
pub mod signal;
mod time_scheme;

pub use checkpoint::CheckpointError;
pub use piston::{Forcing, InitialFlow, Piston, PistonError, PistonParameters, PistonStep};
pub use time_scheme::TimeScheme;
