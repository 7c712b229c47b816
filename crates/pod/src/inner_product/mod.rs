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
///
/// ```
/// use faer::{MatMut, Scale};
/// use lumley_pod::InnerProduct;
/// /// A uniform grid of n cells of area 0.25 m².
/// struct Uniform(usize);
/// impl InnerProduct for Uniform {
///     fn dim(&self) -> usize { self.0 }
///     fn couples_rows(&self) -> bool { false }
///     fn diagonal(&self) -> Vec<f64> { vec![0.25; self.0] }
///     fn apply(&self, _: usize, mut x: MatMut<'_, f64>) { x *= Scale(0.25); }
///     fn factor(&self, _: usize, mut x: MatMut<'_, f64>) { x *= Scale(0.5); }
///     fn unfactor(&self, _: usize, mut x: MatMut<'_, f64>) { x *= Scale(2.0); }
/// }
/// let mut x = faer::mat![[2.0], [4.0]];
/// Uniform(2).factor(0, x.as_mut());
/// assert_eq!(x, faer::mat![[1.0], [2.0]]);
/// ```
pub trait InnerProduct: Sync {
    /// Length n of a snapshot.
    fn dim(&self) -> usize;
    /// Whether a row of `W x` depends on other rows of `x`.
    fn couples_rows(&self) -> bool;
    /// The n entries `W_ii`, which say how much energy a small error of each unknown has.
    fn diagonal(&self) -> Vec<f64>;
    /// `x <- W x`.
    fn apply(&self, first: usize, x: MatMut<'_, f64>);
    /// `x <- F x`: the exact routes need it.
    fn factor(&self, first: usize, x: MatMut<'_, f64>);
    /// `x <- F⁻¹ x`.
    fn unfactor(&self, first: usize, x: MatMut<'_, f64>);
}
