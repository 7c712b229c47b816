//! The first and the last stage of every run of a case: what it is goes to its directory before anything
//! else, its summary and its report go there last.

use super::{Task, checkpoint, report};
use crate::Error;
use crate::directory::{DirectoryError, Workplace};
use crate::manifest::{Input, MANIFEST, Manifest};
use crate::progress::Progress;
use crate::summary::{SUMMARY, Summary};
use serde::de::DeserializeOwned;
use std::fs;
use std::path::Path;

/// Name of the resolved case file in a run directory.
pub(super) const CASE: &str = "case.toml";

/// A file that a run is made from, as its directory keeps it.
#[derive(Debug, Clone)]
pub(super) struct Kept {
    pub name: String,
    pub content: Vec<u8>,
}

impl Kept {
    pub fn new(name: &str, content: impl Into<Vec<u8>>) -> Self {
        Self { name: name.to_owned(), content: content.into() }
    }

    fn stands_in(&self, place: &Workplace) -> bool {
        fs::read(place.path().join(&self.name)).is_ok_and(|begun| begun == self.content)
    }
}

/// Writes what the run of the case called `name` is, its resolved case file and what that refers to, or
/// checks that it goes on with the same.
pub(super) fn begin(
    name: &str,
    kept: &[Kept],
    task: &Task,
    place: &Workplace,
) -> Result<Manifest, Error> {
    // Without its case, which comes last, nothing was begun.
    let begun = place.resumed() && place.path().join(CASE).exists();
    if begun && !kept.iter().all(|file| file.stands_in(place)) {
        return Err(Error::OtherCase { path: place.path().to_owned() });
    }
    let mut manifest = Manifest::new(name, &task.command);
    manifest.inputs.extend(kept.iter().map(|file| Input::new(&file.name, &file.content)));
    // First of all: by its manifest a directory is known as lumley's.
    place.write(MANIFEST, manifest.to_json().as_bytes())?;
    // The case comes last: with it, all that it refers to is there.
    for file in kept.iter().rev() {
        place.write(&file.name, &file.content)?;
    }
    Ok(manifest)
}

/// Writes summary, report and, last, that the run is complete but for its name.
pub(super) fn finish(
    place: &Workplace,
    mut manifest: Manifest,
    summary: &Summary,
    progress: &mut Progress,
) -> Result<(), Error> {
    place.write(SUMMARY, summary.to_json().as_bytes())?;
    place.write(MANIFEST, manifest.to_json().as_bytes())?;
    progress.begin("report", 1);
    report::write(place.path())?;
    manifest.stage("report", progress.end("report.html"));
    checkpoint::remove(place)?;
    manifest.complete = true;
    place.write(MANIFEST, manifest.to_json().as_bytes())?;
    Ok(())
}

/// Whether `folder` is the run of a case, and not the POD of snapshots alone.
pub(super) fn check_is_of_a_case(folder: &Path) -> Result<(), Error> {
    if folder.join(CASE).exists() { Ok(()) } else { Err(Error::NoCase { path: folder.to_owned() }) }
}

/// Manifest and summary of the run in `folder`.
///
/// # Errors
/// A file that is missing or damaged.
pub fn read_summary(folder: &Path) -> Result<(Manifest, Summary), Error> {
    Ok((read_json(&folder.join(MANIFEST))?, read_json(&folder.join(SUMMARY))?))
}

fn read_json<T: DeserializeOwned>(path: &Path) -> Result<T, Error> {
    let unreadable = |source| DirectoryError::Io { action: "read", path: path.to_owned(), source };
    let bytes = fs::read(path).map_err(unreadable)?;
    serde_json::from_slice(&bytes)
        .map_err(|e| Error::Damaged { path: path.to_owned(), message: e.to_string() })
}
