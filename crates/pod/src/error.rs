use crate::{Failure, TimeWeightsError};
use std::io;

/// Why there is no POD of these snapshots.
///
/// ```
/// use lumley_pod::{Identity, MemorySnapshots, Options, PodError, auto};
/// let mut x = faer::Mat::<f64>::zeros(3, 2);
/// x[(2, 1)] = f64::NAN;
/// let error = auto(&MemorySnapshots::new(x, vec![0.0, 1.0]), &Identity::new(3), &Options::default());
/// assert!(matches!(error, Err(PodError::NonFinite { snapshot: 1, row: 2, .. })));
/// ```
#[derive(Debug, thiserror::Error)]
pub enum PodError {
    /// There is nothing to decompose.
    #[error("no snapshots of {unknowns} unknowns: POD needs at least one snapshot and one unknown")]
    Empty {
        /// Length n of a snapshot; the number of snapshots is zero unless this is.
        unknowns: usize,
    },
    /// Snapshots and inner product belong to different spaces.
    #[error(
        "snapshots have {unknowns} unknowns but the inner product is one of {product}: \
         give weights made for the same grid and components"
    )]
    Dimension {
        /// Length n of a snapshot.
        unknowns: usize,
        /// Length that the inner product was made for.
        product: usize,
    },
    /// Two trajectories that are compared have different shapes.
    #[error(
        "trajectories of {unknowns} unknowns x {snapshots} snapshots and of {other_unknowns} x \
         {other_snapshots} cannot be compared: sample both on the same grid at the same times"
    )]
    Trajectories {
        /// Unknowns of the first.
        unknowns: usize,
        /// Snapshots of the first.
        snapshots: usize,
        /// Unknowns of the second.
        other_unknowns: usize,
        /// Snapshots of the second.
        other_snapshots: usize,
    },
    /// Two trajectories that are compared were sampled at different times.
    #[error(
        "snapshot {snapshot}, counted from 0, is at {time} s in one trajectory and at \
         {other_time} s in the other: sample both at the same times"
    )]
    Times {
        /// Index of the first snapshot whose times differ, from 0.
        snapshot: usize,
        /// Its time in the first trajectory, in s.
        time: f64,
        /// Its time in the second, in s.
        other_time: f64,
    },
    /// Snapshots and modes belong to different spaces.
    #[error(
        "snapshots have {unknowns} unknowns but the modes have {modes}: \
         project fields of the grid and components that the modes were made from"
    )]
    Modes {
        /// Length n of a snapshot.
        unknowns: usize,
        /// Length of a mode.
        modes: usize,
    },
    /// An entry is NaN or infinite.
    #[error(
        "snapshot {snapshot} (time {time} s) holds {value} in row {row}, counted from 0: \
         every entry must be finite; remove or repair this snapshot, or leave such snapshots out"
    )]
    NonFinite {
        /// Index of the snapshot, from 0.
        snapshot: usize,
        /// Its time, in s.
        time: f64,
        /// Index of the unknown, from 0.
        row: usize,
        /// What stands there.
        value: f64,
    },
    /// The snapshots vanish, or do so once their mean is subtracted.
    #[error("{snapshots} snapshots hold no energy: {}", no_energy(*.centred))]
    NoEnergy {
        /// Number M of snapshots.
        snapshots: usize,
        /// Whether their mean was subtracted.
        centred: bool,
    },
    /// Squares of the entries exceed the range of `f64`.
    #[error(
        "the energy of the snapshots exceeds the range of a 64-bit number: \
         scale them so that entries stay below 1e150"
    )]
    Overflow,
    /// No mode was asked for.
    #[error("0 modes were asked for: ask for at least 1")]
    NoModes,
    /// The energy asked for is no fraction.
    #[error(
        "the modes shall hold the fraction {fraction} of the energy: expected 0 < fraction <= 1"
    )]
    Energy {
        /// The fraction asked for.
        fraction: f64,
    },
    /// The time weights do not fit.
    #[error(transparent)]
    TimeWeights(#[from] TimeWeightsError),
    /// The computation needs more memory than it may take.
    #[error("{what} needs {bytes} bytes but the limit is {limit}: {remedy}")]
    Memory {
        /// What would be held.
        what: &'static str,
        /// How much that is, in bytes.
        bytes: u128,
        /// The limit in [`Options`](crate::Options), in bytes.
        limit: u64,
        /// What to do.
        remedy: &'static str,
    },
    /// The dense eigenvalue or singular value iteration failed.
    #[error(
        "the {size} x {size} eigenvalue iteration did not converge: \
         take another algorithm or scale the snapshots"
    )]
    NoConvergence {
        /// Order of the matrix.
        size: usize,
    },
    /// Modes that should be orthonormal are linearly dependent to working precision.
    #[error(
        "the smallest modes lost their orthogonality to round-off: ask for fewer modes or take `svd`"
    )]
    LostOrthogonality,
    /// The algorithm loses more to round-off than the first mode has.
    #[error(
        "the first eigenvalue is {first:.1e} and this algorithm cannot tell what is under {floor:.1e} from \
         round-off: take `svd`"
    )]
    AllNoise {
        /// The first eigenvalue.
        first: f64,
        /// Eigenvalue below which the algorithm sees noise only.
        floor: f64,
    },
    /// The parts of an old basis do not belong together.
    #[error(
        "the old basis has {found} {what}, but {expected} are expected: it is damaged or of two \
         decompositions"
    )]
    OldBasis {
        /// What is counted.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be, at least in the case of a spectrum.
        expected: usize,
    },
    /// An old basis and new snapshots that update it are not centred alike.
    #[error(
        "the mean was {} the snapshots of the old basis: do the same with the new ones",
        if *.centred { "subtracted from" } else { "left in" }
    )]
    Centring {
        /// Whether the old basis has a mean.
        centred: bool,
    },
    /// The modes of an old basis are not orthonormal in the inner product of its update.
    #[error(
        "the modes of the old basis are off orthonormality by {defect:.1e} in this inner product: \
         update it with the weights that it was made with"
    )]
    OldModes {
        /// Largest entry of `Phiᵀ W Phi - I`.
        defect: f64,
    },
    /// An algorithm or an inner product needs whole columns, of which each rank has some rows.
    #[error(
        "{ranks} ranks share the rows, but this algorithm or inner product needs whole columns: \
         take `snapshots` or `svd` with weights for each unknown, or one rank"
    )]
    WholeColumns {
        /// Number of ranks.
        ranks: usize,
    },
    /// Snapshots, weights or modes cannot be read or written.
    #[error("{0}")]
    Medium(#[from] io::Error),
    /// Another of the machines that share the work has failed.
    #[error("{0}")]
    Elsewhere(Failure),
}

impl From<Failure> for PodError {
    fn from(failure: Failure) -> Self {
        Self::Elsewhere(failure)
    }
}

impl PodError {
    /// Whether the computation failed, and not its input or the medium.
    pub fn is_of_computation(&self) -> bool {
        match self {
            Self::NoConvergence { .. } | Self::LostOrthogonality | Self::AllNoise { .. } => true,
            Self::Elsewhere(failure) => failure.of_computation,
            _ => false,
        }
    }
}

fn no_energy(centred: bool) -> &'static str {
    if centred {
        "they are constant in time to round-off; do not subtract the mean, or record a flow that moves"
    } else {
        "every entry is zero or too small to be squared"
    }
}
