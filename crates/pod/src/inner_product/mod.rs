//! Inner products `(u, v) = uᵀ W v`, one file each.

mod cholesky;
mod diagonal;
mod error;
mod identity;
mod sparse;

pub use diagonal::Diagonal;
pub use error::InnerProductError;
pub use identity::Identity;
pub use sparse::SparseSpd;

use faer::MatMut;

/// The inner product `(u, v) = uᵀ W v` of the space in which the modes are orthonormal, paper eq. (6).
///
/// `W = Fᵀ F` is symmetric positive definite. The three operations work in place on the rows
/// `first..first + x.nrows()` of a block of columns. Where W ties rows together
/// ([`couples_rows`](Self::couples_rows)) these rows are always all of them: only whole columns
/// have a product then, and what reads by blocks of rows must know.
pub trait InnerProduct: Sync {
    /// Length n of a snapshot.
    fn dim(&self) -> usize;
    /// Whether a row of `W x` depends on other rows of `x`.
    fn couples_rows(&self) -> bool;
    /// `x <- W x`.
    fn apply(&self, first: usize, x: MatMut<'_, f64>);
    /// `x <- F x`: the exact routes need it.
    fn factor(&self, first: usize, x: MatMut<'_, f64>);
    /// `x <- F⁻¹ x`.
    fn unfactor(&self, first: usize, x: MatMut<'_, f64>);
}
