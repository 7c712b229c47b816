//! Small dense problems, always on one thread: their blocking, hence their last bits, would
//! otherwise depend on the number of threads.

use crate::PodError;
use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{ComputeEigenvectors, self_adjoint_evd, self_adjoint_evd_scratch};
use faer::linalg::svd::{ComputeSvdVectors, SvdParams, svd, svd_scratch};
use faer::linalg::triangular_solve::solve_upper_triangular_in_place;
use faer::{Auto, Mat, MatRef, Par, Spec};

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

/// Singular values, largest first, and right singular vectors of `a`.
pub(crate) fn right_svd(a: MatRef<'_, f64>) -> Result<(Vec<f64>, Mat<f64>), PodError> {
    let (rows, columns) = a.shape();
    if !a.squared_norm_l2().is_finite() {
        return Err(PodError::Overflow);
    }
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

/// Long matrices would go through faer's QR first, which drops small columns: see the module
/// `householder`.
fn without_qr() -> Spec<SvdParams, f64> {
    let mut params: SvdParams = Auto::<f64>::auto();
    params.qr_ratio_threshold = f64::INFINITY;
    params.into()
}
