use crate::{Alone, Journal, NoJournal, Ranks};

/// A pass over the data, as those who watch see it.
///
/// ```
/// use lumley_pod::Pass;
/// let pass = Pass { number: 2, name: "modes", rows: 1000, snapshots: 200, over_snapshots: true };
/// assert_eq!(pass.bytes(1000), 1_600_000);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pass {
    /// Its number among the passes of this kind, from 1.
    pub number: usize,
    /// What it computes.
    pub name: &'static str,
    /// Rows that this process works through.
    pub rows: usize,
    /// Columns of each row.
    pub snapshots: usize,
    /// Whether it reads the snapshots; otherwise the modes just made, which are few.
    pub over_snapshots: bool,
}

impl Pass {
    /// Numbers in so many rows as `f64`, in bytes.
    pub fn bytes(&self, rows: usize) -> u64 {
        8 * self.snapshots as u64 * rows as u64
    }
}

/// Who sees how far a decomposition is.
///
/// ```
/// use lumley_pod::{Pass, Unwatched, Watch};
/// Unwatched.advance(&Pass { number: 1, name: "modes", rows: 9, snapshots: 3, over_snapshots: true }, 4);
/// ```
pub trait Watch {
    /// A pass begins; of a resumed one so many rows were done before.
    fn begin(&self, pass: &Pass, rows: usize);
    /// So many rows of the pass are done.
    fn advance(&self, pass: &Pass, rows: usize);
}

/// Nobody watches.
///
/// ```
/// use lumley_pod::{Execution, Unwatched};
/// let execution = Execution { watch: &Unwatched, ..Execution::default() };
/// assert_eq!(execution.ranks.count(), 1);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn begin(&self, _pass: &Pass, _rows: usize) {}

    fn advance(&self, _pass: &Pass, _rows: usize) {}
}

/// What surrounds a decomposition: the processes that share it, where it keeps what it has so far, and
/// who watches. By default one process, nothing, nobody.
///
/// ```
/// use lumley_pod::Execution;
/// assert_eq!(Execution::default().ranks.rank(), 0);
/// ```
#[derive(Clone, Copy)]
pub struct Execution<'a> {
    /// The processes that share the work.
    pub ranks: &'a dyn Ranks,
    /// Where it keeps what it has so far.
    pub journal: &'a dyn Journal,
    /// Who sees how far it is.
    pub watch: &'a dyn Watch,
}

impl Default for Execution<'_> {
    fn default() -> Self {
        Self { ranks: &Alone, journal: &NoJournal, watch: &Unwatched }
    }
}
