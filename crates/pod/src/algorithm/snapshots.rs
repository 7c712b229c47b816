use super::lift::{Temporal, lift};
use crate::ensemble::Ensemble;
use crate::product::{Columns, gram};
use crate::{InnerProduct, Options, PodError, ReducedBasis, SnapshotSource, dense};

/// POD by the method of snapshots, paper eqs. (9)-(10) (Sirovich, 1987).
///
/// ```text
/// C_ik = (u_i, u_k)/M,   C c = lambda c,   Phi_n = sum_k c_k u_k / sqrt(M lambda_n)
/// ```
///
/// Cost n M² + M³ flops and two passes over the snapshots; where the inner product couples rows,
/// one more, and one for every 64 snapshots after the first 64. The correlation matrix squares the
/// condition number: modes with `lambda <= M eps lambda_1`, or `8 eps sum_i W_ii <u_i²>` where
/// coupled rows make that larger, are noise and are left out, with a [`Note`](crate::Note). An
/// eigenvalue has an error of up to that.
///
/// # Errors
/// Every variant of [`PodError`] but those about other algorithms.
///
/// ```
/// use lumley_pod::{Identity, MemorySnapshots, Options, Truncation, method_of_snapshots};
/// let x = faer::mat![[3.0, 0.0], [0.0, 4.0]];
/// let options = Options { truncation: Truncation::Modes(1), ..Options::default() };
/// let basis = method_of_snapshots(&MemorySnapshots::new(x, vec![0.0, 1.0]), &Identity::new(2), &options)?;
/// assert!((basis.eigenvalues[0] - 8.0).abs() < 1e-14);
/// # Ok::<(), lumley_pod::PodError>(())
/// ```
pub fn method_of_snapshots(
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
) -> Result<ReducedBasis, PodError> {
    let ensemble = Ensemble::new(x, w, options)?;
    lift("snapshots", &ensemble, correlation_in_time(&ensemble)?)
}

pub(super) fn correlation_in_time(ensemble: &Ensemble<'_>) -> Result<Temporal, PodError> {
    let (n, m) = ensemble.shape();
    let remedy = "take fewer snapshots or raise the limit; `direct` is smaller where n < M";
    ensemble.check_memory(
        "the correlation of the snapshots",
        3 * 8 * (m as u128).pow(2),
        remedy,
    )?;
    let mut correlation = gram(ensemble, ensemble.product, ensemble.options.par)?;
    correlation *= faer::Scale(1.0 / m as f64);
    let (mut lambda, vectors) = dense::eigen_descending(correlation.as_ref())?;
    lambda.truncate(n.min(m));
    let squaring = ensemble.squaring(&lambda);
    Ok(Temporal { spectrum: ensemble.spectrum(lambda, Some(squaring))?, vectors })
}
