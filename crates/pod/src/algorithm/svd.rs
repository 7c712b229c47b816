use super::lift::lift;
use super::snapshots::Temporal;
use crate::correlation::{Correlation, Preconditioner, correlation};
use crate::dense::{self, PivotedCholesky, product};
use crate::run::Run;
use crate::{
    Decomposition, Execution, InnerProduct, ModeStore, Options, PodError, ReducedBasis,
    SnapshotSource,
};
use faer::{Mat, MatRef};

/// The bi-orthogonal decomposition (Aubry, 1991; Hemon and Santi, 2003), exact.
///
/// ```text
/// F X = Q A,   A = U Sigma Vᵀ,   Phi_n = X v_n / sigma_n,   lambda_n = sigma_n² / M
/// ```
///
/// A comes from two Gram matrices. The pivoted Cholesky factor of the first tells the columns apart
/// as far as squares can (to 1e-8 of each), and makes of them nearly orthogonal columns
/// `Y = F X P U⁻¹`, formed block by block; what the first could not tell apart is small in Y, hence
/// known to another 1e-8 of that from the second, `Yᵀ Y = Rᵀ R`, and `A = R U Pᵀ`. Where all columns are far from
/// dependent the first is enough. Errors are relative to each column of X: singular values are right to
/// a few `eps sigma_1` on any spectrum, and to `eps` of themselves where it is the columns that
/// are graded, as in a decaying transient. Where the inner product couples all rows, entries that
/// are right to `eps` of themselves leave an error of `4 eps sqrt(M sum_i W_ii <u_i²>)` instead.
///
/// Cost 3 n M² flops and three passes over the snapshots; where the inner product couples all
/// rows, one weighted copy of the snapshots is held in memory.
///
/// # Errors
/// Every variant of [`PodError`] but those about other algorithms.
///
/// ```
/// use lumley_pod::{Identity, MemorySnapshots, Options, Truncation, svd};
/// let x = faer::mat![[3.0, 0.0], [0.0, 4.0]];
/// let options = Options { truncation: Truncation::Modes(1), ..Options::default() };
/// let basis = svd(&MemorySnapshots::new(x, vec![0.0, 1.0]), &Identity::new(2), &options)?;
/// assert!((basis.eigenvalues[0] - 8.0).abs() < 1e-14);
/// # Ok::<(), lumley_pod::PodError>(())
/// ```
pub fn svd(
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
) -> Result<ReducedBasis, PodError> {
    super::in_memory(stream, x, w, options)
}

pub(crate) fn stream(
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
    execution: Execution<'_>,
    modes: &dyn ModeStore,
) -> Result<Decomposition, PodError> {
    super::with_rows(x, w, options, execution, modes, &decompose)
}

pub(crate) fn decompose(run: &Run<'_>) -> Result<Decomposition, PodError> {
    let first = correlation(run, "correlation", None)?;
    lift("svd", run, bi_orthogonal(run, &first, WELL_CONDITIONED)?)
}

/// Least eigenvalue of the Gram matrix of columns of norm one with which its factor is right to a few eps.
const WELL_CONDITIONED: f64 = 0.05;

/// Singular values and right singular vectors, from the correlation and as many further passes as it
/// takes.
///
/// * `sufficient`: least eigenvalue of the Gram matrix of columns of norm one with which the first
///   correlation is enough; its singular values are then right to `M eps` over twice this
pub(super) fn bi_orthogonal(
    run: &Run<'_>,
    first: &Correlation,
    sufficient: f64,
) -> Result<Temporal, PodError> {
    let (n, m) = run.ensemble.shape();
    let a = triangular(run, first, sufficient)?;
    let found = run.agreed(|| {
        let (sigma, vectors) = dense::right_svd(a.as_ref())?;
        let lambda = sigma.iter().map(|s| s * s / m as f64);
        Ok(lambda.chain(vectors.col_iter().flat_map(|v| v.iter().copied())).collect())
    })?;
    let (lambda, vectors) = found.split_at(m);
    let spectrum = run.ensemble.spectrum(lambda[..m.min(n)].to_vec(), first.steady, None)?;
    Ok(Temporal { spectrum, vectors: MatRef::from_column_major_slice(vectors, m, m).to_owned() })
}

/// A with `Aᵀ A = Xᵀ W X`, not squared.
fn triangular(run: &Run<'_>, first: &Correlation, sufficient: f64) -> Result<Mat<f64>, PodError> {
    let (n, m) = run.ensemble.shape();
    // Round-off of sums over many rows and eliminations over many columns adds up as noise does.
    let floor = 8.0 * f64::EPSILON * (m as f64).sqrt();
    let coarse = PivotedCholesky::new(first.matrix.as_ref(), floor);
    let enough = run.agreed(|| {
        let all = coarse.resolved == m.min(n) && m <= n;
        Ok(vec![f64::from(u8::from(all && least_angle(&coarse, sufficient)? >= sufficient))])
    })?;
    if enough == [1.0] {
        return Ok(in_original_order(coarse.factor().as_ref(), &coarse.order));
    }
    let preconditioner = Preconditioner { order: coarse.order, unit: coarse.unit };
    let second = correlation(run, "refinement", Some(&preconditioner))?;
    let fine = PivotedCholesky::new(second.matrix.as_ref(), 4.0 * f64::EPSILON);
    let unit = Mat::from_fn(m, m, |i, j| preconditioner.unit[(fine.order[i], j)]);
    let a = product(fine.factor().as_ref(), unit.as_ref());
    Ok(in_original_order(a.as_ref(), &preconditioner.order))
}

/// Least eigenvalue of the Gram matrix of the columns scaled to norm one; zero where a pivot already
/// tells that it is less than `sufficient`.
fn least_angle(cholesky: &PivotedCholesky, sufficient: f64) -> Result<f64, PodError> {
    let factor = cholesky.factor();
    let norms: Vec<f64> = factor.col_iter().map(|column| column.norm_l2()).collect();
    if cholesky.scale.iter().zip(&norms).any(|(d, norm)| d * d < sufficient * norm * norm) {
        return Ok(0.0);
    }
    let unit = Mat::from_fn(factor.nrows(), factor.ncols(), |i, j| factor[(i, j)] / norms[j]);
    let (eigenvalues, _) =
        dense::eigen_descending(product(unit.transpose(), unit.as_ref()).as_ref())?;
    Ok(eigenvalues.last().copied().unwrap_or(0.0))
}

/// The columns `a P` where `order` tells P.
pub(crate) fn in_original_order(a: MatRef<'_, f64>, order: &[usize]) -> Mat<f64> {
    let mut original = Mat::zeros(a.nrows(), a.ncols());
    for (from, &to) in a.col_iter().zip(order) {
        original.col_mut(to).copy_from(from);
    }
    original
}
