use thiserror::Error;

/// The matrix is singular, as far as the precision of the factorisation can tell.
///
/// ```
/// use lumley_fom::linear::SingularMatrix;
/// let error = SingularMatrix { unknown: 7, pivot: 0.0, least: 1e-15 };
/// assert!(error.to_string().contains("unknown 7"));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error(
    "the matrix is singular to working precision: the pivot of unknown {unknown} is {pivot:e}, \
     at least {least:e} was expected; is a pressure or a boundary condition missing?"
)]
pub struct SingularMatrix {
    /// The unknown whose column has no pivot left.
    pub unknown: usize,
    /// Absolute value of the largest pivot to be had.
    pub pivot: f64,
    /// The round-off that a pivot must exceed.
    pub least: f64,
}
