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
///     assert_eq!((job.ranks().count(), job.neighbours()), (1, 1));
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

    /// How many of the processes, this one among them, share this machine and its memory.
    pub fn neighbours(&self) -> usize {
        match self {
            Self::Alone => 1,
            #[cfg(feature = "mpi")]
            Self::Mpi(ranks) => ranks.neighbours(),
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

    /// Waits until `rank`, which has failed and is to say why, ends every process.
    ///
    /// # Panics
    /// If that rank goes on instead, or this process is alone.
    pub fn wait_for_end_by(self, rank: usize) -> ! {
        // Not finalised: of a job that one rank leaves while another ends it, some launchers crash or
        // hang themselves (Open MPI 4.1.4 with PMIx 4.2.2, 3 jobs of 100).
        self.ranks().receive(rank);
        unreachable!("rank {rank} has failed and goes on")
    }
}
