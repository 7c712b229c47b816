use crate::manifest::{MANIFEST, ManifestError};
use std::io;
use std::path::{Path, PathBuf};

/// Why a run directory cannot be used.
///
/// ```
/// use lumley::directory::DirectoryError;
/// let error = DirectoryError::NotEmpty { path: "data".into() };
/// assert!(error.to_string().contains("--force"));
/// ```
#[derive(Debug, thiserror::Error)]
pub enum DirectoryError {
    /// There is a run already.
    #[error("{} exists already\n  help: choose another directory with -o, or replace this run with --force", path.display())]
    Exists {
        /// The directory.
        path: PathBuf,
    },
    /// There is a run already, and an unfinished one to replace it.
    #[error("{} exists already, and {} is an unfinished run to replace it\n  help: continue that one and then replace with --resume --force; --force alone begins it again", path.display(), partial.display())]
    Replacement {
        /// The directory.
        path: PathBuf,
        /// The unfinished run.
        partial: PathBuf,
    },
    /// There are files, and no run of lumley.
    #[error("{} exists and is not a run of lumley\n  help: choose another directory with -o; --force replaces only runs of lumley", path.display())]
    NotEmpty {
        /// The directory.
        path: PathBuf,
    },
    /// A run that is to be replaced holds something that lumley did not make.
    #[error("{} is not lumley's, and would be lost with the run it stands in\n  help: move it away, or choose another directory with -o", path.display())]
    Foreign {
        /// The file or folder.
        path: PathBuf,
    },
    /// A symbolic link stands there.
    #[error("{} is a symbolic link\n  help: give the directory itself with -o, or remove the link", path.display())]
    Link {
        /// The link.
        path: PathBuf,
    },
    /// The path does not end in a name, so that nothing can be made beside it and renamed.
    #[error("{}: expected the name of a directory to make\n  help: choose one with -o, such as runs/piston", path.display())]
    NoName {
        /// What was given.
        path: PathBuf,
    },
    /// A run stopped before its end.
    #[error("{} is an unfinished run\n  help: continue it with --resume, or begin again with --force", path.display())]
    Unfinished {
        /// The partial directory.
        path: PathBuf,
    },
    /// `--resume` without anything to resume.
    #[error("there is no unfinished run at {}\n  help: leave --resume out", path.display())]
    NothingToResume {
        /// Where it was looked for.
        path: PathBuf,
    },
    /// Another process works here.
    #[error("{} is being written by another process\n  help: wait for it, or choose another directory with -o", path.display())]
    Busy {
        /// The partial directory.
        path: PathBuf,
    },
    /// Not a directory that lumley made.
    #[error("{}: no run of lumley here ({MANIFEST} is missing)\n  help: give the directory that `lumley run` or `lumley pod` printed", path.display())]
    NotARun {
        /// What was given.
        path: PathBuf,
    },
    /// A run that is needed whole is not.
    #[error("{} is an unfinished run\n  help: continue it with --resume, as it was begun", path.display())]
    Incomplete {
        /// The run.
        path: PathBuf,
    },
    /// The manifest cannot be used.
    #[error(transparent)]
    Manifest(#[from] ManifestError),
    /// The system refused.
    #[error("cannot {action} {}: {source}\n  help: check the path, its permissions and the free space", path.display())]
    Io {
        /// What was tried.
        action: &'static str,
        /// The file or directory.
        path: PathBuf,
        /// The system's answer.
        source: io::Error,
    },
}

impl DirectoryError {
    pub(super) fn io<'a>(action: &'static str, path: &'a Path) -> impl Fn(io::Error) -> Self + 'a {
        move |source| Self::Io { action, path: path.to_owned(), source }
    }
}
