/// Why the processes that were started together cannot work together.
///
/// ```
/// use lumley::ranks::RanksError;
/// let error = RanksError::WithoutMpi { started: 4 };
/// assert!(error.to_string().contains("cargo build --release --features mpi"));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum RanksError {
    /// A launcher started several processes of a lumley that knows no MPI.
    #[error(
        "{started} processes were started, and this lumley was built without MPI: each would do all the work\n  help: cargo build --release --features mpi; or start one process, without mpirun or srun"
    )]
    WithoutMpi {
        /// Processes that the launcher started.
        started: usize,
    },
    /// The launcher belongs to another MPI than the one lumley was built with.
    #[error(
        "{started} processes were started, and MPI joined {joined} of them: the launcher belongs to another MPI than lumley was built with\n  help: use the mpirun that belongs to the mpicc of the build; under Slurm, srun --mpi=pmix"
    )]
    Launcher {
        /// Processes that the launcher started.
        started: usize,
        /// Processes in this process's MPI world.
        joined: usize,
    },
    /// MPI is in use in this process.
    #[error(
        "MPI was initialised before in this process, and can be only once\n  help: let lumley initialise it, and once"
    )]
    AlreadyInitialised,
    /// The MPI library allows no threads.
    #[error(
        "this MPI library allows no threads beside the one that calls it (expected at least MPI_THREAD_FUNNELED)\n  help: use an MPI library built with threads"
    )]
    NoThreads,
}
