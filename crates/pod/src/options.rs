use faer::Par;

/// How many modes to keep.
///
/// ```
/// use lumley_pod::Truncation;
/// assert_eq!(Truncation::default(), Truncation::Energy(0.9999));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Truncation {
    /// This many, at least one.
    Modes(usize),
    /// The fewest that hold this fraction of the energy, paper eq. (31), in (0, 1].
    Energy(f64),
}

impl Default for Truncation {
    fn default() -> Self {
        Self::Energy(0.9999)
    }
}

/// What to decompose and how far.
///
/// ```
/// use lumley_pod::{Options, Truncation};
/// let options = Options { truncation: Truncation::Modes(6), center: true, ..Options::default() };
/// assert_eq!(options.memory_limit, 4 << 30);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Number of modes; by default those that hold 99.99 % of the energy.
    pub truncation: Truncation,
    /// Whether the time mean is subtracted first, with the weights of the time average.
    pub center: bool,
    /// Weights of the M snapshots in the time average, positive; they are scaled to the sum 1.
    /// By default each is 1/M. A snapshot of share q has coefficients with an error of about
    /// `eps sigma_1/sqrt(M q)`; shares under 1e-30 are refused. See [`time_weights`](crate::time_weights) for unequal steps.
    pub time_weights: Option<Vec<f64>>,
    /// Threads for the work that grows with the number of unknowns; by default one. The result
    /// is the same to the last bit.
    pub par: Par,
    /// Whether to measure what the modes leave of each snapshot, paper eq. (32), on the way.
    pub residuals: bool,
    /// Most memory, in bytes, that a decomposition may take for what it holds; 4 GiB by default. It
    /// changes no bit of the result. Modes that are kept in memory are not counted.
    pub memory_limit: u64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            truncation: Truncation::default(),
            center: false,
            time_weights: None,
            par: Par::Seq,
            residuals: false,
            memory_limit: 4 << 30,
        }
    }
}
