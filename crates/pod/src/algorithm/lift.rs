//! From eigenvectors in time to modes in space.

use super::finish::{Parts, finish, singular_values};
use super::orthonormal::{orthonormal, publish};
use super::raw::{Lift, raw_modes};
use super::snapshots::Temporal;
use crate::dense::product;
use crate::run::Run;
use crate::{Decomposition, PodError};
use faer::Mat;

/// `Phi_n = X v_n / sigma_n`, made orthonormal again where round-off spoilt it: a pass over the
/// snapshots that stores the columns as they come, and one over these that publishes them.
pub(crate) fn lift(
    algorithm: &'static str,
    run: &Run<'_>,
    temporal: Temporal,
) -> Result<Decomposition, PodError> {
    let Temporal { spectrum, vectors } = temporal;
    let (kept, note) = spectrum.keep(run.ensemble.options.truncation);
    if kept == 0 {
        return Err(PodError::AllNoise { first: spectrum.values[0], floor: spectrum.floor });
    }
    let m = vectors.nrows();
    let sigma = singular_values(&spectrum.values[..kept], m);
    let sigma_vt = Mat::from_fn(kept, m, |k, j| sigma[k] * vectors[(j, k)]);
    let to_modes = Mat::from_fn(m, kept, |j, k| vectors[(j, k)] / sigma[k]);
    let lift = Lift {
        to_modes: to_modes.as_ref(),
        coefficients: sigma_vt.as_ref(),
        measured: run.ensemble.options.residuals,
    };
    let raw = raw_modes(run, &lift)?;
    let change = orthonormal(run, &[], raw.columns)?;
    publish(run, &[change.to_modes.as_ref()])?;
    // X v_n = Phi R sigma_n, so that the coefficients of the new modes are R Sigma Vᵀ.
    let coefficients = product(change.of_coefficients.as_ref(), sigma_vt.as_ref());
    let parts = Parts { coefficients, note, residual: raw.residual, passes: run.passes() };
    Ok(finish(algorithm, run.ensemble, spectrum, parts))
}
