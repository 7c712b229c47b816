//! Small dense problems, always on one thread: their blocking, hence their last bits, would
//! otherwise depend on the number of threads.

mod cholesky;
mod jacobi;

pub(crate) use cholesky::PivotedCholesky;
use jacobi::graded_svd;

use crate::PodError;
use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{
    LltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::evd::{ComputeEigenvectors, self_adjoint_evd, self_adjoint_evd_scratch};
use faer::linalg::matmul::matmul;
use faer::linalg::svd::{ComputeSvdVectors, SvdParams, svd, svd_scratch};
use faer::linalg::triangular_solve::solve_upper_triangular_in_place;
use faer::reborrow::ReborrowMut;
use faer::{Accum, Auto, Mat, MatRef, Par, Spec};

/// Eigenvalues, largest first, and eigenvectors of a symmetric matrix.
pub(crate) fn eigen_descending(a: MatRef<'_, f64>) -> Result<(Vec<f64>, Mat<f64>), PodError> {
    let size = a.nrows();
    if !a.is_all_finite() {
        return Err(PodError::Overflow);
    }
    let (mut values, mut vectors) = (Diag::<f64>::zeros(size), Mat::zeros(size, size));
    let yes = ComputeEigenvectors::Yes;
    let scratch = self_adjoint_evd_scratch::<f64>(size, yes, Par::Seq, Spec::default());
    self_adjoint_evd(
        a,
        values.as_mut(),
        Some(vectors.as_mut()),
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        Spec::default(),
    )
    .map_err(|_| PodError::NoConvergence { size })?;
    let descending = values.column_vector().iter().rev().copied().collect();
    Ok((descending, vectors.as_ref().reverse_cols().to_owned()))
}

/// Singular values, largest first, and right singular vectors of a square matrix: each value right to
/// itself where the columns are graded, else to a few eps of the first, which takes a third of the time.
pub(crate) fn right_svd(a: MatRef<'_, f64>) -> Result<(Vec<f64>, Mat<f64>), PodError> {
    const GRADED: f64 = 1e-3;
    let norms = || a.col_iter().map(|column| column.norm_l2()).filter(|norm| *norm > 0.0);
    let (least, largest) = (norms().fold(f64::INFINITY, f64::min), norms().fold(0.0, f64::max));
    if !a.squared_norm_l2().is_finite() {
        return Err(PodError::Overflow);
    }
    if least < GRADED * largest {
        return graded_svd(a);
    }
    bidiagonal_svd(a)
}

/// Singular values, largest first, and right singular vectors, both right to a few eps of the first.
fn bidiagonal_svd(a: MatRef<'_, f64>) -> Result<(Vec<f64>, Mat<f64>), PodError> {
    let (rows, columns) = a.shape();
    let size = rows.min(columns);
    let (mut values, mut right) = (Diag::<f64>::zeros(size), Mat::zeros(columns, size));
    let (no, thin) = (ComputeSvdVectors::No, ComputeSvdVectors::Thin);
    let scratch = svd_scratch::<f64>(rows, columns, no, thin, Par::Seq, without_qr());
    svd(
        a,
        values.as_mut(),
        None,
        Some(right.as_mut()),
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        without_qr(),
    )
    .map_err(|_| PodError::NoConvergence { size })?;
    Ok((values.column_vector().iter().copied().collect(), right))
}

/// Orthonormal columns, of which the first k span what the first k columns of `a` do (Gram-Schmidt, twice).
/// Where a column adds nothing, zeros stand in its place.
pub(crate) fn orthonormal(a: MatRef<'_, f64>) -> Mat<f64> {
    let mut q = a.to_owned();
    for k in 0..q.ncols() {
        let (before, rest) = q.as_mut().split_at_col_mut(k);
        let mut column = rest.col_mut(0);
        for _ in 0..2 {
            for q in before.as_ref().col_iter() {
                let along = q.transpose() * column.as_ref();
                column.rb_mut().iter_mut().zip(q.iter()).for_each(|(x, q)| *x -= along * q);
            }
            let norm = column.norm_l2();
            if norm > 0.0 {
                column.rb_mut().iter_mut().for_each(|x| *x /= norm);
            }
        }
    }
    q
}

/// `A B` on one thread.
pub(crate) fn product(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    let mut c = Mat::zeros(a.nrows(), b.ncols());
    matmul(c.as_mut(), Accum::Replace, a, b, 1.0, Par::Seq);
    c
}

/// Whether columns with this Gram matrix are independent once they have norm one: the least eigenvalue of
/// their correlation is above `least`. So it is if the correlation less that is positive definite.
pub(crate) fn are_independent(gram: MatRef<'_, f64>, least: f64) -> bool {
    let size = gram.nrows();
    let norms: Vec<f64> = (0..size).map(|k| gram[(k, k)].sqrt()).collect();
    let mut shifted = Mat::from_fn(size, size, |i, j| {
        let correlation = gram[(i, j)] / norms[i] / norms[j];
        if i == j { correlation - least } else { correlation }
    });
    let scratch = cholesky_in_place_scratch::<f64>(size, Par::Seq, Spec::default());
    let factored = cholesky_in_place(
        shifted.as_mut(),
        LltRegularization::default(),
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        Spec::default(),
    );
    factored.is_ok() && norms.iter().all(|norm| *norm > 0.0)
}

/// The upper triangular factor R of `G = Rᵀ R`, or nothing where G is not positive definite to working
/// precision.
pub(crate) fn cholesky_upper(g: MatRef<'_, f64>) -> Option<Mat<f64>> {
    let size = g.ncols();
    let mut r = Mat::<f64>::zeros(size, size);
    for j in 0..size {
        for i in 0..=j {
            let known: f64 = (0..i).map(|k| r[(k, i)] * r[(k, j)]).sum();
            let left = g[(i, j)] - known;
            r[(i, j)] = if i < j { left / r[(i, i)] } else { left.sqrt() };
        }
        if r[(j, j)] <= 0.0 || r[(j, j)].is_nan() {
            return None;
        }
    }
    Some(r)
}

/// The inverse of a square upper triangular matrix, or nothing where it is singular.
pub(crate) fn upper_inverse(r: MatRef<'_, f64>) -> Option<Mat<f64>> {
    let size = r.ncols();
    if r.nrows() < size || (0..size).any(|k| r[(k, k)] == 0.0) {
        return None;
    }
    let mut inverse = Mat::identity(size, size);
    solve_upper_triangular_in_place(r, inverse.as_mut(), Par::Seq);
    Some(inverse)
}

/// Long matrices would go through faer's QR first, which drops columns under `16 rows eps` of the largest.
fn without_qr() -> Spec<SvdParams, f64> {
    let mut params: SvdParams = Auto::<f64>::auto();
    params.qr_ratio_threshold = f64::INFINITY;
    params.into()
}
