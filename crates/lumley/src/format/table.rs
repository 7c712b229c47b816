//! Tables as text that grow row by row while a run goes on, and can be cut back to where a checkpoint was.

use super::FormatError;
use std::fs::File;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// A table of numbers, separated by commas, that grows.
///
/// Rows go to the system in blocks or with [`flush`](Self::flush), to the disk with [`sync`](Self::sync).
/// Numbers are written so that they are read back bit for bit.
///
/// ```
/// use lumley::format::{csv, table::GrowingTable};
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("loads.csv");
/// let mut table = GrowingTable::create(&path, &["time".into(), "fx".into()])?;
/// table.row(&[0.1, 2.5])?;
/// let checkpoint = table.length();
/// table.row(&[0.2, 2.6])?;
/// table.sync()?;
///
/// let mut table = GrowingTable::resume(&path, checkpoint)?;
/// table.row(&[0.2, 2.7])?;
/// table.flush()?;
/// let columns = csv::read_columns(&path, |_| true)?;
/// assert_eq!(columns[1], ("fx".to_string(), vec![2.5, 2.7]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct GrowingTable {
    path: PathBuf,
    out: BufWriter<File>,
    length: u64,
    line: Vec<u8>,
}

impl GrowingTable {
    /// Begins the table `path`, in the place of an older one, with a column for each header.
    ///
    /// # Errors
    /// [`FormatError::Io`].
    ///
    /// # Panics
    /// If a header holds a comma, a quote or a line break.
    pub fn create(path: &Path, headers: &[String]) -> Result<Self, FormatError> {
        let plain = |header: &String| !header.contains([',', '"', '\n', '\r']);
        assert!(headers.iter().all(plain), "headers without separators");
        let file = File::create(path).map_err(FormatError::io("create", path))?;
        let mut table = Self::on(path, file, 0);
        writeln!(table.line, "{}", headers.join(",")).expect("memory takes what it is given");
        table.write_line()?;
        Ok(table)
    }

    /// Goes on with the table `path` after its first `length` bytes.
    ///
    /// # Errors
    /// [`FormatError::Io`]; a table that is shorter is one.
    pub fn resume(path: &Path, length: u64) -> Result<Self, FormatError> {
        let open = || -> io::Result<File> {
            let mut file = File::options().write(true).open(path)?;
            if file.metadata()?.len() < length {
                return Err(io::ErrorKind::UnexpectedEof.into());
            }
            file.set_len(length)?;
            file.seek(SeekFrom::End(0))?;
            Ok(file)
        };
        let file = open().map_err(FormatError::io("go on with", path))?;
        Ok(Self::on(path, file, length))
    }

    fn on(path: &Path, file: File, length: u64) -> Self {
        Self { path: path.to_owned(), out: BufWriter::new(file), length, line: Vec::new() }
    }

    /// Appends a row.
    ///
    /// # Errors
    /// [`FormatError::Io`].
    pub fn row(&mut self, values: &[f64]) -> Result<(), FormatError> {
        for (k, value) in values.iter().enumerate() {
            let separator = if k == 0 { "" } else { "," };
            write!(self.line, "{separator}{value}").expect("memory takes what it is given");
        }
        self.line.push(b'\n');
        self.write_line()
    }

    fn write_line(&mut self) -> Result<(), FormatError> {
        let written = self.out.write_all(&self.line);
        self.length += self.line.len() as u64;
        self.line.clear();
        written.map_err(FormatError::io("write", &self.path))
    }

    /// Bytes written so far.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// Hands everything to the system, so that readers see it.
    ///
    /// # Errors
    /// [`FormatError::Io`].
    pub fn flush(&mut self) -> Result<(), FormatError> {
        self.out.flush().map_err(FormatError::io("write", &self.path))
    }

    /// Brings everything to the disk.
    ///
    /// # Errors
    /// [`FormatError::Io`].
    pub fn sync(&mut self) -> Result<(), FormatError> {
        self.flush()?;
        self.out.get_ref().sync_data().map_err(FormatError::io("write", &self.path))
    }
}

#[cfg(test)]
mod tests {
    use super::GrowingTable;
    use crate::format::csv::read_columns;

    type Outcome = Result<(), Box<dyn std::error::Error>>;

    #[test]
    fn numbers_are_read_back_bit_for_bit() -> Outcome {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("t.csv");
        let numbers = [0.1 + 0.2, -0.0, f64::MIN_POSITIVE, 1e300, std::f64::consts::PI];
        let mut table = GrowingTable::create(&path, &["x".into()])?;
        numbers.iter().try_for_each(|x| table.row(&[*x]))?;
        table.flush()?;
        let bits = |x: &f64| x.to_bits();
        let found: Vec<u64> = read_columns(&path, |_| true)?[0].1.iter().map(bits).collect();
        assert_eq!(found, numbers.iter().map(bits).collect::<Vec<_>>());
        Ok(())
    }

    #[test]
    fn a_table_that_was_cut_short_is_not_gone_on_with() -> Outcome {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("t.csv");
        std::fs::write(&path, "time\n")?;
        assert!(GrowingTable::resume(&path, 99).is_err());
        assert!(GrowingTable::resume(&folder.path().join("none.csv"), 0).is_err());
        Ok(())
    }
}
