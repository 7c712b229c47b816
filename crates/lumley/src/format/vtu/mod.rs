//! ParaView files: VTK XML unstructured grids of quadratic cells (`.vtu`) and their series in time (`.pvd`).
//!
//! The functions of VTK's biquadratic cells are those of the velocity, nodes in the same order: quadratic with
//! the bubble on VTK_BIQUADRATIC_TRIANGLE, biquadratic on VTK_BIQUADRATIC_QUAD. So what ParaView draws is
//! the discrete field itself, on the curved cells themselves.

mod array;
mod collection;
mod grid;
#[cfg(test)]
mod tests;

pub use array::Values;
pub use collection::Collection;
pub use grid::{Frame, VtuWriter};
