use super::lift::{Parts, finish};
use crate::ensemble::Ensemble;
use crate::product::{Columns, add_symmetric, block, mirror, panels, transposed_product};
use crate::spectrum::Spectrum;
use crate::{InnerProduct, Options, PodError, ReducedBasis, SnapshotSource, dense};
use faer::Mat;
use std::ops::Range;

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
///
/// ```
/// use lumley_pod::{Identity, MemorySnapshots, Options, Truncation, direct};
/// let x = faer::mat![[3.0, 0.0], [0.0, 4.0]];
/// let options = Options { truncation: Truncation::Modes(1), ..Options::default() };
/// let basis = direct(&MemorySnapshots::new(x, vec![0.0, 1.0]), &Identity::new(2), &options)?;
/// assert!((basis.eigenvalues[0] - 8.0).abs() < 1e-14);
/// # Ok::<(), lumley_pod::PodError>(())
/// ```
pub fn direct(
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
) -> Result<ReducedBasis, PodError> {
    let ensemble = Ensemble::new(x, w, options)?;
    finish_in_space(&ensemble, correlation_in_space(&ensemble)?)
}

/// Eigenvalues and eigenvectors `psi`, n x n, of the correlation in space.
pub(super) struct Spatial {
    pub spectrum: Spectrum,
    psi: Mat<f64>,
}

pub(super) fn correlation_in_space(ensemble: &Ensemble<'_>) -> Result<Spatial, PodError> {
    let (n, m) = ensemble.shape();
    let remedy = "take `snapshots` or `svd`, or raise the limit";
    ensemble.check_memory("the n x n correlation", 3 * 8 * (n as u128).pow(2), remedy)?;
    let mut correlation = Mat::zeros(n, n);
    for cols in panels(m) {
        add_symmetric(correlation.as_mut(), weighted(ensemble, cols)?.as_ref());
    }
    mirror(&mut correlation);
    correlation *= faer::Scale(1.0 / m as f64);
    let (mut lambda, psi) = dense::eigen_descending(correlation.as_ref())?;
    lambda.truncate(n.min(m));
    let squaring = n as f64 * f64::EPSILON * lambda[0];
    Ok(Spatial { spectrum: ensemble.spectrum(lambda, Some(squaring))?, psi })
}

pub(super) fn finish_in_space(
    ensemble: &Ensemble<'_>,
    spatial: Spatial,
) -> Result<ReducedBasis, PodError> {
    let Spatial { spectrum, psi } = spatial;
    let (kept, note) = spectrum.keep(ensemble.options.truncation);
    let mut modes = psi.subcols(0, kept).to_owned();
    let coefficients = coefficients(ensemble, &modes)?;
    ensemble.product.unfactor(0, modes.as_mut());
    Ok(finish("direct", ensemble, spectrum, Parts { modes, coefficients, note }))
}

/// `(u, Phi) = (F u)ᵀ psi`.
fn coefficients(ensemble: &Ensemble<'_>, psi: &Mat<f64>) -> Result<Mat<f64>, PodError> {
    let (_, m) = ensemble.shape();
    let mut a = Mat::zeros(psi.ncols(), m);
    for cols in panels(m) {
        let z = weighted(ensemble, cols.clone())?;
        let of_panel = transposed_product(psi.as_ref(), z.as_ref());
        a.subcols_mut(cols.start, cols.len()).copy_from(of_panel);
    }
    Ok(a)
}

/// `F X` of some columns.
fn weighted(ensemble: &Ensemble<'_>, cols: Range<usize>) -> Result<Mat<f64>, PodError> {
    let mut z = block(ensemble, 0..ensemble.shape().0, cols)?;
    ensemble.product.factor(0, z.as_mut());
    Ok(z)
}
