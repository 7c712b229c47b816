//! From eigenvectors in time to modes in space.

use crate::ensemble::Ensemble;
use crate::product::{combine, factor_of_weighted, product};
use crate::spectrum::Spectrum;
use crate::{Note, PodError, ReducedBasis, dense};
use faer::{Mat, MatRef};

/// Eigenvalues and eigenvectors of the correlation in time, or singular values and right
/// singular vectors: the same thing.
pub(super) struct Temporal {
    pub spectrum: Spectrum,
    /// M x k, one column for each eigenvalue.
    pub vectors: Mat<f64>,
}

/// `Phi_n = X v_n / sigma_n`, made orthonormal again where round-off spoilt it.
pub(super) fn lift(
    algorithm: &'static str,
    ensemble: &Ensemble<'_>,
    temporal: Temporal,
) -> Result<ReducedBasis, PodError> {
    let Temporal { spectrum, vectors } = temporal;
    let (kept, note) = spectrum.keep(ensemble.options.truncation);
    if kept == 0 {
        return Err(PodError::LostOrthogonality);
    }
    let sigma = singular_values(&spectrum.values[..kept], ensemble.scale.len());
    let v = vectors.subcols(0, kept);
    let to_modes = Mat::from_fn(v.nrows(), kept, |j, k| v[(j, k)] / sigma[k]);
    let raw = combine(ensemble, to_modes.as_ref(), ensemble.options.par)?;
    let (modes, r) = orthonormal(ensemble, raw)?;
    // X v_n = Phi R sigma_n, so that the coefficients of the new modes are R Sigma Vᵀ.
    let sigma_vt = Mat::from_fn(kept, v.nrows(), |k, j| sigma[k] * v[(j, k)]);
    let coefficients = product(r.as_ref(), sigma_vt.as_ref());
    Ok(finish(algorithm, ensemble, spectrum, Parts { modes, coefficients, note }))
}

/// `Phi = Q R`, repeated until Q is orthonormal: R is the identity up to the relative error of the
/// smallest modes, and being triangular it leaves the larger modes alone.
fn orthonormal(
    ensemble: &Ensemble<'_>,
    mut modes: Mat<f64>,
) -> Result<(Mat<f64>, Mat<f64>), PodError> {
    const ROUND_OFF: f64 = 1e-14;
    const PASSES: usize = 3;
    let (par, size) = (ensemble.options.par, modes.ncols());
    let identity = Mat::<f64>::identity(size, size);
    let (mut r, mut last) = (identity.clone(), f64::INFINITY);
    for _ in 0..PASSES {
        let step = factor_of_weighted(&modes.as_ref(), ensemble.product, par)?;
        let defect = (step.transpose() * &step - &identity).norm_max();
        // What rounding of the modes leaves, times the condition of W, is not improved upon.
        if defect <= ROUND_OFF || defect > 0.1 * last {
            break;
        }
        let inverse = dense::upper_inverse(step.as_ref()).ok_or(PodError::LostOrthogonality)?;
        modes = combine(&modes.as_ref(), inverse.as_ref(), par)?;
        r = product(step.as_ref(), r.as_ref());
        last = defect;
    }
    Ok((modes, r))
}

pub(super) fn singular_values(lambda: &[f64], snapshots: usize) -> Vec<f64> {
    lambda.iter().map(|l| (snapshots as f64 * l).sqrt()).collect()
}

/// What an algorithm found besides the spectrum; the coefficients are those of the snapshots as
/// the ensemble shows them, weighted in time.
pub(super) struct Parts {
    pub modes: Mat<f64>,
    pub coefficients: Mat<f64>,
    pub note: Option<Note>,
}

/// Fixes the signs, takes the time weights off the coefficients and collects the results.
pub(super) fn finish(
    algorithm: &'static str,
    ensemble: &Ensemble<'_>,
    spectrum: Spectrum,
    parts: Parts,
) -> ReducedBasis {
    let Parts { mut modes, mut coefficients, note } = parts;
    for k in 0..modes.ncols() {
        let sign = sign(modes.as_ref(), k);
        modes.col_mut(k).iter_mut().for_each(|x| *x *= sign);
        let of_mode = coefficients.row_mut(k).iter_mut();
        of_mode.zip(&ensemble.scale).for_each(|(a, s)| *a *= sign / s);
    }
    let eigenvalues = spectrum.values[..modes.ncols()].to_vec();
    ReducedBasis {
        algorithm,
        singular_values: singular_values(&eigenvalues, ensemble.scale.len()),
        eigenvalues,
        modes,
        coefficients,
        mean: ensemble.mean.as_ref().map(|mean| mean.field.clone()),
        total_energy: spectrum.values.iter().sum(),
        noise_floor: spectrum.floor,
        rank: spectrum.rank(),
        spectrum: spectrum.values,
        times: ensemble.times().to_vec(),
        time_weights: ensemble.time_weights.clone(),
        notes: note.into_iter().collect(),
    }
}

/// Sign of the first entry whose magnitude is within 1e-6 of the largest: round-off must not
/// decide between equal entries of opposite sign.
fn sign(modes: MatRef<'_, f64>, k: usize) -> f64 {
    let column = modes.col(k);
    let largest = column.norm_max();
    let decisive = column.iter().find(|x| x.abs() >= (1.0 - 1e-6) * largest);
    decisive.map_or(1.0, |x| x.signum())
}
