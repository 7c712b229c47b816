//! Linear solvers of the full-order models.

#![expect(
    clippy::inline_always,
    reason = "loops become vectors only inside the dispatch over instruction sets"
)]

mod bordered;
mod cells;
mod gmres;
mod kernel;
mod lagged;
mod multifrontal;
mod scalar;
mod simd;
mod vector;

pub use bordered::{BorderRow, BorderedTridiagonal, CellMatrix};
pub use cells::{CellUnknowns, CellUnknownsError};
pub use gmres::{Gmres, GmresError, GmresLimits};
pub use lagged::{LaggedError, LaggedSolver, LaggedStep, RenewalPolicy};
pub use multifrontal::{Analysis, DelayedUnknowns, Multifrontal, SingularMatrix};
pub use scalar::Scalar;
pub(crate) use simd::vectorised;
