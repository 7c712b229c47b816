//! Several processes on one decomposition: how many were started, and MPI between them (feature `mpi`).

mod error;
mod job;
mod launcher;
#[cfg(feature = "mpi")]
mod mpi;

#[cfg(feature = "mpi")]
pub use self::mpi::MpiRanks;
pub use error::RanksError;
pub use job::Job;
pub use launcher::launched_processes;

use crate::Error;
use lumley_pod::{Failure, Ranks, all_or_none, from_first};
use std::path::PathBuf;

/// Whether all ranks may go on: what failed on one of them has failed on all.
pub(crate) fn together<T>(ranks: &dyn Ranks, mine: Result<T, Error>) -> Result<T, Error> {
    all_or_none(ranks, mine, |error| Failure {
        rank: ranks.rank(),
        message: error.to_string(),
        of_computation: error.exit_code() == 1,
    })
}

/// A path that rank 0 chooses for all.
pub(crate) fn path_of_first(
    ranks: &dyn Ranks,
    choose: impl FnOnce() -> PathBuf,
) -> Result<PathBuf, Error> {
    let chosen = || Ok::<_, Error>(choose().to_string_lossy().into_owned().into_bytes());
    let told = from_first(ranks, chosen, |_| unreachable!("a choice does not fail"))?;
    Ok(PathBuf::from(String::from_utf8_lossy(&told).into_owned()))
}
