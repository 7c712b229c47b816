use super::Previous;
use crate::agreement::together;
use crate::algorithm::finish::singular_values;
use crate::algorithm::svd::by_correlation;
use crate::algorithm::whole::COUPLED;
use crate::algorithm::with_rows;
use crate::dense::product;
use crate::ensemble::check_dimensions;
use crate::plan::memory_left;
use crate::run::Run;
use crate::{
    Decomposition, Execution, InnerProduct, MemoryModes, ModeSource, ModeStore, Options, PodError,
    Reach, ReducedBasis, SnapshotSource,
};
use faer::{Mat, Scale};

/// The basis that an [`update`] starts from: its modes in memory or in a file.
///
/// ```
/// use lumley_pod::{Identity, MemorySnapshots, OldBasis, Options, svd};
/// let x = MemorySnapshots::new(faer::mat![[3.0, 1.0], [0.0, 2.0]], vec![0.0, 1.0]);
/// let basis = svd(&x, &Identity::new(2), &Options::default())?;
/// let old = OldBasis { decomposition: &basis.decomposition, modes: &basis };
/// assert_eq!(old.decomposition.times.len(), 2);
/// # Ok::<(), lumley_pod::PodError>(())
/// ```
#[derive(Clone, Copy)]
pub struct OldBasis<'a> {
    /// Its energies and coefficients.
    pub decomposition: &'a Decomposition,
    /// Its modes and its mean.
    pub modes: &'a dyn ModeSource,
}

impl OldBasis<'_> {
    /// Energies, coefficients, times and weights fit together.
    fn check(&self) -> Result<(), PodError> {
        let Decomposition { eigenvalues, spectrum, coefficients, times, time_weights, .. } =
            self.decomposition;
        let (modes, snapshots) = (eigenvalues.len(), times.len());
        let counts = [
            ("rows of coefficients", coefficients.nrows(), modes),
            ("columns of coefficients", coefficients.ncols(), snapshots),
            ("time weights", time_weights.len(), snapshots),
            ("eigenvalues in its spectrum", spectrum.len(), modes.max(spectrum.len())),
        ];
        match counts.into_iter().find(|(_, found, expected)| found != expected) {
            None => Ok(()),
            Some((what, found, expected)) => Err(PodError::OldBasis { what, found, expected }),
        }
    }
}

/// The POD of old and new snapshots together, from the modes of the old ones (Brand, 2006; Levey and
/// Lindenbaum, 2000; with the mean Ross et al., 2008).
///
/// The few columns `sqrt(M1 lambda_n) Phi_n` stand for the M1 old snapshots, and `sqrt(M1 M2/M)`
/// times the difference of the means where these are subtracted; [`svd`](crate::svd) decomposes them
/// together with the M2 new snapshots, exactly. What the old modes left of the old snapshots
/// stays left out: it is the [`error_bound`](Decomposition::error_bound), see
/// [`APPROXIMATIONS`](crate::APPROXIMATIONS). An old basis of all modes is updated exactly.
///
/// The weights of the old snapshots, and those that `options` has for the new, are each scaled to
/// the share of their number, M1/M and M2/M. The coefficients cover old and new snapshots in this order:
/// those of the old ones are what they were, turned into the new modes. No residuals are measured, as
/// that would take the old snapshots.
///
/// The [`noise_floor`](Decomposition::noise_floor) is that of the new snapshots. Round-off of the old ones has
/// turned their modes, however much larger they were, and makes no modes of its own.
///
/// Cost 3 n (r + M2)² flops and at most three passes over the new snapshots and the old modes, of
/// which nothing is held in memory unless the inner product couples all rows.
///
/// * `old`: it is not `modes`
/// * `options`: of the new snapshots; the mean is subtracted where it was from the old ones
///
/// # Errors
/// Those of [`svd`](crate::svd); [`PodError::OldBasis`] where the parts of the old basis do not fit;
/// [`PodError::Modes`], [`PodError::Centring`] and [`PodError::OldModes`] where it is not one of such
/// snapshots in this inner product.
///
/// ```
/// use lumley_pod::{Execution, Identity, MemoryModes, MemorySnapshots, OldBasis, Options, Truncation, svd, update};
/// let wave = |t: &[f64]| {
///     let x = faer::Mat::from_fn(50, t.len(), |i, j| (0.1 * i as f64 - t[j]).sin());
///     MemorySnapshots::new(x, t.to_vec())
/// };
/// let options = Options { truncation: Truncation::Modes(2), ..Options::default() };
/// let w = Identity::new(50);
/// let basis = svd(&wave(&[0.0, 0.3, 0.5]), &w, &options)?;
/// let (old, modes) = (OldBasis { decomposition: &basis, modes: &basis }, MemoryModes::default());
/// let found = update(old, &wave(&[0.9, 1.4]), &w, &options, Execution::default(), &modes)?;
/// assert_eq!(found.times, [0.0, 0.3, 0.5, 0.9, 1.4]);
/// assert!(found.error_bound.expect("an approximation") < 1e-14);
/// # Ok::<(), lumley_pod::PodError>(())
/// ```
pub fn update(
    old: OldBasis<'_>,
    new: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
    execution: Execution<'_>,
    modes: &dyn ModeStore,
) -> Result<Decomposition, PodError> {
    let counts = [old.decomposition.times.len(), new.times().len()].map(|count| count as f64);
    joined(old, new, w, options, execution, modes, counts)
}

impl ReducedBasis {
    /// The POD of these snapshots and of those that the basis was made of, in memory: see [`update`].
    ///
    /// # Errors
    /// Those of [`update`].
    pub fn updated(
        &self,
        new: &dyn SnapshotSource,
        w: &dyn InnerProduct,
        options: &Options,
    ) -> Result<Self, PodError> {
        let (old, store) = (OldBasis { decomposition: self, modes: self }, MemoryModes::default());
        let decomposition = update(old, new, w, options, Execution::default(), &store)?;
        let (modes, mean) = store.into_parts();
        Ok(Self { modes, mean, decomposition })
    }
}

/// * `counts`: weights of old and new snapshots in the time average, times the number of all
pub(super) fn joined(
    old: OldBasis<'_>,
    new: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
    execution: Execution<'_>,
    modes: &dyn ModeStore,
    counts: [f64; 2],
) -> Result<Decomposition, PodError> {
    check_dimensions(new, w)?;
    let (unknowns, length) = (new.dim(), old.modes.dim());
    if unknowns != length {
        return Err(PodError::Modes { unknowns, modes: length });
    }
    old.check()?;
    let ranks = execution.ranks;
    let mean = old.modes.mean_of(0..0).map_err(PodError::from);
    let centred = together(ranks, mean)?.is_some();
    if centred != options.center {
        return Err(PodError::Centring { centred });
    }
    let whole = (w.reach() == Reach::All).then(|| weighted(old, w, options)).transpose()?;
    let columns = whole.as_ref().map_or(old.modes, |modes| modes);
    let previous = Previous::new(old.decomposition, columns, counts, centred);
    let options = Options { residuals: false, ..options.clone() };
    let found = with_rows(new, w, &options, execution, modes, &|run| {
        let ensemble = together(ranks, run.ensemble.beside(&previous))?;
        let run = Run::new(&ensemble, run.execution, run.modes);
        previous.check(&run)?;
        by_correlation(&run)
    })?;
    Ok(of_all_snapshots(old.decomposition, found, &previous))
}

/// F times the modes and the mean, where only whole columns have a factor.
fn weighted(
    old: OldBasis<'_>,
    w: &dyn InnerProduct,
    options: &Options,
) -> Result<MemoryModes, PodError> {
    let (n, size) = (old.modes.dim(), old.decomposition.size());
    let bytes = 8 * n as u128 * (size as u128 + 1);
    let what = "the old modes, which an inner product of coupled rows needs whole,";
    memory_left(options.memory_limit, bytes, what, COUPLED)?;
    let mean = old.modes.mean_of(0..n)?;
    let mut columns = Mat::zeros(n, size + 1);
    old.modes.block(0..n, columns.as_mut().subcols_mut(0, size))?;
    columns.col_mut(size).iter_mut().zip(mean.iter().flatten()).for_each(|(to, u)| *to = *u);
    w.factor(0..n, columns.as_mut())?;
    let store = MemoryModes::default();
    store.begin(n, size, mean.is_some())?;
    let weighted_mean = mean.map(|_| columns.col_as_slice(size).to_vec());
    store.publish(0..n, columns.subcols(0, size), weighted_mean.as_deref())?;
    Ok(store)
}

/// From the decomposition of few columns to that of all snapshots that they stand for.
fn of_all_snapshots(
    old: &Decomposition,
    mut found: Decomposition,
    previous: &Previous<'_>,
) -> Decomposition {
    let all = previous.counts[0] + previous.counts[1];
    let to_average = found.coefficients.ncols() as f64 / all;
    for lambda in found.eigenvalues.iter_mut().chain(&mut found.spectrum) {
        *lambda *= to_average;
    }
    found.total_energy *= to_average;
    found.noise_floor *= to_average;
    found.error_bound = Some(previous.left_out / all);
    found.coefficients = coefficients(old, &found.coefficients, previous);
    found.times = [old.times.as_slice(), &found.times].concat();
    found.time_weights = [(&old.time_weights, 0), (&found.time_weights, 1)]
        .into_iter()
        .flat_map(|(weights, set)| weights.iter().map(move |q| q * previous.counts[set] / all))
        .collect();
    found.singular_values = singular_values(&found.eigenvalues, found.times.len());
    found.algorithm = "incremental";
    found
}

/// Coefficients of old and new snapshots, less their common mean.
///
/// * `of_columns`: those of the few columns, r x K
fn coefficients(old: &Decomposition, of_columns: &Mat<f64>, previous: &Previous<'_>) -> Mat<f64> {
    let (size, first) = (previous.sigma.len(), previous.columns());
    let new = of_columns.subcols(first, of_columns.ncols() - first);
    let rotation = Mat::from_fn(of_columns.nrows(), size, |i, k| {
        // An old mode without energy has no coefficients that could be turned.
        if previous.sigma[k] > 0.0 { of_columns[(i, k)] / previous.sigma[k] } else { 0.0 }
    });
    let mut all = Mat::zeros(of_columns.nrows(), old.times.len() + new.ncols());
    all.subcols_mut(0, old.times.len())
        .copy_from(product(rotation.as_ref(), old.coefficients.as_ref()));
    all.subcols_mut(old.times.len(), new.ncols()).copy_from(new);
    if first > size {
        let gap = of_columns.col(size) * Scale(1.0 / previous.of_means());
        let [before, now] =
            previous.counts.map(|count| count / (previous.counts[0] + previous.counts[1]));
        for (j, mut column) in all.col_iter_mut().enumerate() {
            column += &gap * Scale(if j < old.times.len() { now } else { -before });
        }
    }
    all
}
