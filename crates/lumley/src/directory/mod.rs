//! Run directories: where they may be made, what may replace them, how they survive a crash.
//!
//! A run in progress is `DIR.partial`; it is renamed when complete, so a directory without that ending
//! is always whole. Nothing is ever removed but runs of lumley, known by their manifest, and no
//! symbolic link is followed to what it points at.

mod error;
mod ownership;

pub use error::DirectoryError;

use crate::format::atomic;
use crate::manifest::{Manifest, ManifestError};
use ownership::{LOCK, check_partial, check_target, clear, lock, remove, sweep, taken};
use std::fs::{self, File};
use std::path::{Path, PathBuf};

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

/// A run directory that is being made.
///
/// ```
/// use lumley::directory::{Existing, Workplace};
/// let root = tempfile::tempdir()?;
/// let place = Workplace::claim(&root.path().join("piston"), Existing::default())?;
/// place.write("summary.json", b"{}")?;
/// let finished = place.finish()?;
/// assert!(finished.join("summary.json").exists());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Workplace {
    target: PathBuf,
    partial: PathBuf,
    existing: Existing,
    lock: File,
}

impl Workplace {
    /// Claims `target`: makes `target.partial`, or takes it up again, and locks it.
    ///
    /// # Errors
    /// [`DirectoryError`] when something is in the way that `existing` does not allow to touch.
    pub fn claim(target: &Path, existing: Existing) -> Result<Self, DirectoryError> {
        if target.file_name().is_none() {
            return Err(DirectoryError::NoName { path: target.to_owned() });
        }
        // Through components, because a trailing slash would follow a link.
        let target = target.components().as_path().to_owned();
        let partial = partial(&target);
        if existing.resume && !taken(&partial) {
            return Err(DirectoryError::NothingToResume { path: partial });
        }
        check_target(&target, &partial, existing)?;
        check_partial(&partial, existing)?;
        fs::create_dir_all(&partial).map_err(DirectoryError::io("create", &partial))?;
        let lock = lock(&partial)?;
        if existing.replace && !existing.resume {
            clear(&partial)?;
        }
        for folder in ["", "basis", "figures", "work"] {
            sweep(&partial.join(folder))?;
        }
        Ok(Self { target, partial, existing, lock })
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

    /// Makes a folder of the run, or leaves one that an unfinished run has.
    ///
    /// # Errors
    /// [`DirectoryError::Io`].
    pub fn folder(&self, name: &str) -> Result<PathBuf, DirectoryError> {
        let path = self.partial.join(name);
        fs::create_dir_all(&path).map_err(DirectoryError::io("create", &path))?;
        Ok(path)
    }

    /// Makes a folder of the run, empty.
    ///
    /// # Errors
    /// [`DirectoryError::Io`].
    pub fn fresh_folder(&self, name: &str) -> Result<PathBuf, DirectoryError> {
        let path = self.partial.join(name);
        remove(&path)?;
        fs::create_dir_all(&path).map_err(DirectoryError::io("create", &path))?;
        Ok(path)
    }

    /// Removes a file or folder of the run.
    ///
    /// # Errors
    /// [`DirectoryError::Io`].
    pub fn remove(&self, name: &str) -> Result<(), DirectoryError> {
        remove(&self.partial.join(name))
    }

    /// Nothing of this is worth going on with: removes the partial directory, which lumley made.
    ///
    /// # Errors
    /// [`DirectoryError::Io`].
    pub fn abandon(self) -> Result<(), DirectoryError> {
        let Self { partial, lock, .. } = self;
        clear(&partial)?;
        // On some network file systems a folder in which a file is open cannot be removed.
        drop(lock);
        remove(&partial)
    }

    /// The run is complete: gives it its name, in the place of an older run where that was asked for.
    ///
    /// The older run stands aside as `.NAME.replaced-PID` until the new one has its name on the disk.
    ///
    /// # Errors
    /// [`DirectoryError`]; the partial directory and the older run then stand as they were, unless it
    /// was the removal of the older run that failed.
    pub fn finish(self) -> Result<PathBuf, DirectoryError> {
        let aside = self.make_way()?;
        if let Err(source) = fs::rename(&self.partial, &self.target) {
            if let Some(aside) = &aside {
                fs::rename(aside, &self.target).map_err(DirectoryError::io("move back", aside))?;
            }
            return Err(DirectoryError::io("rename", &self.partial)(source));
        }
        atomic::sync_entry(&self.target);
        // Only now, so that nobody takes the partial directory for one that was left.
        remove(&self.target.join(LOCK))?;
        aside.as_deref().map_or(Ok(()), remove)?;
        Ok(self.target)
    }

    /// Frees the name of the run; says where the older run is now.
    fn make_way(&self) -> Result<Option<PathBuf>, DirectoryError> {
        let target = &self.target;
        check_target(target, &self.partial, self.existing)?;
        if !taken(target) {
            return Ok(None);
        }
        match fs::remove_dir(target) {
            Ok(()) => return Ok(None), // It was empty.
            Err(_) if self.existing.replace => {}
            Err(source) => return Err(DirectoryError::io("replace", target)(source)),
        }
        let aside = aside(target);
        fs::rename(target, &aside).map_err(DirectoryError::io("move", target))?;
        Ok(Some(aside))
    }
}

/// A free name beside `target`: a process before this one may have had its number, and died.
fn aside(target: &Path) -> PathBuf {
    let name = target.file_name().expect("claimed with a name").to_string_lossy();
    let stem = format!(".{name}.replaced-{}", std::process::id());
    let mut aside = target.with_file_name(&stem);
    for k in 2.. {
        if !taken(&aside) {
            break;
        }
        aside.set_file_name(format!("{stem}-{k}"));
    }
    aside
}

/// Writes the file `name` under `folder`, whole or not at all.
///
/// # Errors
/// [`DirectoryError::Io`].
pub fn write(folder: &Path, name: &str, bytes: &[u8]) -> Result<(), DirectoryError> {
    let path = folder.join(name);
    if let Some(parent) = path.parent() {
        fs::create_dir_all(parent).map_err(DirectoryError::io("create", parent))?;
    }
    atomic::write(&path, bytes).map_err(DirectoryError::io("write", &path))
}

/// The run directory of a case when none is named: `runs/NAME`, `runs/NAME-2`, ... the first free; to
/// resume, the newest unfinished one.
pub fn default_target(name: &str, resume: bool) -> PathBuf {
    let candidate = |k: usize| {
        let suffix = if k == 1 { String::new() } else { format!("-{k}") };
        Path::new("runs").join(format!("{name}{suffix}"))
    };
    let mut free = candidate(1);
    let mut unfinished = None;
    for k in 2.. {
        let begun = taken(&partial(&free));
        if !begun && !taken(&free) {
            break;
        }
        if begun {
            unfinished = Some(free);
        }
        free = candidate(k);
    }
    unfinished.filter(|_| resume).unwrap_or(free)
}

/// `path`, if it is a complete run.
///
/// # Errors
/// [`DirectoryError::NotARun`] without a manifest, [`DirectoryError::Manifest`] with one that cannot be
/// used, [`DirectoryError::Incomplete`] for an unfinished run.
pub fn completed(path: &Path) -> Result<&Path, DirectoryError> {
    match Manifest::read(path) {
        Ok(manifest) if manifest.complete => Ok(path),
        Ok(_) => Err(DirectoryError::Incomplete { path: path.to_owned() }),
        Err(ManifestError::Missing { .. }) => {
            Err(DirectoryError::NotARun { path: path.to_owned() })
        }
        Err(error) => Err(error.into()),
    }
}

/// `DIR.partial` of `DIR`.
pub fn partial(target: &Path) -> PathBuf {
    // Through components, so that a trailing slash does not make a hidden file inside.
    let mut name = target.components().as_path().as_os_str().to_owned();
    name.push(".partial");
    name.into()
}
