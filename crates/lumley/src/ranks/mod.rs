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
    all_or_none(ranks, mine, |error| failure(ranks, error))
}

/// What the others hear of `error`; one that came from another rank stays that rank's.
fn failure(ranks: &dyn Ranks, error: &Error) -> Failure {
    match error {
        Error::Elsewhere(failure) => failure.clone(),
        error => Failure {
            rank: ranks.rank(),
            message: error.to_string(),
            of_computation: error.exit_code() == 1,
        },
    }
}

/// What rank 0 finds, for all, or its failure.
pub(crate) fn told_by_first(
    ranks: &dyn Ranks,
    find: impl FnOnce() -> Result<Vec<u8>, Error>,
) -> Result<Vec<u8>, Error> {
    from_first(ranks, find, |error| failure(ranks, error))
}

/// A path that rank 0 chooses for all.
pub(crate) fn path_of_first(
    ranks: &dyn Ranks,
    choose: impl FnOnce() -> PathBuf,
) -> Result<PathBuf, Error> {
    let told = told_by_first(ranks, || Ok(choose().to_string_lossy().into_owned().into_bytes()))?;
    Ok(PathBuf::from(String::from_utf8_lossy(&told).into_owned()))
}
