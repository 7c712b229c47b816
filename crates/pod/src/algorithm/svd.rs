use super::lift::{Temporal, lift};
use crate::ensemble::Ensemble;
use crate::product::{Columns, factor_bytes, factor_of_weighted};
use crate::{InnerProduct, Options, PodError, ReducedBasis, SnapshotSource, dense};

/// The bi-orthogonal decomposition (Aubry, 1991; Hemon and Santi, 2003), exact.
///
/// ```text
/// F X = Q R,   R = U Sigma Vᵀ,   Phi_n = X v_n / sigma_n,   lambda_n = sigma_n² / M
/// ```
///
/// R comes from Householder reflections of blocks of rows (TSQR), so that nothing is squared:
/// singular values are right to a few `eps sigma_1` on any spectrum. Where the inner product
/// couples rows, entries that are right to `eps` of themselves leave an error of
/// `4 eps sqrt(M sum_i W_ii <u_i²>)` instead. Cost 2 n M² flops and two passes over the snapshots;
/// where rows are coupled, a third, and one weighted copy of the snapshots is held in memory.
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
    let ensemble = Ensemble::new(x, w, options)?;
    lift("svd", &ensemble, bi_orthogonal(&ensemble)?)
}

pub(super) fn bi_orthogonal(ensemble: &Ensemble<'_>) -> Result<Temporal, PodError> {
    let (n, m) = ensemble.shape();
    let bytes = factor_bytes(n, m, ensemble.product.couples_rows());
    let remedy = "raise the limit, or take `snapshots`, which holds less and resolves less";
    ensemble.check_memory("the triangular factor of the snapshots", bytes, remedy)?;
    let r = factor_of_weighted(ensemble, ensemble.product, ensemble.options.par)?;
    let (sigma, vectors) = dense::right_svd(r.as_ref())?;
    let lambda: Vec<f64> = sigma.iter().map(|s| s * s / m as f64).collect();
    Ok(Temporal { spectrum: ensemble.spectrum(lambda, None)?, vectors })
}
