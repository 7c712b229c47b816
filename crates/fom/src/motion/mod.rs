//! Mesh motion, paper eqs. (24) and (25): nodes follow the boundaries that move and stay on those that do
//! not; in between they take a share of the motion that solves Laplace's equation.
//!
//! The shares are found once, on the mesh as it was given, so that nodes depend on where the bodies are and on
//! nothing else: a periodic motion brings the mesh back, a restart needs no history, and a step costs no
//! solve (departure 11 in `docs/deviations.md`).

mod error;
mod follow;
mod laplace;
mod mesh_motion;
mod outline;
mod parameters;
mod prescribed;
mod rigid_motion;
mod rigid_velocity;
mod stiffness;
mod zone;

pub use error::MotionError;
pub(crate) use error::rounded;
pub use follow::Motion;
pub use mesh_motion::{MeshMotion, MovingBoundary};
pub use parameters::MotionParameters;
pub use prescribed::{MotionFunction, PrescribedMotion};
pub use rigid_motion::RigidMotion;
pub use rigid_velocity::RigidVelocity;
pub use stiffness::Stiffness;
