//! Rigid bodies that a flow moves: joints with springs and dampers, and the motion that loads cause.
//!
//! This crate knows no fluid, no mesh and no file. The full-order models add its residuals to their
//! Newton systems; the reduced models call the same functions for their interface conditions.
//!
//! - the piston's block on its spring: [`joint::Prismatic`];
//! - bodies in the plane: [`RigidBody`] is what a case file says, [`Tree`] the checked bodies with their joints,
//!   [`Kinematics`] where they are and how their points move with the generalised coordinates, [`Equations`] their
//!   equations of motion with all derivatives;
//! - without a fluid: [`ImplicitScheme`], [`RungeKutta`].

mod energy;
mod equations;
mod frame;
mod integrate;
pub mod joint;
mod kinematics;
mod planar;
mod rigid_body;
mod square;
mod state;
mod tree;

pub use energy::Energy;
pub use equations::{Equations, Load};
pub use integrate::{DynamicsError, ImplicitScheme, RateFormula, RungeKutta};
pub use kinematics::{JacobianColumn, Kinematics, Placement};
pub use planar::Point;
pub use rigid_body::{Displaced, RigidBody, UniformShape};
pub use square::Square;
pub use state::BodyState;
pub use tree::{Coordinate, PrescribedError, Tree, TreeError};
