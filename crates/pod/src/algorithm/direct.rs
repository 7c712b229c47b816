use super::lift::{Parts, finish};
use crate::ensemble::Ensemble;
use crate::product::{Columns, add_symmetric, block, mirror, panels, transposed_product};
use crate::{InnerProduct, Options, PodError, ReducedBasis, SnapshotSource, dense};
use faer::Mat;

/// POD by the classical direct method, paper eqs. (2)-(3) (Lumley, 1967).
///
/// Solves the eigenproblem of the n x n correlation in space `R = (1/M) X Xᵀ W`, made symmetric by
/// the factor of the inner product:
///
/// ```text
/// F R F⁻¹ = (1/M) (F X) (F X)ᵀ,   F R F⁻¹ psi = lambda psi,   Phi = F⁻¹ psi
/// ```
///
/// Cost M n² + n³ flops, on one thread: for few unknowns and many snapshots, as in experiments.
/// It squares the condition number: modes with `lambda <= n eps lambda_1` are noise and are left
/// out, with a [`Note`](crate::Note).
///
/// # Errors
/// Every variant of [`PodError`] but those about other algorithms; [`PodError::Memory`] where the
/// n x n problem exceeds the memory limit of the options.
pub fn direct(
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
) -> Result<ReducedBasis, PodError> {
    let ensemble = Ensemble::new(x, w, options)?;
    let (n, m) = ensemble.shape();
    let remedy = "take `snapshots` or `svd`, or raise the limit";
    ensemble.check_memory("the n x n correlation", 3 * 8 * (n as u128).pow(2), remedy)?;
    let (mut lambda, psi) = dense::eigen_descending(correlation_in_space(&ensemble)?.as_ref())?;
    lambda.truncate(n.min(m));
    let spectrum = ensemble.spectrum(lambda, n as f64 * f64::EPSILON, false)?;
    let (kept, note) = spectrum.keep(options.truncation);
    let mut modes = psi.subcols(0, kept).to_owned();
    let coefficients = coefficients(&ensemble, &modes)?;
    w.unfactor(0, modes.as_mut());
    Ok(finish("direct", &ensemble, spectrum, Parts { modes, coefficients, note }))
}

fn correlation_in_space(ensemble: &Ensemble<'_>) -> Result<Mat<f64>, PodError> {
    let (n, m) = ensemble.shape();
    let mut correlation = Mat::zeros(n, n);
    for cols in panels(m) {
        let mut z = block(ensemble, 0..n, cols)?;
        ensemble.product.factor(0, z.as_mut());
        add_symmetric(correlation.as_mut(), z.as_ref());
    }
    mirror(&mut correlation);
    correlation *= faer::Scale(1.0 / m as f64);
    Ok(correlation)
}

/// `(u, Phi) = (F u)ᵀ psi`.
fn coefficients(ensemble: &Ensemble<'_>, psi: &Mat<f64>) -> Result<Mat<f64>, PodError> {
    let (n, m) = ensemble.shape();
    let mut a = Mat::zeros(psi.ncols(), m);
    for cols in panels(m) {
        let mut z = block(ensemble, 0..n, cols.clone())?;
        ensemble.product.factor(0, z.as_mut());
        let of_panel = transposed_product(psi.as_ref(), z.as_ref());
        a.subcols_mut(cols.start, cols.len()).copy_from(of_panel);
    }
    Ok(a)
}
