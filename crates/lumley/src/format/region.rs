use super::FormatError;
use super::positioned::read_exact_at;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A file, or the part of it that one member of an archive takes, read at any place by any thread.
#[derive(Debug, Clone)]
pub(super) struct Region {
    file: Arc<File>,
    path: PathBuf,
    start: u64,
    len: u64,
}

impl Region {
    /// The whole of the regular file `path`.
    pub fn open(path: &Path) -> Result<Self, FormatError> {
        // Before opening: to open a pipe may wait for ever.
        let kind = std::fs::metadata(path).map_err(FormatError::io("open", path))?;
        if !kind.is_file() {
            return Err(FormatError::NotAFile { path: path.to_owned() });
        }
        let file = File::open(path).map_err(FormatError::io("open", path))?;
        let len = file.metadata().map_err(FormatError::io("open", path))?.len();
        Ok(Self { file: Arc::new(file), path: path.to_owned(), start: 0, len })
    }

    /// The `len` bytes from `start` on, which messages will call `name`.
    pub fn part(&self, start: u64, len: u64, name: &str) -> Self {
        let end = start.checked_add(len).expect("a part lies inside");
        assert!(end <= self.len, "a part lies inside");
        let file = Arc::clone(&self.file);
        Self { file, path: self.path.join(name), start: self.start + start, len }
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    pub fn len(&self) -> u64 {
        self.len
    }

    /// Fills `bytes` from `offset` on.
    pub fn read(&self, offset: u64, bytes: &mut [u8]) -> Result<(), FormatError> {
        let end = offset.saturating_add(bytes.len() as u64);
        let read = if end <= self.len {
            read_exact_at(&self.file, bytes, self.start + offset)
        } else {
            Err(io::ErrorKind::UnexpectedEof.into())
        };
        read.map_err(FormatError::io("read", &self.path))
    }
}
