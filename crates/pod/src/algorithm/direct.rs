use super::finish::{Parts, finish};
use super::raw::Residual;
use crate::agreement::{agreed, together};
use crate::correlation::mirror;
use crate::dense::{self, product};
use crate::ensemble::{Ensemble, read_checked};
use crate::kernel::add_gram;
use crate::mean::Mean;
use crate::partial::extreme_of;
use crate::partition::{Partition, share};
use crate::plan::memory_left;
use crate::spectrum::Spectrum;
use crate::{
    Decomposition, Execution, InnerProduct, ModeStore, Options, Pass, PodError, Reach,
    ReducedBasis, SnapshotSource, Truncation,
};
use faer::{Mat, MatRef, Scale};
use std::cell::Cell;
use std::ops::Range;

/// Columns that are read at a time.
const PANEL: usize = 64;

/// The part of the memory that the rows take whose mean is formed at a time: one in so many.
const MEAN_SHARE: u64 = 4;

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

/// Snapshots of few unknowns, read by whole columns: by rank 0 for all.
pub(super) struct Space<'a> {
    ensemble: Ensemble<'a>,
    /// The mean that is subtracted, on the rank that reads.
    mean: Option<Mean>,
    /// The same rounded, on all ranks.
    field: Option<Vec<f64>>,
    /// `|F <u>|²`.
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
        let ensemble = Ensemble::for_columns(x, w, options);
        let ensemble = ensemble.and_then(|e| check_memory(&e).map(|()| e));
        let ensemble = together(execution.ranks, ensemble)?;
        let passes = Cell::new(0);
        let mut space = Self { ensemble, mean: None, field: None, steady: 0.0, execution, passes };
        let mut mean = None;
        let told = space.agreed(|| {
            mean = options.center.then(|| space.time_mean()).transpose()?;
            let field = mean.as_ref().map_or(&[][..], |mean| &mean.field);
            let mut u = Mat::from_fn(field.len(), usize::from(mean.is_some()), |i, _| field[i]);
            if mean.is_some() {
                w.factor(0..x.dim(), u.as_mut())?;
            }
            let amplified = if w.reach() == Reach::All { space.amplified()? } else { 0.0 };
            Ok([&[u.squared_norm_l2(), amplified], field].concat())
        })?;
        (space.steady, space.ensemble.amplified) = (told[0], told[1]);
        (space.mean, space.field) = (mean, options.center.then(|| told[2..].to_vec()));
        Ok(space)
    }

    fn time_mean(&self) -> Result<Mean, PodError> {
        let (n, m) = self.ensemble.shape();
        let mut mean = Mean::default();
        let fit = self.ensemble.options.memory_limit / (MEAN_SHARE * 8 * m as u64);
        let few = usize::try_from(fit).unwrap_or(n).clamp(1, n);
        self.pass("mean", n, few, |rows| {
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

    /// A pass over whole columns, some at a time.
    fn over_columns(
        &self,
        name: &'static str,
        part: impl FnMut(Range<usize>) -> Result<(), PodError>,
    ) -> Result<(), PodError> {
        self.pass(name, self.ensemble.source.times().len(), PANEL, part)
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

/// The n x n problem fits into the memory limit, with panels of columns and the coefficients.
fn check_memory(ensemble: &Ensemble<'_>) -> Result<(), PodError> {
    let ((n, m), options) = (ensemble.shape(), ensemble.options);
    let kept = match options.truncation {
        Truncation::Modes(modes) => modes.min(n).min(m),
        Truncation::Energy(_) => n.min(m),
    };
    let numbers = 3 * (n as u128).pow(2) + (3 * PANEL * n) as u128 + kept as u128 * m as u128;
    // With more snapshots than unknowns the exact algorithms need more still.
    let remedy = if n < m {
        "raise the limit, or take `randomized` or `incremental`"
    } else {
        "take `snapshots` or `svd`, or raise the limit"
    };
    memory_left(options.memory_limit, 8 * numbers, "the n x n correlation", remedy).map(|_| ())
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
    together(ranks, modes.begin(n, kept, space.field.is_some()).map_err(PodError::from))?;
    let partition = space.ensemble.partition;
    let own = partition.rows_of(share(partition.leaves(), ranks.rank(), ranks.count()));
    let mean = space.field.as_ref().map(|field| &field[own.clone()]);
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
