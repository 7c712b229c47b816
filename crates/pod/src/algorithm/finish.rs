use super::raw::Residual;
use crate::ensemble::Ensemble;
use crate::spectrum::Spectrum;
use crate::{Decomposition, Note};
use faer::{Mat, MatRef};

/// What an algorithm found besides the spectrum; the coefficients are those of the snapshots as
/// the ensemble shows them, weighted in time.
pub(crate) struct Parts {
    pub coefficients: Mat<f64>,
    pub note: Option<Note>,
    pub residual: Residual,
    pub passes: usize,
}

/// Takes the time weights off the coefficients and collects the results.
pub(crate) fn finish(
    algorithm: &'static str,
    ensemble: &Ensemble<'_>,
    spectrum: Spectrum,
    parts: Parts,
) -> Decomposition {
    let Parts { mut coefficients, note, residual, passes } = parts;
    let kept = coefficients.nrows();
    let residuals = residuals(&residual, coefficients.as_ref(), &ensemble.scale);
    for (column, s) in coefficients.col_iter_mut().zip(&ensemble.scale) {
        column.iter_mut().for_each(|a| *a /= s);
    }
    let eigenvalues = spectrum.values[..kept].to_vec();
    Decomposition {
        algorithm,
        singular_values: singular_values(&eigenvalues, ensemble.scale.len()),
        eigenvalues,
        coefficients,
        residuals,
        total_energy: spectrum.total(),
        error_bound: spectrum.left_out,
        noise_floor: spectrum.floor,
        rank: spectrum.rank(),
        spectrum: spectrum.values,
        times: ensemble.source.times().to_vec(),
        time_weights: ensemble.time_weights.clone(),
        passes,
        notes: note.into_iter().collect(),
    }
}

pub(crate) fn singular_values(lambda: &[f64], snapshots: usize) -> Vec<f64> {
    lambda.iter().map(|l| (snapshots as f64 * l).sqrt()).collect()
}

/// `Res(N) = max_j |u_j - u_N,j| / max_j |u_j|`, N = 1..r: what all modes leave of a snapshot and its
/// coefficients after the first N are orthogonal, so that only positive numbers are added.
fn residuals(residual: &Residual, coefficients: MatRef<'_, f64>, scale: &[f64]) -> Vec<f64> {
    if residual.whole.is_empty() {
        return Vec::new();
    }
    let squares = scale.iter().map(|s| s * s);
    let whole = residual.whole.iter().zip(squares.clone()).map(|(u, s)| u / s);
    let largest = whole.fold(0.0, f64::max);
    let mut worst = vec![0.0_f64; coefficients.nrows()];
    for ((left, a), s) in residual.left.iter().zip(coefficients.col_iter()).zip(squares) {
        let mut error = left / s;
        for (worst, a) in worst.iter_mut().zip(a.iter()).rev() {
            *worst = worst.max(error);
            error += a * a / s;
        }
    }
    worst.iter().map(|error| (error / largest).sqrt()).collect()
}
