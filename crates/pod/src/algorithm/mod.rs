//! The POD algorithms, one file each. A new one is added to [`ALGORITHMS`].

mod auto;
mod direct;
mod lift;
mod snapshots;
mod svd;

pub use auto::auto;
pub use direct::direct;
pub use snapshots::method_of_snapshots;
pub use svd::svd;

use crate::{InnerProduct, Options, PodError, ReducedBasis, SnapshotSource};

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
    /// Decomposes snapshots in an inner product.
    pub run: fn(&dyn SnapshotSource, &dyn InnerProduct, &Options) -> Result<ReducedBasis, PodError>,
}

/// Every algorithm; the first is the default.
pub const ALGORITHMS: &[Algorithm] = &[
    Algorithm {
        name: "auto",
        summary: "the cheapest that is exact for the modes asked for",
        run: auto,
    },
    Algorithm {
        name: "snapshots",
        summary: "method of snapshots: eigenvectors of the M x M correlation in time",
        run: method_of_snapshots,
    },
    Algorithm {
        name: "direct",
        summary: "classical method: eigenvectors of the n x n correlation in space",
        run: direct,
    },
    Algorithm {
        name: "svd",
        summary: "bi-orthogonal decomposition: exact down to round-off of the snapshots",
        run: svd,
    },
];
