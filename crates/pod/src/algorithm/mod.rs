//! The POD algorithms, one file each. A new one is added to [`ALGORITHMS`].

mod auto;
mod direct;
pub(crate) mod finish;
pub(crate) mod lift;
pub(crate) mod orthonormal;
pub(crate) mod raw;
mod sketched;
pub(crate) mod snapshots;
pub(crate) mod svd;
pub(crate) mod whole;

pub use auto::auto;
pub use direct::direct;
pub use snapshots::method_of_snapshots;
pub use svd::svd;

use crate::agreement::together;
use crate::ensemble::{Ensemble, check_dimensions};
use crate::run::Run;
use crate::{
    Decomposition, Execution, InnerProduct, MemoryModes, ModeStore, Options, PodError, Reach,
    ReducedBasis, SnapshotSource,
};

/// A POD algorithm under the name that case files and the command line give it.
///
/// ```
/// use lumley_pod::ALGORITHMS;
/// let names: Vec<_> = ALGORITHMS.iter().map(|a| a.name).collect();
/// assert_eq!(names, ["auto", "snapshots", "direct", "svd"]);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Algorithm {
    /// Its name.
    pub name: &'static str,
    /// What it is, in a line.
    pub summary: &'static str,
    /// Decomposes snapshots in an inner product; the modes are held in memory.
    pub run: fn(&dyn SnapshotSource, &dyn InnerProduct, &Options) -> Result<ReducedBasis, PodError>,
    /// The same for snapshots and modes of any size, on any number of machines.
    pub stream: Stream,
}

/// Decomposes snapshots in an inner product; the modes go to a store as they come.
pub type Stream = fn(
    &dyn SnapshotSource,
    &dyn InnerProduct,
    &Options,
    Execution<'_>,
    &dyn ModeStore,
) -> Result<Decomposition, PodError>;

/// Every algorithm; the first is the default.
pub const ALGORITHMS: &[Algorithm] = &[
    Algorithm {
        name: "auto",
        summary: "the cheapest that is exact for the modes asked for",
        run: auto,
        stream: auto::stream,
    },
    Algorithm {
        name: "snapshots",
        summary: "method of snapshots: eigenvectors of the M x M correlation in time",
        run: method_of_snapshots,
        stream: snapshots::stream,
    },
    Algorithm {
        name: "direct",
        summary: "classical method: eigenvectors of the n x n correlation in space",
        run: direct,
        stream: direct::stream,
    },
    Algorithm {
        name: "svd",
        summary: "bi-orthogonal decomposition: exact down to round-off of the snapshots",
        run: svd,
        stream: svd::stream,
    },
];

/// Runs an algorithm on one machine and keeps the modes in memory.
pub(crate) fn in_memory(
    stream: Stream,
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
) -> Result<ReducedBasis, PodError> {
    let store = MemoryModes::default();
    let decomposition = stream(x, w, options, Execution::default(), &store)?;
    let (modes, mean) = store.into_parts();
    Ok(ReducedBasis { modes, mean, decomposition })
}

/// Runs an algorithm that reads rows and takes sums of M x M numbers.
pub(crate) fn with_rows(
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
    execution: Execution<'_>,
    modes: &dyn ModeStore,
    algorithm: &dyn Fn(&Run<'_>) -> Result<Decomposition, PodError>,
) -> Result<Decomposition, PodError> {
    with_sums(x, w, options, execution, modes, x.times().len(), algorithm)
}

/// Runs an algorithm that reads rows: where the inner product couples all of them, on weighted
/// snapshots in memory.
///
/// * `width`: columns of the sums that it takes, of M rows
pub(crate) fn with_sums(
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
    execution: Execution<'_>,
    modes: &dyn ModeStore,
    width: usize,
    algorithm: &dyn Fn(&Run<'_>) -> Result<Decomposition, PodError>,
) -> Result<Decomposition, PodError> {
    check_dimensions(x, w)?;
    if w.reach() == Reach::All {
        return whole::with_columns(x, w, options, execution, modes, width, algorithm);
    }
    // The machine of one rank may have less memory than that of another.
    let ensemble = together(execution.ranks, Ensemble::for_sums(x, w, options, width))?;
    algorithm(&Run::new(&ensemble, execution, modes))
}
