use super::lift::lift;
use super::sketched::{ROUND_OFF, sketched, squares_floor};
use super::snapshots::Temporal;
use crate::correlation::{Correlation, Preconditioner, correlation};
use crate::dense::{self, PivotedCholesky, are_independent, product};
use crate::kernel::Sketch;
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
/// A first pass takes a few random combinations of the rows, a sketch S of F X. A pivoted factor of S makes
/// nearly orthogonal columns `Y = F X P U⁻¹`, formed block by block, whose Gram matrix loses nothing:
/// `Yᵀ Y = Rᵀ R` and `A = R U Pᵀ`. Where there are less than about 8 M unknowns, or the sketch turns out to
/// miss a direction, the Gram matrix of F X takes its place: its factor tells the columns apart as far as
/// squares can, to 1e-8 of each, and what it could not tell apart is small in Y, hence known to another
/// 1e-8 of that. Errors are relative to each column of X: singular values are right to
/// a few `eps sigma_1` on any spectrum, and to `eps` of themselves where it is the columns that
/// are graded, as in a decaying transient. Where the inner product couples all rows, entries that
/// are right to `eps` of themselves leave an error of `4 eps sqrt(M sum_i W_ii <u_i²>)` instead.
///
/// Cost 2 n M² flops, n M² more without the sketch, and three passes over the snapshots (five where the sketch misses a direction); where the inner product couples all
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
    let (n, m) = (x.dim(), x.times().len());
    let (width, algorithm): (_, fn(&Run<'_>) -> _) =
        if sketch_pays([n, m]) { (Sketch::new(m).rows(), by_sketch) } else { (m, by_correlation) };
    super::with_sums(x, w, options, execution, modes, width, &algorithm)
}

/// A sketch costs as much as a correlation of so many rows; for thousands of snapshots it would be
/// longer than the leaves whose sums it is.
fn sketch_pays([n, m]: [usize; 2]) -> bool {
    let rows = Sketch::new(m).rows();
    4 * rows <= n && rows <= 4096
}

fn by_sketch(run: &Run<'_>) -> Result<Decomposition, PodError> {
    let Some(start) = sketched(run)? else { return by_correlation(run) };
    let second = correlation(run, "refinement", Some(&start.preconditioner))?;
    if !run.agree(|| start.is_sound(second.matrix.as_ref()))? {
        return by_correlation(run);
    }
    let a = refined(&second, &start.preconditioner, start.resolved);
    lift("svd", run, bi_orthogonal(run, a.as_ref(), second.steady)?)
}

/// The same without a sketch, for any number of rows.
pub(crate) fn by_correlation(run: &Run<'_>) -> Result<Decomposition, PodError> {
    let first = correlation(run, "correlation", None)?;
    let a = triangular(run, &first, ENOUGH)?;
    lift("svd", run, bi_orthogonal(run, a.as_ref(), first.steady)?)
}

/// Least eigenvalue of the Gram matrix of columns of norm one with which its factor is right to a few eps.
pub(super) const ENOUGH: f64 = 0.05;

/// Singular values and right singular vectors of F X, from A with `Aᵀ A = Xᵀ W X`.
///
/// * `steady`: energy of the mean that was subtracted
pub(super) fn bi_orthogonal(
    run: &Run<'_>,
    a: MatRef<'_, f64>,
    steady: f64,
) -> Result<Temporal, PodError> {
    let (n, m) = run.ensemble.shape();
    let found = run.agreed(|| {
        let (sigma, vectors) = dense::right_svd(a)?;
        let lambda = sigma.iter().map(|s| s * s / m as f64);
        Ok(lambda.chain(vectors.col_iter().flat_map(|v| v.iter().copied())).collect())
    })?;
    let (lambda, vectors) = found.split_at(m);
    let spectrum = run.ensemble.spectrum(lambda[..m.min(n)].to_vec(), steady, None)?;
    Ok(Temporal { spectrum, vectors: MatRef::from_column_major_slice(vectors, m, m).to_owned() })
}

/// A from the correlation and, where that is not enough, one further pass.
///
/// * `sufficient`: least eigenvalue of the Gram matrix of columns of norm one with which the first
///   correlation is enough; its singular values are then right to `M eps` over twice this
pub(super) fn triangular(
    run: &Run<'_>,
    first: &Correlation,
    sufficient: f64,
) -> Result<Mat<f64>, PodError> {
    let (n, m) = run.ensemble.shape();
    let coarse = PivotedCholesky::new(first.matrix.as_ref(), squares_floor(m));
    let all = coarse.resolved == m.min(n) && m <= n;
    if run.agree(|| all && are_independent(first.matrix.as_ref(), sufficient))? {
        return Ok(in_original_order(coarse.factor().as_ref(), &coarse.order));
    }
    let preconditioner = Preconditioner { order: coarse.order, unit: coarse.unit };
    let second = correlation(run, "refinement", Some(&preconditioner))?;
    Ok(refined(&second, &preconditioner, 0))
}

/// A from the Gram matrix of the columns that a preconditioner made.
///
/// * `first`: number of them that are known to be independent: they enter before the others
fn refined(second: &Correlation, preconditioner: &Preconditioner, first: usize) -> Mat<f64> {
    let (gram, m) = (second.matrix.as_ref(), second.matrix.ncols());
    let floors: Vec<f64> = (0..m).map(|k| ROUND_OFF * gram[(k, k)]).collect();
    let fine = PivotedCholesky::with_floors(gram, &floors, first);
    let unit = Mat::from_fn(m, m, |i, j| preconditioner.unit[(fine.order[i], j)]);
    let a = product(fine.factor().as_ref(), unit.as_ref());
    in_original_order(a.as_ref(), &preconditioner.order)
}

/// The columns `a P` where `order` tells P.
pub(crate) fn in_original_order(a: MatRef<'_, f64>, order: &[usize]) -> Mat<f64> {
    let mut original = Mat::zeros(a.nrows(), a.ncols());
    for (from, &to) in a.col_iter().zip(order) {
        original.col_mut(to).copy_from(from);
    }
    original
}
