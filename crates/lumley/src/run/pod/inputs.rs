//! What a decomposition is made of and how, so that it never goes on with something else.

use super::PodInput;
use crate::Error;
use crate::case::PodChoice;
use crate::directory::{DirectoryError, partial};
use crate::manifest::{Input, Machine, Manifest};
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

impl PodInput {
    /// The record that the snapshots are in, where they are in one.
    pub(super) fn record(&self) -> Option<PathBuf> {
        let inner = self.path.join("record");
        let record = if inner.is_dir() { &inner } else { &self.path };
        record.join("zarr.json").is_file().then(|| record.clone())
    }

    /// The files that are read, by argument; of a record the one that is written with every snapshot.
    fn files(&self) -> [(&'static str, Option<PathBuf>); 4] {
        let snapshots = self.record().map_or_else(|| self.path.clone(), |r| r.join("zarr.json"));
        [
            ("snapshots", Some(snapshots)),
            ("--weights", self.weights.clone()),
            ("--times", self.times.clone()),
            ("--update", self.old_path()),
        ]
    }

    /// Whether nothing that is read goes with what the run at `target` replaces.
    pub(super) fn check_outside(&self, target: &Path) -> Result<(), Error> {
        for (argument, path) in self.files() {
            if let Some(path) = path.filter(|path| is_part_of(path, target)) {
                let expected = "something outside of the run that it makes".into();
                return Err(Error::Argument {
                    argument,
                    value: path.display().to_string(),
                    expected,
                });
            }
        }
        Ok(())
    }

    /// The files that were read, by name, length and checksum.
    pub(super) fn inputs(&self) -> Result<Vec<Input>, Error> {
        let files = self.files().into_iter().filter_map(|(_, path)| path);
        let input = |path: PathBuf| match Input::of_file(&path) {
            Ok(input) => Ok(input),
            Err(source) => Err(DirectoryError::Io { action: "read", path, source }.into()),
        };
        files.filter(|path| path.is_file()).map(input).collect()
    }

    /// What must be the same for a decomposition to go on, beside its inputs: their times too, since the
    /// checksum of a long file and of a record leaves out most of it.
    pub(super) fn settings(&self) -> Vec<String> {
        let Self { layout, components, choice, skip_non_finite, .. } = self;
        let PodChoice { method, truncation, center, .. } = choice;
        let files = self.files().map(|(argument, path)| {
            path.map_or_else(|| format!("no {argument}"), |p| format!("{argument} {}", dated(&p)))
        });
        let options = [
            format!("--snapshots {layout:?}"),
            format!("--components {components}"),
            format!("--method {method}"),
            format!("{truncation:?}"),
            format!("--center {center}"),
            format!("--skip-non-finite {skip_non_finite}"),
            // Products round differently on others, and a pass must not end with another basis.
            format!("processor {}", Machine::this().processor),
        ];
        options.into_iter().chain(files).collect()
    }
}

/// Whether `file` lies in the run at `target`, finished or not, by whatever name.
fn is_part_of(file: &Path, target: &Path) -> bool {
    let Ok(file) = file.canonicalize() else { return false };
    let folders = [target.to_owned(), partial(target)];
    folders.iter().filter_map(|path| path.canonicalize().ok()).any(|path| file.starts_with(path))
}

/// The name of a file, and when it was changed.
fn dated(path: &Path) -> String {
    let modified = std::fs::metadata(path).and_then(|metadata| metadata.modified()).ok();
    let age = modified.and_then(|time| time.duration_since(UNIX_EPOCH).ok()).unwrap_or_default();
    format!("{} of {}.{:09} s after 1970", path.display(), age.as_secs(), age.subsec_nanos())
}

/// The first thing in which a decomposition begun with `begun` differs from `now`, as it was and as it is.
pub(super) fn difference(begun: &Manifest, now: &Manifest) -> Option<(String, String)> {
    terms(begun).zip(terms(now)).find(|(begun, now)| begun != now)
}

/// The settings tell how many inputs there are, so that these are compared one by one.
fn terms(manifest: &Manifest) -> impl Iterator<Item = String> {
    let version = format!("lumley {}", manifest.version);
    let input = |i: &Input| format!("{} of {} bytes with CRC-32C {}", i.name, i.bytes, i.crc32c);
    let inputs = manifest.inputs.iter().map(input);
    std::iter::once(version).chain(manifest.settings.iter().cloned()).chain(inputs)
}
