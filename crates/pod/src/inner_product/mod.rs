//! Inner products `(u, v) = uᵀ W v`, one file each.

mod cholesky;
mod diagonal;
mod error;
mod identity;
mod kronecker;
mod sparse;

pub use diagonal::Diagonal;
pub use error::InnerProductError;
pub use identity::Identity;
pub use kronecker::{Kronecker, Tridiagonal};
pub use sparse::SparseSpd;

use crate::contiguous::gather;
use faer::{MatMut, MatRef};
use std::io;
use std::ops::Range;

/// Which rows of x a row of `F x` depends on.
///
/// ```
/// use lumley_pod::{Identity, InnerProduct, Reach};
/// assert_eq!(Identity::new(3).reach(), Reach::Rows(0));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reach {
    /// Row i and at most this many rows after it: x can be read by blocks of rows.
    Rows(usize),
    /// All rows: only whole columns have a factor.
    All,
}

/// The inner product `(u, v) = uᵀ W v` of the space in which the modes are orthonormal, paper eq. (6).
///
/// `W = Fᵀ F` is symmetric positive definite. The operations work in place on a block of columns, each of
/// which is contiguous (those of this crate panic where they are not), and may read weights from a file,
/// hence fail as files do.
///
/// ```
/// use faer::{MatMut, Scale};
/// use lumley_pod::{InnerProduct, Reach};
/// use std::{io, ops::Range};
/// /// A uniform grid of n cells of area 0.25 m².
/// struct Uniform(usize);
/// impl InnerProduct for Uniform {
///     fn dim(&self) -> usize { self.0 }
///     fn reach(&self) -> Reach { Reach::Rows(0) }
///     fn diagonal(&self) -> io::Result<Vec<f64>> { Ok(vec![0.25; self.0]) }
///     fn apply(&self, mut x: MatMut<'_, f64>) -> io::Result<()> { x *= Scale(0.25); Ok(()) }
///     fn factor(&self, _: Range<usize>, mut x: MatMut<'_, f64>) -> io::Result<()> {
///         x *= Scale(0.5);
///         Ok(())
///     }
///     fn unfactor(&self, mut x: MatMut<'_, f64>) -> io::Result<()> { x *= Scale(2.0); Ok(()) }
/// }
/// let mut x = faer::mat![[2.0], [4.0]];
/// Uniform(2).factor(0..2, x.as_mut())?;
/// assert_eq!(x, faer::mat![[1.0], [2.0]]);
/// # Ok::<(), io::Error>(())
/// ```
pub trait InnerProduct: Sync {
    /// Length n of a snapshot.
    fn dim(&self) -> usize;
    /// Which rows of x a row of `F x` depends on.
    fn reach(&self) -> Reach;
    /// The n entries `W_ii`, which say how much energy a small error of each unknown has.
    ///
    /// # Errors
    /// The failure of the medium that holds the weights.
    fn diagonal(&self) -> io::Result<Vec<f64>>;
    /// `x <- W x` for whole columns.
    ///
    /// # Errors
    /// The failure of the medium that holds the weights.
    fn apply(&self, x: MatMut<'_, f64>) -> io::Result<()>;
    /// The `rows` of `F x`: they take the place of the first rows of `x`, which holds the same
    /// rows and as many after them as [`reach`](Self::reach) says and there are. What is left in
    /// those after them is of no use.
    ///
    /// # Errors
    /// The failure of the medium that holds the weights.
    fn factor(&self, rows: Range<usize>, x: MatMut<'_, f64>) -> io::Result<()>;
    /// The same for some columns of `x`, in any order, out of place: column k of `out` comes from column
    /// `columns[k]`. To be overridden where the copy can be saved.
    ///
    /// # Errors
    /// The failure of the medium that holds the weights.
    fn factor_columns(
        &self,
        rows: Range<usize>,
        x: MatRef<'_, f64>,
        columns: &[usize],
        mut out: MatMut<'_, f64>,
    ) -> io::Result<()> {
        gather(x, columns, out.as_mut());
        self.factor(rows, out)
    }
    /// `x <- F⁻¹ x` for whole columns.
    ///
    /// # Errors
    /// The failure of the medium that holds the weights.
    fn unfactor(&self, x: MatMut<'_, f64>) -> io::Result<()>;
}

/// Rows after a row that the same row of `F x` depends on. Where that is all of them, only whole columns are
/// weighted, and what is read by rows is so already.
pub(crate) fn reach_of(product: &dyn InnerProduct) -> usize {
    match product.reach() {
        Reach::Rows(after) => after,
        Reach::All => 0,
    }
}

/// The rows of x that must be read for `rows` of `F x`.
pub(crate) fn support(product: &dyn InnerProduct, rows: &Range<usize>) -> Range<usize> {
    match product.reach() {
        Reach::Rows(after) => rows.start..(rows.end + after).min(product.dim()),
        Reach::All => 0..product.dim(),
    }
}
