#[cfg(feature = "mpi")]
use super::MpiRanks;
use super::{RanksError, launched_processes};
use lumley_pod::{Alone, Ranks};
use std::process::ExitCode;

/// This process's place among those that were started together.
///
/// MPI is initialised only where there are others: a process alone starts as fast as ever.
///
/// ```
/// use lumley::ranks::{Job, launched_processes};
/// if launched_processes() == 1 {
///     let job = Job::join()?;
///     assert_eq!(job.ranks().count(), 1);
///     job.end(0);
/// }
/// # Ok::<(), lumley::ranks::RanksError>(())
/// ```
pub enum Job {
    /// One process.
    Alone,
    /// One of several.
    #[cfg(feature = "mpi")]
    Mpi(MpiRanks),
}

impl Job {
    /// Joins the other processes, if there are any. To be called once, on the main thread.
    ///
    /// # Errors
    /// [`RanksError::WithoutMpi`] in a build without MPI, else those of `MpiRanks::initialise`.
    pub fn join() -> Result<Self, RanksError> {
        match launched_processes() {
            1 => Ok(Self::Alone),
            #[cfg(feature = "mpi")]
            _ => MpiRanks::initialise().map(Self::Mpi),
            #[cfg(not(feature = "mpi"))]
            started => Err(RanksError::WithoutMpi { started }),
        }
    }

    /// What the decomposition sees of it.
    pub fn ranks(&self) -> &dyn Ranks {
        match self {
            Self::Alone => &Alone,
            #[cfg(feature = "mpi")]
            Self::Mpi(ranks) => ranks,
        }
    }

    /// Ends this process's part: with 0 it waits for the others to end theirs; any other status
    /// ends every process at once, after what this one has to say.
    pub fn end(self, status: u8) -> ExitCode {
        match (self, status) {
            #[cfg(feature = "mpi")]
            (Self::Mpi(ranks), 0) => ranks.finalise(),
            #[cfg(feature = "mpi")]
            (Self::Mpi(ranks), _) => ranks.abort(status),
            (Self::Alone, _) => {}
        }
        ExitCode::from(status)
    }
}
