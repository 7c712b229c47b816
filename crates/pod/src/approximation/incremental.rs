use super::update::{OldBasis, joined};
use crate::algorithm::svd;
use crate::ensemble::{check_dimensions, check_truncation};
use crate::plan::memory_left;
use crate::time_weights::normalised;
use crate::{
    Decomposition, Execution, InnerProduct, MemoryModes, ModeStore, Options, PodError,
    ReducedBasis, Selection, SnapshotSource, Truncation, projection_residuals,
};
use std::ops::Range;

/// POD of some snapshots after the others, an approximation: each set updates the modes of those before.
///
/// The first set is decomposed by [`svd`](crate::svd), each of the others is an
/// [`update`](crate::update), so that the bound of [`APPROXIMATIONS`](crate::APPROXIMATIONS) holds.
/// Of the modes twice as many as asked for, and at least 10 more, go on from set to set; where an
/// energy is asked for, those that leave no more than a tenth of what may be left.
///
/// Cost about 12 n M k flops for k modes that go on, and two or three passes over the snapshots, each set
/// for itself. The modes are held in memory between the sets, on one machine, whose limit
/// counts them; a decomposition that was killed begins again. To add snapshots to a basis in a file,
/// of any size, take [`update`](crate::update).
///
/// # Errors
/// Every variant of [`PodError`] but those about other algorithms.
///
/// ```
/// use lumley_pod::{Identity, MemorySnapshots, Options, Truncation, incremental};
/// let x = faer::Mat::from_fn(500, 300, |i, j| 1.0 / (1 + i + j) as f64);
/// let snapshots = MemorySnapshots::new(x, (0..300).map(f64::from).collect());
/// let options = Options { truncation: Truncation::Modes(4), ..Options::default() };
/// let basis = incremental(&snapshots, &Identity::new(500), &options)?;
/// assert_eq!((basis.size(), basis.times.len()), (4, 300));
/// # Ok::<(), lumley_pod::PodError>(())
/// ```
pub fn incremental(
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
) -> Result<ReducedBasis, PodError> {
    fold(x, w, options, Execution::default())
}

pub(super) fn stream(
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
    execution: Execution<'_>,
    modes: &dyn ModeStore,
) -> Result<Decomposition, PodError> {
    let Execution { ranks, watch, .. } = execution;
    if ranks.count() > 1 {
        return Err(PodError::WholeColumns { ranks: ranks.count() });
    }
    // No journal: the passes over one set have the names of those over the others.
    let ReducedBasis { modes: phi, mean, decomposition } =
        fold(x, w, options, Execution { watch, ..Execution::default() })?;
    modes.begin(phi.nrows(), phi.ncols(), mean.is_some())?;
    modes.publish(0..phi.nrows(), phi.as_ref(), mean.as_deref())?;
    Ok(decomposition)
}

fn fold(
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
    execution: Execution<'_>,
) -> Result<ReducedBasis, PodError> {
    check_dimensions(x, w)?;
    check_truncation(options.truncation)?;
    let m = x.times().len();
    let weights = normalised(options.time_weights.as_deref(), m)?;
    let sets = Sets { x, w, options, execution, weights };
    let (mut basis, mut set) = (None, 0..next_size(early(options.truncation)).min(m));
    while !set.is_empty() {
        match sets.add(basis.as_ref(), &set) {
            // A flow may start from rest.
            Err(PodError::NoEnergy { .. }) if basis.is_none() && set.end < m => {
                set.end = (2 * set.end).min(m);
            }
            found => {
                let next = next_size(Truncation::Modes(found.as_ref().map_or(0, |b| b.size())));
                set = set.end..(set.end + next).min(m);
                basis = Some(found?);
            }
        }
    }
    let mut basis = basis.expect("there are snapshots");
    if options.residuals {
        basis.decomposition.residuals = projection_residuals(&basis, x, w)?;
        basis.decomposition.passes += 1;
    }
    Ok(basis)
}

/// What goes on from set to set: more than is asked for, so that what is truncated early does not
/// spoil the end.
fn early(truncation: Truncation) -> Truncation {
    match truncation {
        Truncation::Modes(modes) => {
            Truncation::Modes(modes.saturating_mul(2).max(modes.saturating_add(10)))
        }
        Truncation::Energy(fraction) => Truncation::Energy(1.0 - (1.0 - fraction) / 10.0),
    }
}

/// Snapshots of the next set, where so many modes go on: about as many, which costs least.
fn next_size(kept: Truncation) -> usize {
    match kept {
        Truncation::Modes(modes) => modes.saturating_add(32).max(64),
        Truncation::Energy(_) => 64,
    }
}

/// The snapshots that are taken set by set.
struct Sets<'a> {
    x: &'a dyn SnapshotSource,
    w: &'a dyn InnerProduct,
    options: &'a Options,
    execution: Execution<'a>,
    /// Of all snapshots in the time average, with the sum 1.
    weights: Vec<f64>,
}

impl Sets<'_> {
    /// The basis of the snapshots before a set and of those in it.
    fn add(
        &self,
        before: Option<&ReducedBasis>,
        set: &Range<usize>,
    ) -> Result<ReducedBasis, PodError> {
        let (w, execution, store) = (self.w, self.execution, MemoryModes::default());
        let options = self.options_of(set, before.map_or(0, |basis| basis.size()))?;
        let new = Selection::new(self.x, set.clone().collect());
        let mut decomposition = match before {
            None => svd::stream(&new, w, &options, execution, &store),
            Some(old) => {
                let basis = OldBasis { decomposition: old, modes: old };
                joined(basis, &new, w, &options, execution, &store, self.counts(set))
            }
        }
        .map_err(|error| counted_from(set.start, error))?;
        decomposition.algorithm = "incremental";
        decomposition.error_bound.get_or_insert(0.0);
        decomposition.passes = decomposition.passes.max(before.map_or(0, |basis| basis.passes));
        let (modes, mean) = store.into_parts();
        Ok(ReducedBasis { modes, mean, decomposition })
    }

    /// The options for a set, with what is left of the memory beside the modes, old and new.
    fn options_of(&self, set: &Range<usize>, kept: usize) -> Result<Options, PodError> {
        let bytes = 2 * 8 * self.x.dim() as u128 * (kept as u128 + 1);
        let memory_limit = memory_left(
            self.options.memory_limit,
            bytes,
            "the modes between two sets of snapshots",
            "raise the limit, ask for fewer modes, or take `randomized` or `svd`",
        )?;
        let is_last = set.end == self.weights.len();
        let asked = self.options.truncation;
        Ok(Options {
            truncation: if is_last { asked } else { early(asked) },
            time_weights: self.options.time_weights.as_ref().map(|q| q[set.clone()].to_vec()),
            residuals: false,
            memory_limit,
            ..self.options.clone()
        })
    }

    /// Weights of the snapshots before a set and of those in it, times their number.
    fn counts(&self, set: &Range<usize>) -> [f64; 2] {
        if self.options.time_weights.is_none() {
            return [set.start as f64, set.len() as f64];
        }
        let [before, now] =
            [0..set.start, set.clone()].map(|s| self.weights[s].iter().sum::<f64>());
        [before, now].map(|share| share / (before + now) * set.end as f64)
    }
}

/// The error of a set as one of all snapshots.
fn counted_from(first: usize, error: PodError) -> PodError {
    match error {
        PodError::NonFinite { snapshot, time, row, value } => {
            PodError::NonFinite { snapshot: first + snapshot, time, row, value }
        }
        other => other,
    }
}
