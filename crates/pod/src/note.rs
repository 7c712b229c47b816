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
    /// The algorithm that [`auto`](crate::auto) took.
    Chosen(Choice),
}

impl Note {
    /// Whether the result differs from what was asked for.
    pub fn is_warning(&self) -> bool {
        !matches!(self, Self::Chosen(_))
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
            Self::Chosen(choice) => choice.fmt(f),
        }
    }
}

/// Which algorithm [`auto`](crate::auto) took, and what it measured that made it do so.
///
/// ```
/// use lumley_pod::Choice;
/// let choice = Choice::SvdFewUnknowns { unknowns: 10, snapshots: 30 };
/// assert_eq!(choice.to_string(), "svd: with 10 unknowns and 30 snapshots it costs no more than a Gram matrix");
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Choice {
    /// The Gram matrix gives every singular value asked for to 1e-6.
    Snapshots {
        /// Least eigenvalue asked for, relative to the first.
        smallest: f64,
        /// Least that the Gram matrix resolves to that accuracy.
        bound: f64,
    },
    /// The Gram matrix would not.
    SvdBelowBound {
        /// Least eigenvalue asked for, relative to the first, as the Gram matrix saw it.
        smallest: f64,
        /// Least that the Gram matrix resolves to that accuracy.
        bound: f64,
    },
    /// There are fewer unknowns than snapshots.
    SvdFewUnknowns {
        /// Length n of a snapshot.
        unknowns: usize,
        /// Number M of snapshots.
        snapshots: usize,
    },
}

impl fmt::Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Snapshots { smallest, bound } => write!(
                f,
                "snapshots: the least eigenvalue asked for is {smallest:.1e} of the first, and the \
                 Gram matrix is exact down to {bound:.1e}"
            ),
            Self::SvdBelowBound { smallest, bound } => write!(
                f,
                "svd: the least eigenvalue asked for is {smallest:.1e} of the first, under the \
                 {bound:.1e} down to which a Gram matrix is exact"
            ),
            Self::SvdFewUnknowns { unknowns, snapshots } => write!(
                f,
                "svd: with {unknowns} unknowns and {snapshots} snapshots it costs no more than a \
                 Gram matrix"
            ),
        }
    }
}
