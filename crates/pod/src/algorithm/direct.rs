use super::finish::{Parts, finish};
use super::raw::Residual;
use crate::correlation::mirror;
use crate::dense::{self, product};
use crate::ensemble::{Ensemble, check_dimensions, read_checked};
use crate::kernel::add_gram;
use crate::mean::Mean;
use crate::partial::extreme_of;
use crate::partition::Partition;
use crate::spectrum::Spectrum;
use crate::{
    Decomposition, Execution, InnerProduct, ModeStore, Options, PodError, Reach, ReducedBasis,
    SnapshotSource,
};
use faer::{Mat, Scale};
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
/// Cost M n² + n³ flops, on one thread of one machine: for few unknowns and many snapshots, as in
/// experiments. It squares the condition number: modes with `lambda <= n eps lambda_1` are noise and
/// are left out, with a [`Note`](crate::Note).
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
    super::in_memory(stream, x, w, options)
}

pub(super) fn stream(
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
    execution: Execution<'_>,
    modes: &dyn ModeStore,
) -> Result<Decomposition, PodError> {
    if execution.ranks.count() > 1 {
        return Err(PodError::WholeColumns { ranks: execution.ranks.count() });
    }
    let space = Space::new(x, w, options)?;
    let spatial = correlation_in_space(&space)?;
    finish_in_space(&space, modes, spatial)
}

/// Snapshots of few unknowns, read by whole columns.
pub(super) struct Space<'a> {
    ensemble: Ensemble<'a>,
    mean: Option<Mean>,
    /// `|F <u>|²` of the mean that is subtracted.
    steady: f64,
}

/// Eigenvalues and eigenvectors `psi`, n x n, of the correlation in space.
pub(super) struct Spatial {
    pub spectrum: Spectrum,
    psi: Mat<f64>,
}

impl<'a> Space<'a> {
    pub fn new(
        x: &'a dyn SnapshotSource,
        w: &'a dyn InnerProduct,
        options: &'a Options,
    ) -> Result<Self, PodError> {
        check_dimensions(x, w)?;
        let (n, limit) = (x.dim(), options.memory_limit);
        let bytes = 3 * 8 * (n as u128).pow(2);
        if bytes > u128::from(limit) {
            let remedy = "take `snapshots` or `svd`, or raise the limit";
            return Err(PodError::Memory { what: "the n x n correlation", bytes, limit, remedy });
        }
        let mut space = Self { ensemble: Ensemble::new(x, w, options)?, mean: None, steady: 0.0 };
        if options.center {
            let mean = space.time_mean()?;
            let mut u = Mat::from_fn(n, 1, |i, _| mean.field[i]);
            w.factor(0..n, u.as_mut())?;
            (space.mean, space.steady) = (Some(mean), u.squared_norm_l2());
        }
        if w.reach() == Reach::All {
            space.ensemble.amplified = space.amplified()?;
        }
        Ok(space)
    }

    fn time_mean(&self) -> Result<Mean, PodError> {
        let (n, m) = self.ensemble.shape();
        let mut mean = Mean::default();
        for rows in Partition::pieces(0..n, self.ensemble.partition.block()) {
            let mut x = Mat::zeros(rows.len(), m);
            read_checked(self.ensemble.source, rows, 0..m, x.as_mut())?;
            mean.extend(Mean::new(x.as_ref(), &self.ensemble.time_weights));
        }
        Ok(mean)
    }

    /// `sum_i W_ii <u_i²>`.
    fn amplified(&self) -> Result<f64, PodError> {
        let (n, m) = self.ensemble.shape();
        let diagonal = self.ensemble.product.diagonal()?;
        let mut energy = 0.0;
        for cols in panels(m) {
            let mut x = Mat::zeros(n, cols.len());
            read_checked(self.ensemble.source, 0..n, cols, x.as_mut())?;
            for u in x.col_iter() {
                energy += u.iter().zip(&diagonal).map(|(u, w)| w * u * u).sum::<f64>();
            }
        }
        Ok(energy / m as f64)
    }

    /// `F X` of some columns.
    fn weighted(&self, cols: Range<usize>) -> Result<Mat<f64>, PodError> {
        let (n, _) = self.ensemble.shape();
        let mut z = Mat::zeros(n, cols.len());
        read_checked(self.ensemble.source, 0..n, cols.clone(), z.as_mut())?;
        self.ensemble.prepare(self.mean.as_ref(), cols, z.as_mut());
        self.ensemble.product.factor(0..n, z.as_mut())?;
        Ok(z)
    }
}

/// Columns in groups of at most 64, for what needs whole columns.
fn panels(columns: usize) -> impl Iterator<Item = Range<usize>> {
    Partition::pieces(0..columns, 64)
}

pub(super) fn correlation_in_space(space: &Space<'_>) -> Result<Spatial, PodError> {
    let (n, m) = space.ensemble.shape();
    let mut correlation = Mat::zeros(n, n);
    for cols in panels(m) {
        let across = space.weighted(cols)?.transpose().to_owned();
        add_gram(correlation.as_mut(), across.as_ref());
    }
    mirror(&mut correlation);
    correlation *= Scale(1.0 / m as f64);
    let (mut lambda, psi) = dense::eigen_descending(correlation.as_ref())?;
    lambda.truncate(n.min(m));
    let squaring = n as f64 * f64::EPSILON * lambda[0];
    let spectrum = space.ensemble.spectrum(lambda, space.steady, Some(squaring))?;
    Ok(Spatial { spectrum, psi })
}

pub(super) fn finish_in_space(
    space: &Space<'_>,
    modes: &dyn ModeStore,
    spatial: Spatial,
) -> Result<Decomposition, PodError> {
    let Spatial { spectrum, psi } = spatial;
    let ((n, _), w) = (space.ensemble.shape(), space.ensemble.product);
    let (kept, note) = spectrum.keep(space.ensemble.options.truncation);
    let psi = psi.subcols(0, kept).to_owned();
    let (mut coefficients, residual) = coefficients(space, &psi)?;
    let mut phi = psi;
    w.unfactor(phi.as_mut())?;
    for k in 0..kept {
        let sign = extreme_of(0.0, phi.col_as_slice(k)).signum();
        phi.col_mut(k).iter_mut().for_each(|x| *x *= sign);
        coefficients.row_mut(k).iter_mut().for_each(|a| *a *= sign);
    }
    let mean = space.mean.as_ref().map(|mean| mean.field.as_slice());
    modes.begin(n, kept, mean.is_some())?;
    modes.publish(0..n, phi.as_ref(), mean)?;
    let parts = Parts { coefficients, note, residual, passes: 2 };
    Ok(finish("direct", &space.ensemble, spectrum, parts))
}

/// `(u, Phi) = (F u)ᵀ psi`, and what the modes leave of each snapshot where that is asked for.
fn coefficients(space: &Space<'_>, psi: &Mat<f64>) -> Result<(Mat<f64>, Residual), PodError> {
    let (n, m) = space.ensemble.shape();
    let mut mean = Mat::zeros(n, 1);
    if let Some(of_rows) = &space.mean {
        mean.col_mut(0).iter_mut().zip(&of_rows.field).for_each(|(to, u)| *to = *u);
        space.ensemble.product.factor(0..n, mean.as_mut())?;
    }
    let (mut a, mut residual) = (Mat::zeros(psi.ncols(), m), Residual::default());
    for cols in panels(m) {
        let z = space.weighted(cols.clone())?;
        let of_panel = product(psi.transpose(), z.as_ref());
        a.subcols_mut(cols.start, cols.len()).copy_from(&of_panel);
        if space.ensemble.options.residuals {
            let left = &z - product(psi.as_ref(), of_panel.as_ref());
            residual.left.extend(left.col_iter().map(|e| e.squared_norm_l2()));
            let whole = z.col_iter().zip(&space.ensemble.scale[cols]);
            let whole = whole.map(|(z, s)| (z + mean.col(0) * Scale(*s)).squared_norm_l2());
            residual.whole.extend(whole);
        }
    }
    Ok((a, residual))
}
