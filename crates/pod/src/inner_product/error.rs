/// Why a matrix or a list of weights makes no inner product.
///
/// ```
/// use lumley_pod::{Diagonal, InnerProductError};
/// let error = Diagonal::new(vec![1.0, 0.0]);
/// assert!(matches!(error, Err(InnerProductError::Weight { index: 1, .. })));
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum InnerProductError {
    /// A weight of a diagonal product is not positive and finite.
    #[error("weight {index}, counted from 0, is {value}: every weight must be positive and finite")]
    Weight {
        /// Index of the weight, from 0.
        index: usize,
        /// The weight.
        value: f64,
    },
    /// The matrix has no square shape.
    #[error("a weight matrix of {rows} x {columns}: it must be square")]
    NotSquare {
        /// Rows.
        rows: usize,
        /// Columns.
        columns: usize,
    },
    /// A triplet stands outside of the matrix.
    #[error(
        "entry ({row}, {column}), counted from 0, lies outside of the {size} x {size} weight matrix"
    )]
    Outside {
        /// Row of the triplet, from 0.
        row: usize,
        /// Column of the triplet, from 0.
        column: usize,
        /// Order of the matrix.
        size: usize,
    },
    /// An entry is NaN or infinite.
    #[error(
        "entry ({row}, {column}) of the weight matrix, counted from 0, is {value}: it must be finite"
    )]
    NonFinite {
        /// Row, from 0.
        row: usize,
        /// Column, from 0.
        column: usize,
        /// What stands there.
        value: f64,
    },
    /// The matrix differs from its transpose.
    #[error(
        "the weight matrix is not symmetric: ({row}, {column}), counted from 0, holds {value} but \
         its mirror holds {mirror}; give both triangles"
    )]
    NotSymmetric {
        /// Row, from 0.
        row: usize,
        /// Column, from 0.
        column: usize,
        /// What stands there.
        value: f64,
        /// What stands at (column, row).
        mirror: f64,
    },
    /// The matrix is indefinite, or singular to working precision.
    #[error(
        "the weight matrix is not positive definite (found at unknown {index}, counted from 0): \
         a mass matrix of unknowns without support, or a stiffness matrix that is not held, is singular"
    )]
    NotPositiveDefinite {
        /// The unknown at which the factorisation found it, from 0.
        index: usize,
    },
    /// The factorisation does not fit into memory.
    #[error("the Cholesky factor of the {size} x {size} weight matrix does not fit into memory")]
    Memory {
        /// Order of the matrix.
        size: usize,
    },
}
