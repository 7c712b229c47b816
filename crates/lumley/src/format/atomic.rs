//! Files that appear whole or not at all.

use std::fs::{self, File};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// A file that takes its name, and the place of an older file of that name, only when it is complete.
///
/// It is written beside its target, brought to the disk and renamed. Dropped before
/// [`commit`](Self::commit), it leaves nothing behind; killed, a file `.NAME.PID-COUNT.tmp`.
///
/// ```
/// use lumley::format::atomic::AtomicFile;
/// use std::io::Write;
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("summary.json");
/// let mut file = AtomicFile::create(&path)?;
/// file.write_all(b"{}")?;
/// assert!(!path.exists());
/// file.commit()?;
/// assert_eq!(std::fs::read(&path)?, b"{}");
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug)]
pub struct AtomicFile {
    file: File,
    temporary: PathBuf,
    target: PathBuf,
}

impl AtomicFile {
    /// Begins the file that will be `target`.
    ///
    /// # Errors
    /// The system's, for example that the folder does not exist or may not be written.
    pub fn create(target: &Path) -> io::Result<Self> {
        loop {
            let temporary = temporary(target)?;
            match File::create_new(&temporary) {
                // Left by a killed process that had the number of this one, as in containers.
                Err(e) if e.kind() == io::ErrorKind::AlreadyExists => {}
                created => {
                    return Ok(Self { file: created?, temporary, target: target.to_owned() });
                }
            }
        }
    }

    /// Takes the file `temporary`, written before, to be `target`.
    ///
    /// # Errors
    /// The system's, for example that there is no such file.
    pub(super) fn adopt(temporary: &Path, target: &Path) -> io::Result<Self> {
        let file = File::options().read(true).write(true).open(temporary)?;
        Ok(Self { file, temporary: temporary.to_owned(), target: target.to_owned() })
    }

    /// What is written so far.
    pub(super) fn file(&self) -> &File {
        &self.file
    }

    /// Brings the content to the disk and gives it its name.
    ///
    /// # Errors
    /// The system's; an older file of that name then stands as it was.
    pub fn commit(self) -> io::Result<()> {
        let target = self.target.clone();
        self.commit_without_folder()?;
        sync_entry(&target);
        Ok(())
    }

    fn commit_without_folder(self) -> io::Result<()> {
        self.file.sync_all()?;
        fs::rename(&self.temporary, &self.target)
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Seek for AtomicFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}

impl Drop for AtomicFile {
    fn drop(&mut self) {
        // After `commit` it has another name and nothing is removed.
        let _ = fs::remove_file(&self.temporary);
    }
}

/// Writes `bytes` as the whole content of `path`.
///
/// # Errors
/// The system's; an older file then stands as it was.
pub fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    write_without_folder(path, bytes)?;
    sync_entry(path);
    Ok(())
}

/// Like [`write`](self::write), but after a power failure the older file may be back, unless [`sync_entry`] was
/// called for one of the files in that folder: once for many files.
pub(crate) fn write_without_folder(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = AtomicFile::create(path)?;
    file.write_all(bytes)?;
    file.commit_without_folder()
}

/// Brings the names in the folder of `path` to the disk. Not every system can: they are then as durable as it gets.
pub(crate) fn sync_entry(path: &Path) {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
}

/// Whether a file of this name was left by a writer that was killed.
pub fn is_temporary(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let inner = name.strip_prefix('.').and_then(|name| name.strip_suffix(".tmp"));
    let unique = inner.and_then(|inner| inner.rsplit_once('.')).filter(|(of, _)| !of.is_empty());
    let numbers = unique.and_then(|(_, unique)| unique.split_once('-'));
    numbers.is_some_and(|(pid, count)| pid.parse::<u32>().is_ok() && count.parse::<u64>().is_ok())
}

/// A name beside `target` that no other writer of this or another process uses now.
fn temporary(target: &Path) -> io::Result<PathBuf> {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let name = target.file_name().ok_or(io::ErrorKind::InvalidFilename)?;
    let count = COUNT.fetch_add(1, Ordering::Relaxed);
    let unique = format!(".{}.{}-{count}.tmp", name.to_string_lossy(), std::process::id());
    Ok(target.with_file_name(unique))
}
