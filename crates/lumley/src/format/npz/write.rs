use super::crc32::crc32;
use super::records::{LIMIT, Member, end, entry, local_header};
use crate::format::FormatError;
use crate::format::atomic::AtomicFile;
use crate::format::npy::{self, NpyWriter};
use faer::MatRef;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// Writes named arrays to an NPZ archive, one after the other and without a copy in memory.
///
/// The archive appears under its name, and in the place of an older one, with [`finish`](Self::finish).
/// Sizes and places beyond 4 GiB are written as ZIP64.
///
/// ```
/// use lumley::format::npz::{NpzReader, NpzWriter};
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("pod.npz");
/// let mut npz = NpzWriter::create(&path)?;
/// npz.matrix("modes", faer::mat![[1.0, 0.0], [0.0, 1.0]].as_ref())?;
/// npz.finish()?;
/// assert_eq!(NpzReader::open(&path)?.names().collect::<Vec<_>>(), ["modes"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct NpzWriter {
    path: PathBuf,
    out: BufWriter<AtomicFile>,
    members: Vec<Member>,
    /// Sizes and places from here on are written as ZIP64.
    limit: u64,
}

impl NpzWriter {
    /// Begins the archive `path`.
    ///
    /// # Errors
    /// [`FormatError::Io`].
    pub fn create(path: impl AsRef<Path>) -> Result<Self, FormatError> {
        Self::with_limit(path.as_ref(), LIMIT)
    }

    fn with_limit(path: &Path, limit: u64) -> Result<Self, FormatError> {
        let file = AtomicFile::create(path).map_err(FormatError::io("create", path))?;
        Ok(Self::behind(Vec::new(), file, path, limit))
    }

    /// Goes on with an archive in which these members stand, and nothing behind them.
    pub(super) fn behind(members: Vec<Member>, file: AtomicFile, path: &Path, limit: u64) -> Self {
        let out = BufWriter::with_capacity(1 << 16, file);
        Self { path: path.to_owned(), out, members, limit }
    }

    /// Writes a matrix, in Fortran order.
    ///
    /// # Errors
    /// [`FormatError::Io`]; the archive must then be given up.
    ///
    /// # Panics
    /// If the name is taken.
    pub fn matrix(&mut self, name: &str, x: MatRef<'_, f64>) -> Result<(), FormatError> {
        let shape = [x.nrows(), x.ncols()];
        self.array(name, npy::FLOATS, &shape, |npy| npy::push_columns(npy, x))
    }

    /// Writes a vector.
    ///
    /// # Errors
    /// [`FormatError::Io`]; the archive must then be given up.
    ///
    /// # Panics
    /// If the name is taken.
    pub fn vector(&mut self, name: &str, x: &[f64]) -> Result<(), FormatError> {
        self.array(name, npy::FLOATS, &[x.len()], |npy| npy.push(x))
    }

    /// Writes rows of whole numbers, such as the nodes of cells: a matrix of integers.
    ///
    /// ```
    /// use lumley::format::npz::{NpzReader, NpzWriter};
    /// # let folder = tempfile::tempdir()?;
    /// # let path = folder.path().join("mesh.npz");
    /// let mut npz = NpzWriter::create(&path)?;
    /// npz.integers("edges", &[[0, 1], [1, 2], [2, 0]])?;
    /// npz.finish()?;
    /// assert_eq!(NpzReader::open(&path)?.integers::<2>("edges")?, [[0, 1], [1, 2], [2, 0]]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`FormatError::Io`]; the archive must then be given up.
    ///
    /// # Panics
    /// If the name is taken, or a number is beyond those of 63 bits.
    pub fn integers<const N: usize>(
        &mut self,
        name: &str,
        rows: &[[usize; N]],
    ) -> Result<(), FormatError> {
        let number = |n: usize| i64::try_from(n).expect("a number of 63 bits");
        self.array(name, npy::INTEGERS, &[rows.len(), N], |npy| {
            (0..N).try_for_each(|j| npy.push_integers(rows.iter().map(|row| number(row[j]))))
        })
    }

    /// Writes an array as its numbers come: `push` gives them all, the first index fastest.
    fn array(
        &mut self,
        name: &str,
        descr: &str,
        shape: &[usize],
        push: impl FnOnce(&mut NpyWriter<&mut Checked<'_>>) -> io::Result<()>,
    ) -> Result<(), FormatError> {
        let name = format!("{name}.npy");
        assert!(self.members.iter().all(|member| member.name != name), "one array of a name");
        let write = || -> io::Result<()> {
            let local = self.out.stream_position()?;
            let member = Member { name, crc: 0, size: npy::file_size(shape), local };
            self.out.write_all(&local_header(&member, self.limit))?;
            let mut checked = Checked { out: &mut self.out, crc: 0 };
            let mut npy = NpyWriter::of(&mut checked, descr, shape)?;
            push(&mut npy)?;
            npy.finish();
            let crc = checked.crc;
            self.out.seek(SeekFrom::Start(local + 14))?;
            self.out.write_all(&crc.to_le_bytes())?;
            self.out.seek(SeekFrom::End(0))?;
            self.members.push(Member { crc, ..member });
            Ok(())
        };
        write().map_err(FormatError::io("write", &self.path))
    }

    /// Writes the directory and gives the archive its name.
    ///
    /// # Errors
    /// [`FormatError::Io`]; an older archive then stands as it was.
    pub fn finish(mut self) -> Result<(), FormatError> {
        let mut write = || -> io::Result<()> {
            let start = self.out.stream_position()?;
            for member in &self.members {
                self.out.write_all(&entry(member, self.limit))?;
            }
            let size = self.out.stream_position()? - start;
            let count = self.members.len() as u64;
            self.out.write_all(&end(count, size, start, self.limit))
        };
        let written = write()
            .and_then(|()| self.out.into_inner().map_err(io::IntoInnerError::into_error)?.commit());
        written.map_err(FormatError::io("write", &self.path))
    }
}

/// Keeps the checksum of what passes through.
#[derive(Debug)]
pub(super) struct Checked<'a> {
    out: &'a mut BufWriter<AtomicFile>,
    crc: u32,
}

impl Write for Checked<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.out.write(bytes)?;
        self.crc = crc32(self.crc, &bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::NpzWriter;
    use crate::format::FormatError;
    use crate::format::npz::NpzReader;
    use crate::format::npz::directory::END64;

    /// Archives beyond 4 GiB, without writing 4 GiB: all sizes and places as ZIP64.
    #[test]
    fn zip64_is_read_back() -> Result<(), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("large.npz");
        let mut npz = NpzWriter::with_limit(&path, 0)?;
        npz.matrix("a", faer::mat![[1.0, 2.0]].as_ref())?;
        npz.vector("b", &[3.0])?;
        npz.finish()?;
        let marks = std::fs::read(&path)?;
        assert!(marks.windows(4).any(|bytes| bytes == END64.to_le_bytes()));
        let npz = NpzReader::open(&path)?;
        assert_eq!(npz.read("a")?, faer::mat![[1.0, 2.0]]);
        assert_eq!(npz.vector("b")?, [3.0]);
        assert!(matches!(npz.matrix("c"), Err(FormatError::NoSuchArray { .. })));
        Ok(())
    }
}
