use super::finish::{Parts, finish};
use super::raw::Residual;
use crate::agreement::{agreed, together};
use crate::correlation::mirror;
use crate::dense::{self, product};
use crate::ensemble::{Ensemble, check_dimensions, read_checked};
use crate::kernel::add_gram;
use crate::mean::Mean;
use crate::partial::extreme_of;
use crate::partition::{Partition, share};
use crate::spectrum::Spectrum;
use crate::{
    Decomposition, Execution, InnerProduct, ModeStore, Options, Pass, PodError, Reach,
    ReducedBasis, SnapshotSource,
};
use faer::{Mat, MatRef, Scale};
use std::cell::Cell;
use std::ops::Range;

/// Bytes of the rows whose mean is taken at a time.
const MEAN_BYTES: usize = 16 << 20;

/// POD by the classical direct method, paper eqs. (2)-(3) (Lumley, 1967).
///
/// Solves the eigenproblem of the n x n correlation in space `R = (1/M) X Xᵀ W`, made symmetric by
/// the factor of the inner product:
///
/// ```text
/// F R F⁻¹ = (1/M) (F X) (F X)ᵀ,   F R F⁻¹ psi = lambda psi,   Phi = F⁻¹ psi
/// ```
///
/// Cost M n² + n³ flops, on one thread of one machine (of many ranks the others wait): for few unknowns and many snapshots, as in
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
    let space = Space::new(x, w, options, execution)?;
    let spatial = correlation_in_space(&space)?;
    finish_in_space(&space, modes, spatial)
}

/// Snapshots of few unknowns, read by whole columns.
pub(super) struct Space<'a> {
    ensemble: Ensemble<'a>,
    mean: Option<Mean>,
    /// `|F <u>|²` of the mean that is subtracted.
    steady: f64,
    execution: Execution<'a>,
    passes: Cell<usize>,
}

/// Eigenvalues and eigenvectors `psi`, n x n, of the correlation in space.
pub(super) struct Spatial {
    pub spectrum: Spectrum,
    psi: Mat<f64>,
}

impl<'a> Space<'a> {
    /// Every rank calls it.
    pub fn new(
        x: &'a dyn SnapshotSource,
        w: &'a dyn InnerProduct,
        options: &'a Options,
        execution: Execution<'a>,
    ) -> Result<Self, PodError> {
        let mut space = together(execution.ranks, Self::read(x, w, options, execution))?;
        let Self { steady, ensemble, .. } = &mut space;
        let energies = agreed(execution.ranks, || Ok(vec![*steady, ensemble.amplified]))?;
        (*steady, ensemble.amplified) = (energies[0], energies[1]);
        Ok(space)
    }

    fn read(
        x: &'a dyn SnapshotSource,
        w: &'a dyn InnerProduct,
        options: &'a Options,
        execution: Execution<'a>,
    ) -> Result<Self, PodError> {
        check_dimensions(x, w)?;
        let (n, limit) = (x.dim(), options.memory_limit);
        let bytes = 3 * 8 * (n as u128).pow(2);
        if bytes > u128::from(limit) {
            // With more snapshots than unknowns the exact algorithms need more still.
            let remedy = if n < x.times().len() {
                "raise the limit, or take `randomized` or `incremental`"
            } else {
                "take `snapshots` or `svd`, or raise the limit"
            };
            return Err(PodError::Memory { what: "the n x n correlation", bytes, limit, remedy });
        }
        let ensemble = Ensemble::for_sums(x, w, options, 1)?;
        let mut space = Self { ensemble, mean: None, steady: 0.0, execution, passes: Cell::new(0) };
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
        self.pass("mean", n, (MEAN_BYTES / (8 * m)).max(1), |rows| {
            let mut x = Mat::zeros(rows.len(), m);
            read_checked(self.ensemble.source, rows, 0..m, x.as_mut())?;
            mean.extend(Mean::new(x.as_ref(), &self.ensemble.time_weights));
            Ok(())
        })?;
        Ok(mean)
    }

    /// `sum_i W_ii <u_i²>`.
    fn amplified(&self) -> Result<f64, PodError> {
        let n = self.ensemble.source.dim();
        let diagonal = self.ensemble.product.diagonal()?;
        let mut energy = 0.0;
        self.over_columns("entries", |cols| {
            let mut x = Mat::zeros(n, cols.len());
            read_checked(self.ensemble.source, 0..n, cols.clone(), x.as_mut())?;
            for (u, q) in x.col_iter().zip(&self.ensemble.time_weights[cols]) {
                energy += q * u.iter().zip(&diagonal).map(|(u, w)| w * u * u).sum::<f64>();
            }
            Ok(())
        })?;
        Ok(energy)
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

    /// A pass over whole columns, 64 at a time.
    fn over_columns(
        &self,
        name: &'static str,
        part: impl FnMut(Range<usize>) -> Result<(), PodError>,
    ) -> Result<(), PodError> {
        self.pass(name, self.ensemble.source.times().len(), 64, part)
    }

    /// A pass over the snapshots, of whose rows or columns, so `many`, `part` takes `few` at a time.
    fn pass(
        &self,
        name: &'static str,
        many: usize,
        few: usize,
        mut part: impl FnMut(Range<usize>) -> Result<(), PodError>,
    ) -> Result<(), PodError> {
        let ((rows, snapshots), number) = (self.ensemble.shape(), self.passes() + 1);
        let pass = Pass { number, name, rows, snapshots, over_snapshots: true };
        self.passes.set(number);
        self.execution.watch.begin(&pass, 0);
        for range in Partition::pieces(0..many, few) {
            // Columns count as the share of the rows that they are of the whole.
            let done = rows * range.end / many;
            part(range)?;
            self.execution.watch.advance(&pass, done);
        }
        Ok(())
    }

    /// Numbers that rank 0 finds for all, and the passes that it took.
    fn agreed(
        &self,
        find: impl FnOnce() -> Result<Vec<f64>, PodError>,
    ) -> Result<Vec<f64>, PodError> {
        let mut told = agreed(self.execution.ranks, || {
            let mut found = find()?;
            found.push(f64::from_bits(self.passes() as u64));
            Ok(found)
        })?;
        let passes = told.pop().expect("it was pushed").to_bits();
        self.passes.set(usize::try_from(passes).expect("as many as before"));
        Ok(told)
    }

    /// Passes over the snapshots so far.
    pub fn passes(&self) -> usize {
        self.passes.get()
    }
}

pub(super) fn correlation_in_space(space: &Space<'_>) -> Result<Spatial, PodError> {
    let (n, m) = space.ensemble.shape();
    let found = space.agreed(|| {
        let mut correlation = Mat::zeros(n, n);
        space.over_columns("correlation", |cols| {
            let across = space.weighted(cols)?.transpose().to_owned();
            add_gram(correlation.as_mut(), across.as_ref());
            Ok(())
        })?;
        mirror(&mut correlation);
        correlation *= Scale(1.0 / m as f64);
        let (lambda, psi) = dense::eigen_descending(correlation.as_ref())?;
        Ok(lambda.into_iter().chain(psi.col_iter().flat_map(|v| v.iter().copied())).collect())
    })?;
    let (lambda, psi) = found.split_at(n);
    let lambda = lambda[..n.min(m)].to_vec();
    let squaring = n as f64 * f64::EPSILON * lambda[0];
    let spectrum = space.ensemble.spectrum(lambda, space.steady, Some(squaring))?;
    Ok(Spatial { spectrum, psi: MatRef::from_column_major_slice(psi, n, n).to_owned() })
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
    let (mut coefficients, residual) = shared_coefficients(space, &psi)?;
    let ranks = space.execution.ranks;
    let mut phi = psi;
    together(ranks, w.unfactor(phi.as_mut()).map_err(PodError::from))?;
    for k in 0..kept {
        let sign = extreme_of(0.0, phi.col_as_slice(k)).signum();
        phi.col_mut(k).iter_mut().for_each(|x| *x *= sign);
        coefficients.row_mut(k).iter_mut().for_each(|a| *a *= sign);
    }
    together(ranks, modes.begin(n, kept, space.mean.is_some()).map_err(PodError::from))?;
    let partition = space.ensemble.partition;
    let own = partition.rows_of(share(partition.leaves(), ranks.rank(), ranks.count()));
    let mean = space.mean.as_ref().map(|mean| &mean.field[own.clone()]);
    let published = modes.publish(own.clone(), phi.subrows(own.start, own.len()), mean);
    together(ranks, published.map_err(PodError::from))?;
    let parts = Parts { coefficients, note, residual, passes: space.passes() };
    Ok(finish("direct", &space.ensemble, spectrum, parts))
}

/// The coefficients as rank 0 finds them.
fn shared_coefficients(
    space: &Space<'_>,
    psi: &Mat<f64>,
) -> Result<(Mat<f64>, Residual), PodError> {
    let (kept, (_, m)) = (psi.ncols(), space.ensemble.shape());
    let found = space.agreed(|| {
        let (a, Residual { left, whole }) = coefficients(space, psi)?;
        let a = a.col_iter().flat_map(|a| a.iter().copied()).collect();
        Ok([a, left, whole].concat())
    })?;
    let (a, residual) = found.split_at(kept * m);
    let (left, whole) = residual.split_at(residual.len() / 2);
    let residual = Residual { left: left.to_vec(), whole: whole.to_vec() };
    Ok((MatRef::from_column_major_slice(a, kept, m).to_owned(), residual))
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
    space.over_columns("coefficients", |cols| {
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
        Ok(())
    })?;
    Ok((a, residual))
}
