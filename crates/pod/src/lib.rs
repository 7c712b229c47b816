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
//! Every sum over rows is taken block by block and merged over one fixed tree, so that the number
//! of threads changes nothing, not the last bit.

mod algorithm;
mod basis;
mod dense;
mod ensemble;
mod error;
mod error_norm;
mod householder;
mod inner_product;
mod mean;
mod note;
mod options;
mod product;
mod reduction;
mod snapshots;
mod spectrum;
pub mod time_weights;

pub use algorithm::{ALGORITHMS, Algorithm, auto, direct, method_of_snapshots, svd};
pub use basis::ReducedBasis;
pub use error::PodError;
pub use error_norm::{projection_residuals, trajectory_residual};
pub use inner_product::{Diagonal, Identity, InnerProduct, InnerProductError, SparseSpd};
pub use note::Note;
pub use options::{Options, Truncation};
pub use snapshots::{MemorySnapshots, SnapshotSource};
pub use time_weights::TimeWeightsError;
