//! The triangular factor by Householder reflections, recursive over columns.
//!
//! faer's own factorisation takes a column for dependent when `16 n eps` of its norm is left after
//! the reflections before it, and what is left then goes missing from R: small singular values are
//! wrong by that much. Here every column is reflected, so that R is right to round-off.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::householder as reflection;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::{Accum, Conj, Mat, MatMut, MatRef, Par};

/// The factor R of `a = Q R`, with min(rows, columns) rows.
pub(crate) fn triangular_factor(mut a: Mat<f64>) -> Mat<f64> {
    let (rows, columns) = a.shape();
    reflect(a.as_mut());
    Mat::from_fn(rows.min(columns), columns, |i, j| if i <= j { a[(i, j)] } else { 0.0 })
}

/// Leaves R in the upper triangle and the reflections `I - v vᵀ/tau` under it, `v = (1, ...)`.
/// Returns the numbers tau: infinite where there was nothing to reflect.
fn reflect(a: MatMut<'_, f64>) -> Vec<f64> {
    if a.ncols() == 1 {
        let (mut head, tail) = a.col_mut(0).split_at_row_mut(1);
        return vec![reflection::make_householder_in_place(&mut head[0], tail).tau];
    }
    let half = (a.ncols() / 2).min(a.nrows());
    let (mut left, mut right) = a.split_at_col_mut(half);
    let mut tau = reflect(left.as_mut());
    apply(left.as_ref(), &tau, right.as_mut());
    let below = right.split_at_row_mut(half).1;
    if below.nrows() > 0 {
        tau.extend(reflect(below));
    }
    tau
}

/// `b <- Qᵀ b` with `Q = I - V T Vᵀ`, where the inverse of T is the upper triangle of `Vᵀ V` with
/// the tau on its diagonal.
fn apply(v: MatRef<'_, f64>, tau: &[f64], b: MatMut<'_, f64>) {
    use BlockStructure::{Rectangular, UnitTriangularLower, UnitTriangularUpper};
    let (rows, size) = v.shape();
    let (top, bottom) = v.split_at_row(size);
    let mut t = Mat::<f64>::zeros(size, size);
    for (accum, part, lower, upper) in [
        (Accum::Replace, top, UnitTriangularLower, UnitTriangularUpper),
        (Accum::Add, bottom, Rectangular, Rectangular),
    ] {
        let (out, vt) = (t.as_mut(), part.transpose());
        triangular::matmul(out, UnitTriangularUpper, accum, vt, upper, part, lower, 1.0, Par::Seq);
    }
    tau.iter().enumerate().for_each(|(k, &tau)| t[(k, k)] = tau);
    let scratch = reflection::apply_block_householder_transpose_on_the_left_in_place_scratch::<f64>(
        rows,
        size,
        b.ncols(),
    );
    reflection::apply_block_householder_transpose_on_the_left_in_place_with_conj(
        v,
        t.as_ref(),
        Conj::No,
        b,
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(rows: usize, columns: usize) -> Mat<f64> {
        Mat::from_fn(rows, columns, |i, j| (0.7 * i as f64 + 1.9 * (j * j) as f64).sin())
    }

    #[test]
    fn r_is_triangular_with_the_gram_matrix_of_a() {
        for (rows, columns) in [(40, 1), (40, 7), (9, 9), (5, 12), (1, 3)] {
            let a = matrix(rows, columns);
            let r = triangular_factor(a.clone());
            assert_eq!(r.shape(), (rows.min(columns), columns));
            assert!((0..r.nrows()).all(|i| (0..i).all(|j| r[(i, j)] == 0.0)));
            let defect = (r.transpose() * &r - a.transpose() * &a).norm_max();
            assert!(defect < 1e-13, "{rows} x {columns}: {defect:e}");
        }
    }

    /// A column that nearly depends on another: its remainder is kept.
    #[test]
    fn a_small_remainder_is_not_dropped() {
        let (n, tiny) = (2000, 1e-13);
        let a = Mat::from_fn(n, 2, |i, j| {
            if i == 0 {
                1.0
            } else if j == 1 && i == n - 1 {
                tiny
            } else {
                0.0
            }
        });
        let r = triangular_factor(a);
        assert!((r[(1, 1)].abs() / tiny - 1.0).abs() < 1e-12, "{:e}", r[(1, 1)]);
    }

    #[test]
    fn zero_columns_are_no_obstacle() {
        let mut a = matrix(30, 6);
        a.col_mut(0).fill(0.0);
        a.col_mut(4).fill(0.0);
        let r = triangular_factor(a.clone());
        let defect = (r.transpose() * &r - a.transpose() * &a).norm_max();
        assert!(defect < 1e-13, "{defect:e}");
    }
}
