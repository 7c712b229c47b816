//! Linear solvers of the full-order models.

mod bordered;

pub use bordered::{BorderRow, BorderedTridiagonal, CellMatrix};
