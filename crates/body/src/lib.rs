//! Rigid bodies that a flow moves: joints with springs and dampers, and the motion that loads cause.
//!
//! This crate knows no fluid, no mesh and no file. The full-order models add its residuals to their
//! Newton systems; the reduced models call the same functions for their interface conditions.

pub mod joint;
mod state;

pub use state::BodyState;
