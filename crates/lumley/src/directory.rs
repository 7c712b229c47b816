//! Run directories: where they may be made, what may replace them, how they survive a crash.
//!
//! A run in progress is `DIR.partial`; it is renamed when complete, so a directory without that ending
//! is always whole. Nothing that lumley did not make is ever removed.

use crate::format::atomic;
use crate::manifest::MANIFEST;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

const LOCK: &str = ".lumley-lock";

/// What may be done to what stands in the way; by default nothing, so that it is an error.
///
/// ```
/// use lumley::directory::Existing;
/// assert!(!Existing::default().replace);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Existing {
    /// `--force`: a run of lumley is replaced; anything else stays an error.
    pub replace: bool,
    /// `--resume`: an unfinished run goes on.
    pub resume: bool,
}

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
    /// There are files, and no run of lumley.
    #[error("{} exists and is not a run of lumley\n  help: choose another directory with -o; --force replaces only runs of lumley", path.display())]
    NotEmpty {
        /// The directory.
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
    #[error("{}: no run of lumley here ({MANIFEST} is missing)\n  help: give the directory that `lumley run` printed", path.display())]
    NotARun {
        /// What was given.
        path: PathBuf,
    },
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

/// A run directory that is being made.
///
/// ```
/// use lumley::directory::{Existing, Workplace};
/// let root = tempfile::tempdir()?;
/// let place = Workplace::claim(&root.path().join("piston"), Existing::default())?;
/// place.write("manifest.json", b"{}")?;
/// let finished = place.finish()?;
/// assert!(finished.join("manifest.json").exists());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Workplace {
    target: PathBuf,
    partial: PathBuf,
    existing: Existing,
    _lock: File,
}

impl Workplace {
    /// Claims `target`: makes `target.partial`, or takes it up again, and locks it.
    ///
    /// # Errors
    /// [`DirectoryError`] when something is in the way that `existing` does not allow to touch.
    pub fn claim(target: &Path, existing: Existing) -> Result<Self, DirectoryError> {
        let partial = partial(target);
        if existing.resume && !partial.is_dir() {
            return Err(DirectoryError::NothingToResume { path: partial });
        }
        check_target(target, existing)?;
        check_partial(&partial, existing)?;
        fs::create_dir_all(&partial).map_err(io_error("create", &partial))?;
        let lock = lock(&partial)?;
        if existing.replace && !existing.resume {
            clear(&partial)?;
        }
        Ok(Self { target: target.to_owned(), partial, existing, _lock: lock })
    }

    /// Where files go until the run is complete.
    pub fn path(&self) -> &Path {
        &self.partial
    }

    /// Where the run will be when it is complete.
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// Whether an earlier run is taken up again.
    pub fn resumed(&self) -> bool {
        self.existing.resume
    }

    /// Writes a file of the run, whole or not at all; folders on the way are made.
    ///
    /// # Errors
    /// [`DirectoryError::Io`].
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), DirectoryError> {
        write(&self.partial, name, bytes)
    }

    /// Makes a folder of the run, empty.
    ///
    /// # Errors
    /// [`DirectoryError::Io`].
    pub fn fresh_folder(&self, name: &str) -> Result<PathBuf, DirectoryError> {
        let path = self.partial.join(name);
        if path.exists() {
            fs::remove_dir_all(&path).map_err(io_error("empty", &path))?;
        }
        fs::create_dir_all(&path).map_err(io_error("create", &path))?;
        Ok(path)
    }

    /// Nothing of this is worth going on with: removes the partial directory, which lumley made.
    ///
    /// # Errors
    /// [`DirectoryError::Io`].
    pub fn abandon(self) -> Result<(), DirectoryError> {
        remove(&self.partial)
    }

    /// The run is complete: gives it its name, in the place of an older run where that was asked for.
    ///
    /// # Errors
    /// [`DirectoryError`]; the partial directory then stands as it was.
    pub fn finish(self) -> Result<PathBuf, DirectoryError> {
        let lock = self.partial.join(LOCK);
        let old = suffixed(&self.target, ".old");
        let replaced = self.existing.replace && self.target.exists();
        if replaced {
            check_target(&self.target, self.existing)?;
            remove(&old)?;
            fs::rename(&self.target, &old).map_err(io_error("move", &self.target))?;
        } else if is_empty(&self.target) {
            fs::remove_dir(&self.target).map_err(io_error("replace", &self.target))?;
        }
        fs::remove_file(&lock).map_err(io_error("remove", &lock))?;
        fs::rename(&self.partial, &self.target).map_err(io_error("rename", &self.partial))?;
        if replaced {
            remove(&old)?;
        }
        Ok(self.target)
    }
}

/// Writes the file `name` under `folder`, whole or not at all.
///
/// # Errors
/// [`DirectoryError::Io`].
pub fn write(folder: &Path, name: &str, bytes: &[u8]) -> Result<(), DirectoryError> {
    let path = folder.join(name);
    if let Some(parent) = path.parent() {
        fs::create_dir_all(parent).map_err(io_error("create", parent))?;
    }
    atomic::write(&path, bytes).map_err(|source| DirectoryError::Io {
        action: "write",
        path,
        source,
    })
}

/// The run directory of a case when none is named: `runs/NAME`, `runs/NAME-2`, ... the first free; to
/// resume, the newest unfinished one.
pub fn default_target(name: &str, resume: bool) -> PathBuf {
    let candidate = |k: usize| {
        let suffix = if k == 1 { String::new() } else { format!("-{k}") };
        Path::new("runs").join(format!("{name}{suffix}"))
    };
    let taken = |path: &PathBuf| path.exists() || partial(path).exists();
    let mut free = candidate(1);
    let mut unfinished = None;
    for k in 2.. {
        if !taken(&free) {
            break;
        }
        if partial(&free).exists() {
            unfinished = Some(free);
        }
        free = candidate(k);
    }
    unfinished.filter(|_| resume).unwrap_or(free)
}

/// `path`, if it is a complete run.
///
/// # Errors
/// [`DirectoryError::NotARun`].
pub fn completed(path: &Path) -> Result<&Path, DirectoryError> {
    if path.join(MANIFEST).is_file() {
        Ok(path)
    } else {
        Err(DirectoryError::NotARun { path: path.to_owned() })
    }
}

/// `DIR.partial` of `DIR`.
pub fn partial(target: &Path) -> PathBuf {
    suffixed(target, ".partial")
}

fn suffixed(path: &Path, suffix: &str) -> PathBuf {
    // Through components, so that a trailing slash does not make a hidden file inside.
    let mut name = path.components().as_path().as_os_str().to_owned();
    name.push(suffix);
    name.into()
}

fn check_target(target: &Path, existing: Existing) -> Result<(), DirectoryError> {
    if !target.exists() || is_empty(target) {
        return Ok(());
    }
    let path = target.to_owned();
    match (is_run(target), existing.replace) {
        (true, true) => Ok(()),
        (true, false) => Err(DirectoryError::Exists { path }),
        (false, _) => Err(DirectoryError::NotEmpty { path }),
    }
}

fn check_partial(partial: &Path, existing: Existing) -> Result<(), DirectoryError> {
    if !partial.exists() || is_empty(partial) {
        return Ok(());
    }
    let path = partial.to_owned();
    let ours = is_run(partial) || partial.join(LOCK).is_file();
    match (ours, existing.replace || existing.resume) {
        (true, true) => Ok(()),
        (true, false) => Err(DirectoryError::Unfinished { path }),
        (false, _) => Err(DirectoryError::NotEmpty { path }),
    }
}

fn is_run(path: &Path) -> bool {
    path.join(MANIFEST).is_file()
}

fn is_empty(path: &Path) -> bool {
    fs::read_dir(path).is_ok_and(|mut entries| entries.next().is_none())
}

fn lock(partial: &Path) -> Result<File, DirectoryError> {
    let path = partial.join(LOCK);
    let file = File::create(&path).map_err(io_error("create", &path))?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(DirectoryError::Busy { path: partial.to_owned() }),
        Err(TryLockError::Error(source)) => {
            Err(DirectoryError::Io { action: "lock", path, source })
        }
    }
}

fn clear(partial: &Path) -> Result<(), DirectoryError> {
    for entry in fs::read_dir(partial).map_err(io_error("read", partial))? {
        let path = entry.map_err(io_error("read", partial))?.path();
        if path.file_name().is_some_and(|name| name != LOCK) {
            remove(&path)?;
        }
    }
    Ok(())
}

fn remove(path: &Path) -> Result<(), DirectoryError> {
    let removed = if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) };
    match removed {
        Err(e) if e.kind() != io::ErrorKind::NotFound => Err(io_error("remove", path)(e)),
        _ => Ok(()),
    }
}

fn io_error<'a>(action: &'static str, path: &'a Path) -> impl Fn(io::Error) -> DirectoryError + 'a {
    move |source| DirectoryError::Io { action, path: path.to_owned(), source }
}
