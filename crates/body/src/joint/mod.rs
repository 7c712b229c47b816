//! Joints and supports: how a body may move and what holds it.

mod prismatic;

pub use prismatic::Prismatic;
