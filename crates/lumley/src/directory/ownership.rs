//! What stands at a path, whether lumley made it, and its removal.

use super::{DirectoryError, Existing};
use crate::format::atomic;
use crate::manifest::{MANIFEST, Manifest, ManifestError};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

pub(super) const LOCK: &str = ".lumley-lock";

/// Whether the run in `partial` may become `target`.
pub(super) fn check_target(
    target: &Path,
    partial: &Path,
    existing: Existing,
) -> Result<(), DirectoryError> {
    let path = target.to_owned();
    if target.is_symlink() {
        Err(DirectoryError::Link { path })
    } else if !target.exists() || is_empty(target) {
        Ok(())
    } else if !is_run(target) {
        Err(DirectoryError::NotEmpty { path })
    } else if existing.replace {
        check_only_ours(target)
    } else if !partial.is_symlink() && is_ours(partial) {
        Err(DirectoryError::Replacement { path, partial: partial.to_owned() })
    } else {
        Err(DirectoryError::Exists { path })
    }
}

/// Whether a run may be made in `partial`.
pub(super) fn check_partial(partial: &Path, existing: Existing) -> Result<(), DirectoryError> {
    let path = partial.to_owned();
    if partial.is_symlink() {
        Err(DirectoryError::Link { path })
    } else if existing.resume && !partial.is_dir() {
        Err(DirectoryError::NothingToResume { path })
    } else if !partial.exists() || is_empty(partial) {
        Ok(())
    } else if !is_ours(partial) {
        Err(DirectoryError::NotEmpty { path })
    } else if existing.replace || existing.resume {
        Ok(())
    } else {
        Err(DirectoryError::Unfinished { path })
    }
}

/// What a run has at its top. Anything else in it is somebody's own, and is not removed with the run.
const OURS: [&str; 22] = [
    MANIFEST,
    LOCK,
    "basis",
    "bodies.csv",
    "case.toml",
    "checkpoint",
    "end.npz",
    "figures",
    "initial_flow.csv",
    "loads.csv",
    "mesh.msh",
    "mesh.npz",
    "paraview",
    "pictures",
    "pod.npz",
    "probes.csv",
    "record",
    "report.html",
    "residuals.csv",
    "rom",
    "steps.csv",
    "summary.json",
];

/// Copies of the tables that a flow's case names: `velocity-1.csv`, `velocity-2.csv`, ...
fn is_copy(name: &str) -> bool {
    let number = name.strip_prefix("velocity-").and_then(|rest| rest.strip_suffix(".csv"));
    number.is_some_and(|number| number.parse::<usize>().is_ok())
}

fn check_only_ours(run: &Path) -> Result<(), DirectoryError> {
    let found = entries(run).map_err(DirectoryError::io("read", run))?;
    let is_ours = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        atomic::is_temporary(path) || OURS.contains(&&*name) || is_copy(&name)
    };
    match found.into_iter().find(|path| !is_ours(path)) {
        Some(path) => Err(DirectoryError::Foreign { path }),
        None => Ok(()),
    }
}

/// A manifest of another version or a damaged one is still a sign of lumley.
fn is_run(path: &Path) -> bool {
    matches!(Manifest::read(path), Ok(_) | Err(ManifestError::Damaged { .. }))
}

/// A run, or what one leaves that was killed before its first file was whole.
fn is_ours(partial: &Path) -> bool {
    let is_lock = |path: &PathBuf| path.file_name().is_some_and(|name| name == LOCK);
    is_run(partial)
        || entries(partial).is_ok_and(|found| {
            found.iter().any(is_lock)
                && found.iter().all(|path| is_lock(path) || atomic::is_temporary(path))
        })
}

fn is_empty(path: &Path) -> bool {
    entries(path).is_ok_and(|found| found.is_empty())
}

fn entries(folder: &Path) -> io::Result<Vec<PathBuf>> {
    fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path())).collect()
}

/// Locks `partial` for this process.
pub(super) fn lock(partial: &Path) -> Result<File, DirectoryError> {
    let path = partial.join(LOCK);
    // Not truncated: it could be a link.
    let opened = OpenOptions::new().write(true).create(true).truncate(false).open(&path);
    let file = opened.map_err(DirectoryError::io("create", &path))?;
    match file.try_lock() {
        // Gone: the process that held the lock has just finished, and moved the directory.
        Ok(()) if path.exists() => Ok(file),
        Ok(()) | Err(TryLockError::WouldBlock) => {
            Err(DirectoryError::Busy { path: partial.to_owned() })
        }
        Err(TryLockError::Error(source)) => {
            Err(DirectoryError::Io { action: "lock", path, source })
        }
    }
}

/// Removes all but the lock.
pub(super) fn clear(partial: &Path) -> Result<(), DirectoryError> {
    let found = entries(partial).map_err(DirectoryError::io("read", partial))?;
    let mut others = found.iter().filter(|path| path.file_name().is_some_and(|name| name != LOCK));
    others.try_for_each(|path| remove(path))
}

/// Removes what a killed writer left in `folder`, which need not exist.
pub(super) fn sweep(folder: &Path) -> Result<(), DirectoryError> {
    if !folder.is_dir() || folder.is_symlink() {
        return Ok(());
    }
    let found = entries(folder).map_err(DirectoryError::io("read", folder))?;
    found.iter().filter(|path| atomic::is_temporary(path)).try_for_each(|path| remove(path))
}

/// Removes a file, a folder or a link, never what a link points at; nothing there is no error.
pub(super) fn remove(path: &Path) -> Result<(), DirectoryError> {
    let is_folder = path.is_dir() && !path.is_symlink();
    let removed = if is_folder { fs::remove_dir_all(path) } else { fs::remove_file(path) };
    match removed {
        Err(e) if e.kind() != io::ErrorKind::NotFound => Err(DirectoryError::io("remove", path)(e)),
        _ => Ok(()),
    }
}

/// Whether there is anything at `path`, be it a link to nothing.
pub(super) fn taken(path: &Path) -> bool {
    path.is_symlink() || path.exists()
}
