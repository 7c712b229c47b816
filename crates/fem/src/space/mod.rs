//! Finite-element functions on a planar mesh: which unknowns a cell has and what they mean.

mod dofs;
mod linear_pressure;
mod nodal;
mod recovery;

pub use dofs::DofMap;
pub use linear_pressure::LinearPressure;
pub use nodal::NodalSpace;
pub use recovery::Recovery;
