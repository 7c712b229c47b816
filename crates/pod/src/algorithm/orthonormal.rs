//! From stored columns to modes: orthonormal, signed, published.

use super::raw::Columns;
use crate::PodError;
use crate::dense::{self, product};
use crate::inner_product::{reach_of, support};
use crate::kernel::add_gram;
use crate::partial::Partial;
use crate::partition::Partition;
use crate::run::Run;
use faer::{Mat, MatRef};
use std::ops::Range;

/// What makes orthonormal modes of columns, `Phi = columns T`.
pub(crate) struct Change {
    /// T.
    pub to_modes: Mat<f64>,
    /// Its inverse.
    pub of_coefficients: Mat<f64>,
}

/// `columns = Phi R`, with R from the Gram matrix of the columns (Cholesky-QR): the identity up to the
/// relative error of the smallest modes, and being triangular it leaves the larger modes alone.
/// An entry of largest magnitude of each mode is positive.
///
/// * `steps`: what makes the columns of those that are stored, see [`multiplied`]
pub(crate) fn orthonormal(
    run: &Run<'_>,
    steps: &[MatRef<'_, f64>],
    mut columns: Columns,
) -> Result<Change, PodError> {
    const ROUND_OFF: f64 = 1e-14;
    const PASSES: usize = 3;
    let size = columns.extremes.len();
    let identity = Mat::<f64>::identity(size, size);
    let (mut to_modes, mut r) = (identity.clone(), identity.clone());
    for _ in 0..PASSES {
        let defect = (&columns.gram - &identity).norm_max();
        if defect <= ROUND_OFF {
            break;
        }
        let step =
            dense::cholesky_upper(columns.gram.as_ref()).ok_or(PodError::LostOrthogonality)?;
        let inverse = dense::upper_inverse(step.as_ref()).ok_or(PodError::LostOrthogonality)?;
        to_modes = product(to_modes.as_ref(), inverse.as_ref());
        r = product(step.as_ref(), r.as_ref());
        // What a Gram matrix this close to the identity misses is round-off, and no entry of a mode that
        // counts has changed.
        if defect < 1e-7 {
            break;
        }
        columns = changed(run, &[steps, &[to_modes.as_ref()]].concat())?;
    }
    for (k, extreme) in columns.extremes.iter().enumerate() {
        let sign = extreme.signum();
        to_modes.col_mut(k).iter_mut().for_each(|x| *x *= sign);
        r.row_mut(k).iter_mut().for_each(|x| *x *= sign);
    }
    Ok(Change { to_modes, of_coefficients: r })
}

/// The product of some columns with one matrix after the other. Multiplied out first, the matrices would
/// bring round-off back that a later one takes away from what an earlier one left.
fn multiplied(columns: Mat<f64>, steps: &[MatRef<'_, f64>]) -> Mat<f64> {
    steps.iter().fold(columns, |columns, step| product(columns.as_ref(), *step))
}

/// Number of columns before and after some steps.
fn widths(steps: &[MatRef<'_, f64>]) -> [usize; 2] {
    let [first, last] = [steps.first(), steps.last()].map(|step| step.expect("a step"));
    [first.nrows(), last.ncols()]
}

/// What is known of the stored columns after these steps.
pub(crate) fn changed(run: &Run<'_>, steps: &[MatRef<'_, f64>]) -> Result<Columns, PodError> {
    let (ensemble, modes, [stored, size]) = (run.ensemble, run.modes, widths(steps));
    let piece = ensemble.partition.piece(reach_of(ensemble.product));
    let part = |rows: Range<usize>| {
        let mut sum = Partial::zeros(size * size, size);
        for rows in Partition::pieces(rows, piece) {
            let support = support(ensemble.product, &rows);
            let mut columns = Mat::zeros(support.len(), stored);
            modes.read(support, columns.as_mut())?;
            let mut columns = multiplied(columns, steps);
            sum.add_extremes(columns.subrows(0, rows.len()));
            ensemble.product.factor(rows.clone(), columns.as_mut())?;
            add_gram(sum.matrix_mut(size, size), columns.subrows(0, rows.len()));
        }
        Ok(sum)
    };
    Ok(Columns::of(&run.over_modes("orthonormalisation", stored, &part)?, size))
}

/// Publishes the stored columns after these steps, and the mean behind them.
pub(crate) fn publish(run: &Run<'_>, steps: &[MatRef<'_, f64>]) -> Result<(), PodError> {
    let (n, _) = run.ensemble.shape();
    let [stored, kept] = widths(steps);
    let (block, modes) = (run.ensemble.partition.block(), run.modes);
    let centred = run.ensemble.options.center;
    run.all_or_none(modes.begin(n, kept, centred))?;
    let part = |rows: Range<usize>| {
        for rows in Partition::pieces(rows, block) {
            let mut columns = Mat::zeros(rows.len(), stored + usize::from(centred));
            modes.read(rows.clone(), columns.as_mut())?;
            let mean = centred.then(|| columns.col_as_slice(stored).to_vec());
            columns.truncate(rows.len(), stored);
            modes.publish(rows, multiplied(columns, steps).as_ref(), mean.as_deref())?;
        }
        Ok(Partial::default())
    };
    run.over_modes("writing the modes", stored, &part).map(|_| ())
}
