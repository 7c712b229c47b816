//! The run directory of a decomposition: begun, taken up again, finished or left for later.

use super::PodInput;
use super::inputs::difference;
use crate::Error;
use crate::directory::{DirectoryError, Workplace};
use crate::manifest::{MANIFEST, Manifest, ManifestError};
use crate::ranks::told_by_first;
use crate::run::modes::SCRATCH;
use crate::run::{Task, read_summary};
use crate::summary::Summary;
use lumley_pod::Ranks;
use std::path::Path;

/// Folder of a run for what a resumed decomposition needs; it goes when the run is complete.
pub(super) const WORK: &str = "work";

/// The run directory; one that is taken up again must have been begun with the same snapshots.
pub(super) fn claim(input: &PodInput, task: &Task) -> Result<Workplace, Error> {
    let mut manifest = Manifest::new(&input.path.display().to_string(), &task.command);
    manifest.inputs = input.inputs()?;
    manifest.settings = input.settings();
    let place = Workplace::claim(&task.target, task.existing)?;
    let begun = begun(place.path())?;
    if let Some((begun, now)) = begun.as_ref().and_then(|begun| difference(begun, &manifest)) {
        return Err(Error::OtherSnapshots { path: place.path().to_owned(), begun, now });
    }
    if !begun.is_some_and(|begun| begun.complete) {
        place.write(MANIFEST, manifest.to_json().as_bytes())?;
        place.folder(WORK)?;
    }
    Ok(place)
}

/// What the decomposition in `folder` was begun with; nothing where it was killed before it said.
fn begun(folder: &Path) -> Result<Option<Manifest>, DirectoryError> {
    match Manifest::read(folder) {
        Ok(begun) => Ok(Some(begun)),
        Err(ManifestError::Missing { .. }) => Ok(None),
        Err(error) => Err(error.into()),
    }
}

/// The summary of a decomposition that lacks nothing but its name: something kept it from taking that.
///
/// * `place`: the run directory, on rank 0
pub(super) fn complete(
    ranks: &dyn Ranks,
    place: Option<&Workplace>,
) -> Result<Option<Summary>, Error> {
    let told = told_by_first(ranks, || {
        let folder = place.expect("rank 0 has claimed it").path();
        if !begun(folder)?.is_some_and(|begun| begun.complete) {
            return Ok(Vec::new());
        }
        let (_, summary) = read_summary(folder)?;
        Ok(summary.to_json().into_bytes())
    })?;
    let summary = || serde_json::from_slice(&told).expect("rank 0 tells what it could read");
    Ok((!told.is_empty()).then(summary))
}

/// Gives a decomposition its name, or removes what nobody can go on with.
pub(super) fn leave(place: Workplace, done: &Result<Summary, Error>) -> Result<(), Error> {
    match done {
        Ok(_) => finish(place),
        // What was taken up again once may be taken up again with less to ask.
        Err(error) if place.resumed() || is_worth_resuming(error, place.path()) => Ok(()),
        Err(_) => Ok(place.abandon()?),
    }
}

/// What failed may go on where the machine was to blame and a pass was under way.
fn is_worth_resuming(error: &Error, folder: &Path) -> bool {
    let entries = std::fs::read_dir(folder.join(WORK)).into_iter().flatten().flatten();
    error.is_of_machine() && entries.count() > 0
}

/// The journal goes first: while there is one, what it counts on is there too.
fn finish(place: Workplace) -> Result<(), Error> {
    place.remove(WORK)?;
    place.remove(SCRATCH)?;
    place.finish()?;
    Ok(())
}
