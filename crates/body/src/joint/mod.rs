//! Joints and supports: how a body may move and what holds it.

mod error;
mod prismatic;

pub use error::JointError;
pub use prismatic::Prismatic;
