use super::direct;
use super::lift::lift;
use super::snapshots::eigenvectors;
use super::svd::{bi_orthogonal, triangular};
use crate::correlation::correlation;
use crate::run::Run;
use crate::spectrum::Spectrum;
use crate::{
    Decomposition, Execution, InnerProduct, ModeStore, Note, Options, PodError, ReducedBasis,
    SnapshotSource,
};

/// The cheapest algorithm that is exact for the modes asked for.
///
/// Exact: every singular value asked for is right to 1e-6 relative to itself, or to the accuracy
/// of [`svd`](crate::svd), a few `eps sigma_1`, where that is more. The smaller of the two correlation
/// matrices is formed first, in time ([`method_of_snapshots`](crate::method_of_snapshots)) or, where
/// there are fewer unknowns than snapshots, in space ([`direct`](crate::direct)), and its own
/// eigenvalues tell whether it reaches that. Otherwise the correlation in time goes on into
/// [`svd`](crate::svd). The first of the [`notes`](Decomposition::notes) says which was taken and why.
///
/// # Errors
/// Those of the algorithms it takes.
pub fn auto(
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
    let (unknowns, snapshots) = (x.dim(), x.times().len());
    let mut before = 0;
    if unknowns < snapshots && unknowns > 0 {
        let space = direct::Space::new(x, w, options, execution)?;
        let spatial = direct::correlation_in_space(&space)?;
        let choice = Choice::of(&spatial.spectrum, options);
        if choice.is_exact() {
            let found = direct::finish_in_space(&space, modes, spatial)?;
            return Ok(choice.noted(found));
        }
        before = space.passes();
    }
    let mut found =
        super::with_rows(x, w, options, execution, modes, &|run| in_time(run, options))?;
    found.passes += before;
    Ok(found)
}

fn in_time(run: &Run<'_>, options: &Options) -> Result<Decomposition, PodError> {
    let first = correlation(run, "correlation", None)?;
    let temporal = eigenvectors(run, &first)?;
    let choice = Choice::of(&temporal.spectrum, options);
    let found = if choice.is_exact() {
        lift("snapshots", run, temporal)
    } else {
        let (_, m) = run.ensemble.shape();
        let a = triangular(run, &first, m as f64 * f64::EPSILON / (2.0 * TOLERANCE))?;
        lift("svd", run, bi_orthogonal(run, a.as_ref(), first.steady)?)
    };
    Ok(choice.noted(found?))
}

/// Relative error that a singular value asked for may have.
const TOLERANCE: f64 = 1e-6;

/// What a correlation matrix says of itself.
struct Choice {
    /// Least eigenvalue asked for, relative to the first; zero where more are asked for than exist.
    smallest: f64,
    /// Least eigenvalue, relative to the first, whose root a correlation matrix gives to the
    /// tolerance: half of what squaring loses, relative to the root.
    bound: f64,
}

impl Choice {
    fn of(spectrum: &Spectrum, options: &Options) -> Self {
        let (asked, first) = (spectrum.asked(options.truncation), spectrum.values[0]);
        Self {
            smallest: spectrum.values.get(asked - 1).map_or(0.0, |l| l / first),
            bound: spectrum.squaring.unwrap_or(0.0) / first / (2.0 * TOLERANCE),
        }
    }

    fn is_exact(&self) -> bool {
        self.smallest >= self.bound
    }

    fn noted(&self, mut found: Decomposition) -> Decomposition {
        let (algorithm, &Self { smallest, bound }) = (found.algorithm, self);
        found.notes.insert(0, Note::Chosen { algorithm, smallest, bound });
        found
    }
}
