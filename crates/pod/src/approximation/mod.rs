//! Approximate POD, one file for each algorithm: cheaper than the exact ones, with a bound on the error.
//!
//! Both hold of the snapshots what few modes can hold, and leave something uncorrelated with it:
//!
//! ```text
//! X = Phi A + E,   Phiᵀ W Phi = I,   A Aᵀ = M diag(lambda),   A Eᵀ = 0
//! ```
//!
//! (X centred and weighted in time, where that is asked for). Hence, with `G = F X` and the energy
//! `delta² = |F E|²/M` that is left out,
//!
//! ```text
//! (1/M) G Gᵀ = F Phi diag(lambda) (F Phi)ᵀ + (1/M) (F E) (F E)ᵀ
//! ```
//!
//! is a sum of two positive semidefinite matrices, and Weyl's inequality bounds every eigenvalue by those
//! of the first:
//!
//! ```text
//! 0 <= lambda_n(exact) - lambda_n(found) <= |F E|_2²/M <= delta²
//! ```
//!
//! with `lambda_n(found) = 0` after the last. `delta²` is what [`Decomposition::error_bound`] gives,
//! and the traces say that nothing is lost: the sum of the spectrum and `delta²` is the energy of
//! the snapshots, measured exactly. The same for any part of the modes, with the discarded
//! eigenvalues in `delta²`, which is why a basis that was truncated can go on as an old one.
//!
//! The coefficients are those of what is held, `A`. They differ from the projections (7) of the whole
//! snapshots by `Phiᵀ W E`, at most by the norm of what is left of each snapshot.

mod incremental;
mod previous;
mod randomized;
mod update;

pub use incremental::incremental;
pub(crate) use previous::Previous;
pub(crate) use randomized::OVERSAMPLING;
pub use randomized::randomized;
pub use update::{OldBasis, update};

use crate::Algorithm;
#[cfg(doc)]
use crate::Decomposition;

/// The approximate algorithms, beside the exact [`ALGORITHMS`](crate::ALGORITHMS).
///
/// Every eigenvalue that they find is at most the exact one, and at least that less the
/// [`error_bound`](crate::Decomposition::error_bound).
///
/// ```
/// use lumley_pod::{APPROXIMATIONS, Identity, MemorySnapshots, Options, Truncation};
/// let x = faer::Mat::from_fn(90, 40, |i, j| 1.0 / (1 + i + j) as f64);
/// let snapshots = MemorySnapshots::new(x, (0..40).map(f64::from).collect());
/// let options = Options { truncation: Truncation::Modes(3), ..Options::default() };
/// for algorithm in APPROXIMATIONS {
///     let basis = (algorithm.run)(&snapshots, &Identity::new(90), &options)?;
///     let bound = basis.error_bound.expect("an approximation");
///     assert!(bound < 1e-12 * basis.total_energy, "{}: {bound:e}", algorithm.name);
/// }
/// # Ok::<(), lumley_pod::PodError>(())
/// ```
pub const APPROXIMATIONS: &[Algorithm] = &[
    Algorithm {
        name: "randomized",
        summary: "three passes with few random columns in the place of the M snapshots",
        run: randomized,
        stream: randomized::stream,
    },
    Algorithm {
        name: "incremental",
        summary: "some snapshots after the others, each set updating the modes of those before",
        run: incremental,
        stream: incremental::stream,
    },
];
