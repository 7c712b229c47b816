//! The maps of curved cells and edges: points, Jacobians, gradients, normals.
//!
//! Everything works on fixed arrays and allocates nothing; what belongs to the reference cell is tabulated
//! once.

mod edge;
mod mapped;
mod tabulated;

pub use edge::EdgePoint;
pub use mapped::Mapped;
pub use tabulated::Tabulated;
