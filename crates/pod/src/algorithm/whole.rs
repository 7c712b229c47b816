//! Inner products that couple all rows: everything is done on `Z = F X` in memory.

use crate::ensemble::Ensemble;
use crate::partial::extreme_of;
use crate::plan::memory_left;
use crate::run::Run;
use crate::snapshots::MemorySnapshots;
use crate::{
    Decomposition, Execution, Identity, InnerProduct, MemoryModes, ModeStore, Options, PodError,
    SnapshotSource, time_weights,
};
use faer::{ColRef, Mat};

/// What to do where whole columns do not fit.
pub(crate) const COUPLED: &str =
    "raise the limit, or take weights for each unknown or the product of a grid";

/// Decomposes `F X` in the Euclidean product; the modes are `F⁻¹` of what comes of it.
///
/// * `width`: columns of the sums that the algorithm takes, of M rows
pub(super) fn with_columns(
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
    execution: Execution<'_>,
    modes: &dyn ModeStore,
    width: usize,
    algorithm: &dyn Fn(&Run<'_>) -> Result<Decomposition, PodError>,
) -> Result<Decomposition, PodError> {
    if execution.ranks.count() > 1 {
        return Err(PodError::WholeColumns { ranks: execution.ranks.count() });
    }
    let memory_limit = memory_left(
        options.memory_limit,
        8 * x.dim() as u128 * x.times().len() as u128,
        "the snapshots, which an inner product of coupled rows needs whole,",
        COUPLED,
    )?;
    let (z, amplified) = weighted(x, w, options)?;
    let options = Options { memory_limit, ..options.clone() };
    let z = MemorySnapshots::new(z, x.times().to_vec());
    let identity = Identity::new(w.dim());
    let mut ensemble = Ensemble::for_sums(&z, &identity, &options, width)?;
    ensemble.amplified = amplified;
    let found = MemoryModes::default();
    let mut decomposition = algorithm(&Run::new(&ensemble, execution, &found))?;
    let (mut basis, mean) = found.into_parts();
    w.unfactor(basis.as_mut())?;
    for k in 0..basis.ncols() {
        let sign = extreme_of(0.0, basis.col_as_slice(k)).signum();
        basis.col_mut(k).iter_mut().for_each(|x| *x *= sign);
        decomposition.coefficients.row_mut(k).iter_mut().for_each(|a| *a *= sign);
    }
    let mean = mean.map(|mean| {
        let mut column = Mat::from_fn(mean.len(), 1, |i, _| mean[i]);
        w.unfactor(column.as_mut()).map(|()| column.col_as_slice(0).to_vec())
    });
    decomposition.passes = 1; // the others were over F X
    modes.begin(w.dim(), basis.ncols(), mean.is_some())?;
    modes.publish(0..w.dim(), basis.as_ref(), mean.transpose()?.as_deref())?;
    Ok(decomposition)
}

/// `F X`, and `sum_i W_ii <u_i²>`.
fn weighted(
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
) -> Result<(Mat<f64>, f64), PodError> {
    let (n, m) = (x.dim(), x.times().len());
    let mut z = Mat::zeros(n, m);
    crate::ensemble::read_checked(x, 0..n, 0..m, z.as_mut())?;
    let diagonal = w.diagonal()?;
    let energy =
        |u: ColRef<'_, f64>| -> f64 { u.iter().zip(&diagonal).map(|(u, w)| w * u * u).sum() };
    let time_weights = time_weights::normalised(options.time_weights.as_deref(), m)?;
    let amplified = z.col_iter().zip(&time_weights).map(|(u, q)| q * energy(u)).sum();
    w.factor(0..n, z.as_mut())?;
    Ok((z, amplified))
}
