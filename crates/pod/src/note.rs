use std::fmt;

/// What a user should know about a decomposition besides its numbers.
///
/// ```
/// use lumley_pod::Note;
/// let note = Note::Rank { requested: 8, rank: 3 };
/// assert!(note.to_string().starts_with("8 modes were asked for"));
/// assert!(note.is_warning());
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Note {
    /// More modes were asked for than the snapshots have.
    Rank {
        /// Modes asked for.
        requested: usize,
        /// Numerical rank of the snapshots: the modes returned.
        rank: usize,
    },
    /// Modes asked for lie under the noise of the algorithm and are left out.
    NoiseFloor {
        /// Modes asked for.
        requested: usize,
        /// Modes above the noise: those returned.
        kept: usize,
        /// Eigenvalue below which the algorithm sees noise only.
        floor: f64,
    },
    /// What [`auto`](crate::auto) took, and what it measured that made it do so.
    Chosen {
        /// Name of the algorithm.
        algorithm: &'static str,
        /// Least eigenvalue asked for, relative to the first, as the correlation matrix saw it.
        smallest: f64,
        /// Least whose singular value a correlation matrix gives to 1e-6.
        bound: f64,
    },
}

impl Note {
    /// Whether the result differs from what was asked for.
    pub fn is_warning(&self) -> bool {
        !matches!(self, Self::Chosen { .. })
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rank { requested, rank } => write!(
                f,
                "{requested} modes were asked for but the snapshots have the rank {rank}: all of \
                 them are returned"
            ),
            Self::NoiseFloor { requested, kept, floor } => write!(
                f,
                "{requested} modes were asked for but those after mode {kept} have eigenvalues \
                 under {floor:.1e}, which this algorithm cannot tell from round-off: they are left \
                 out; take `svd` to see whether there is something"
            ),
            Self::Chosen { algorithm, smallest, bound } => write!(
                f,
                "{algorithm} was taken: the least eigenvalue asked for is {smallest:.1e} of the \
                 first, and a correlation matrix is exact down to {bound:.1e}"
            ),
        }
    }
}
