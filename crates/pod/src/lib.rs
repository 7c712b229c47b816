//! Proper orthogonal decomposition (POD) of snapshots in any inner product, paper eqs. (1)-(10).
//!
//! This crate knows no mesh, no body, no time scheme and no file: it reads snapshots through
//! [`SnapshotSource`] and measures with an [`InnerProduct`]. Every algorithm stands in
//! [`ALGORITHMS`], gives a [`ReducedBasis`] and obeys the same properties.
//!
//! ```
//! use lumley_pod::{Identity, MemorySnapshots, Options, auto};
//! // Two standing waves, the second with a tenth of the amplitude.
//! let x = faer::Mat::from_fn(50, 8, |i, j| {
//!     let (x, t) = (i as f64 / 49.0, j as f64 / 8.0);
//!     let wave = |k: f64| (k * 3.0 * x).sin() * (k * 6.0 * t).cos();
//!     wave(1.0) + 0.1 * wave(2.0)
//! });
//! let times = (0..8).map(|j| f64::from(j) / 8.0).collect();
//! let basis = auto(&MemorySnapshots::new(x, times), &Identity::new(50), &Options::default())?;
//! assert_eq!(basis.size(), 2);
//! assert!(basis.cumulative_percent()[1] > 99.99);
//! # Ok::<(), lumley_pod::PodError>(())
//! ```
//!
//! # Bits
//! Every sum over rows is taken leaf by leaf and merged over one fixed tree, so that neither threads nor
//! ranks nor the memory that may be taken change anything, not the last bit. [`Ranks`] is the one seam
//! by which many machines share a decomposition, [`ModeStore`] the one by which modes larger than
//! memory leave it, [`Journal`] the one by which a killed decomposition goes on.

mod agreement;
mod algorithm;
mod approximation;
mod basis;
mod contiguous;
mod correlation;
mod decomposition;
mod dense;
mod ensemble;
mod error;
mod error_norm;
mod execution;
mod inner_product;
mod journal;
mod kernel;
mod mean;
mod mode_source;
mod mode_store;
mod note;
mod options;
mod partial;
mod partition;
mod plan;
mod random;
mod ranks;
mod reduction;
mod run;
mod selection;
mod snapshots;
mod spectrum;
mod tile;
pub mod time_weights;

pub use agreement::{Failure, all_or_none, from_first};
pub use algorithm::{ALGORITHMS, Algorithm, Stream, auto, direct, method_of_snapshots, svd};
pub use approximation::{APPROXIMATIONS, OldBasis, incremental, randomized, update};
pub use basis::ReducedBasis;
pub use decomposition::Decomposition;
pub use error::PodError;
pub use error_norm::{projection_residuals, trajectory_residual};
pub use execution::{Execution, Pass, Unwatched, Watch};
pub use inner_product::{
    Diagonal, Identity, InnerProduct, InnerProductError, Kronecker, Reach, SparseSpd, Tridiagonal,
};
pub use journal::{Journal, NoJournal};
pub use mode_source::ModeSource;
pub use mode_store::{MemoryModes, ModeStore};
pub use note::Note;
pub use options::{Options, Truncation};
pub use ranks::{Alone, Ranks};
pub use selection::{Selection, finite_snapshots};
pub use snapshots::{MemorySnapshots, SnapshotSource};
pub use time_weights::TimeWeightsError;
