use crate::format::{FormatError, atomic};
use lumley_pod::Journal;
use std::cell::Cell;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// What a decomposition has so far, in files of its run: an entry is a file that ends with the CRC-32C
/// of the rest, replaced whole or not at all.
pub(super) struct FileJournal {
    folder: PathBuf,
    /// Least time between two entries of one pass.
    interval: Duration,
    saved: Cell<Instant>,
    /// Entries that an earlier, killed decomposition left.
    resumed: bool,
}

impl FileJournal {
    /// The journal in `folder`, which exists; what stands there is taken up where `resumed`.
    pub fn new(folder: &Path, interval: Duration, resumed: bool) -> Self {
        Self { folder: folder.to_owned(), interval, saved: Cell::new(Instant::now()), resumed }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.join(format!("{}.sum", name.replace(' ', "-")))
    }
}

impl Journal for FileJournal {
    fn load(&self, name: &str) -> io::Result<Option<Vec<u8>>> {
        if !self.resumed {
            return Ok(None);
        }
        let path = self.path(name);
        let mut bytes = match fs::read(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            read => read.map_err(failed("read", &path))?,
        };
        let Some((entry, crc)) = bytes.split_last_chunk() else { return Err(damaged(&path)) };
        if crc32c::crc32c(entry) != u32::from_le_bytes(*crc) {
            return Err(damaged(&path));
        }
        bytes.truncate(bytes.len() - 4);
        Ok(Some(bytes))
    }

    fn save(&self, name: &str, entry: &[u8]) -> io::Result<()> {
        let path = self.path(name);
        let bytes = [entry, &crc32c::crc32c(entry).to_le_bytes()].concat();
        atomic::write(&path, &bytes).map_err(failed("write", &path))?;
        self.saved.set(Instant::now());
        Ok(())
    }

    fn is_due(&self) -> bool {
        self.saved.get().elapsed() >= self.interval
    }
}

fn failed<'a>(action: &'static str, path: &'a Path) -> impl Fn(io::Error) -> io::Error + 'a {
    move |source| io::Error::other(FormatError::io(action, path)(source))
}

fn damaged(path: &Path) -> io::Error {
    io::Error::other(format!(
        "{} is damaged: its checksum does not fit\n  help: begin again with --force",
        path.display()
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_entry_is_whole_or_an_error() -> io::Result<()> {
        let folder = tempfile::tempdir()?;
        let journal = FileJournal::new(folder.path(), Duration::ZERO, true);
        assert_eq!(journal.load("1-correlation")?, None);
        journal.save("1-correlation", b"what is known")?;
        journal.save("1-correlation", b"what is known by now")?;
        assert_eq!(journal.load("1-correlation")?, Some(b"what is known by now".to_vec()));
        let path = journal.path("1-correlation");
        let whole = fs::read(&path)?;
        for length in 0..whole.len() {
            fs::write(&path, &whole[..length])?;
            let error = journal.load("1-correlation").expect_err("it is cut short");
            assert!(error.to_string().contains("1-correlation.sum"), "{error}");
        }
        Ok(())
    }

    #[test]
    fn a_new_run_does_not_see_what_was_left() -> io::Result<()> {
        let folder = tempfile::tempdir()?;
        FileJournal::new(folder.path(), Duration::ZERO, true).save("a", b"old")?;
        assert_eq!(FileJournal::new(folder.path(), Duration::ZERO, false).load("a")?, None);
        Ok(())
    }
}
