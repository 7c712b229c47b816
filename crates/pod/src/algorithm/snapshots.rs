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
/// Cost n M² + M³ flops and two passes over the snapshots. The correlation matrix squares the
/// condition number: modes with `lambda <= M eps lambda_1` are noise and are left out, with a
/// [`Note`](crate::Note). An eigenvalue has a relative error of up to `M eps lambda_1/lambda`.
///
/// # Errors
/// Every variant of [`PodError`] but those about other algorithms.
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
    let spectrum = ensemble.spectrum(lambda, m as f64 * f64::EPSILON, false)?;
    Ok(Temporal { spectrum, vectors })
}
