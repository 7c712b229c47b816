use crate::format::FormatError;
use crate::format::positioned::{by_rows, read_exact_at, rows_at_once, write_all_at};
use faer::{MatMut, MatRef};
use std::fs::File;
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A matrix in a file of its own, written and read by rows, by several threads and processes: what a
/// decomposition needs again before it is done.
#[derive(Debug)]
pub(super) struct Scratch {
    path: PathBuf,
    file: File,
    columns: usize,
}

impl Scratch {
    /// The file `path` with room for the matrix; what stands there stays, as far as it has room.
    pub fn open(path: &Path, rows: usize, columns: usize) -> Result<Self, FormatError> {
        let size = rows as u64 * 8 * columns as u64;
        let open = || -> io::Result<File> {
            let mut options = File::options();
            let file = options.read(true).write(true).create(true).truncate(false).open(path)?;
            if file.metadata()?.len() != size {
                file.set_len(size)?;
            }
            Ok(file)
        };
        let file = open().map_err(FormatError::io("create", path))?;
        Ok(Self { path: path.to_owned(), file, columns })
    }

    /// Writes rows from `first` on.
    ///
    /// # Panics
    /// If they do not have the length of the matrix's.
    pub fn write(&self, first: usize, x: MatRef<'_, f64>) -> Result<(), FormatError> {
        assert_eq!(x.ncols(), self.columns, "whole rows");
        by_rows(x)
            .try_for_each(|(row, bytes)| {
                write_all_at(&self.file, &bytes, self.place_of(first + row))
            })
            .map_err(FormatError::io("write", &self.path))
    }

    /// Reads rows, and of these the first columns, as many as `out` has.
    ///
    /// # Panics
    /// If `out` is of another shape, or the matrix has fewer columns.
    pub fn read(&self, rows: Range<usize>, mut out: MatMut<'_, f64>) -> Result<(), FormatError> {
        assert!(rows.len() == out.nrows() && out.ncols() <= self.columns, "room for the rows");
        let at_once = rows_at_once(self.columns);
        let mut bytes = vec![0; at_once.min(rows.len()) * 8 * self.columns];
        for first in rows.clone().step_by(at_once) {
            let count = at_once.min(rows.end - first);
            let bytes = &mut bytes[..count * 8 * self.columns];
            read_exact_at(&self.file, bytes, self.place_of(first))
                .map_err(FormatError::io("read", &self.path))?;
            self.spread(bytes, out.as_mut().subrows_mut(first - rows.start, count));
        }
        Ok(())
    }

    /// Puts the bytes of rows into columns.
    fn spread(&self, bytes: &[u8], out: MatMut<'_, f64>) {
        let numbers = bytes.as_chunks().0;
        for (j, column) in out.col_iter_mut().enumerate() {
            let read = numbers[j..].iter().step_by(self.columns);
            column.iter_mut().zip(read).for_each(|(to, number)| *to = f64::from_le_bytes(*number));
        }
    }

    /// Brings everything that was written to the disk.
    pub fn sync(&self) -> Result<(), FormatError> {
        self.file.sync_data().map_err(FormatError::io("write", &self.path))
    }

    fn place_of(&self, row: usize) -> u64 {
        row as u64 * 8 * self.columns as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::Mat;

    /// Rows beyond one piece, written in disorder, are read back, also without the last column.
    #[test]
    fn what_is_read_is_what_was_written() -> Result<(), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        let rows = 3 * rows_at_once(3) + 1;
        let x = Mat::from_fn(rows, 3, |i, j| (3 * i + j) as f64);
        let scratch = Scratch::open(&folder.path().join("x"), rows, 3)?;
        scratch.write(5, x.as_ref().subrows(5, rows - 5))?;
        scratch.write(0, x.as_ref().subrows(0, 5))?;
        let mut all = Mat::zeros(rows, 3);
        scratch.read(0..rows, all.as_mut())?;
        assert_eq!(all, x);
        let mut part = Mat::zeros(rows - 7, 2);
        scratch.read(4..rows - 3, part.as_mut())?;
        assert_eq!(part, x.submatrix(4, 0, rows - 7, 2));
        Ok(())
    }

    /// A killed run's rows are there when it goes on; a file of another size is cut or filled up.
    #[test]
    fn rows_outlive_the_process() -> Result<(), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("x");
        Scratch::open(&path, 4, 2)?.write(1, faer::mat![[1.0, 2.0], [3.0, 4.0]].as_ref())?;
        for rows in [4, 3, 4] {
            let scratch = Scratch::open(&path, rows, 2)?;
            assert_eq!(std::fs::metadata(&path)?.len(), 16 * rows as u64);
            let mut found = Mat::zeros(3, 2);
            scratch.read(0..3, found.as_mut())?;
            assert_eq!(found, faer::mat![[0.0, 0.0], [1.0, 2.0], [3.0, 4.0]]);
        }
        Ok(())
    }
}
