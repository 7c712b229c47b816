use super::NpzWriter;
use super::crc32::crc32;
use super::pieces::Pieces;
use super::records::{LIMIT, Member, local_header};
use crate::format::FormatError;
use crate::format::atomic::AtomicFile;
use crate::format::npy;
use crate::format::positioned::{by_rows, write_all_at};
use faer::MatRef;
use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Arrays at the beginning of an NPZ archive that are written by rows, in any order, by several threads
/// and processes, each row once: their places follow from their shapes.
///
/// Every process opens the same archive and writes rows of its own. What they know of the checksums
/// is told to one of them, which [completes](Self::complete) the arrays and goes on behind them.
///
/// ```
/// use faer::mat;
/// use lumley::format::npz::{NpzReader, NpzRows};
/// let folder = tempfile::tempdir()?;
/// let (partial, path) = (folder.path().join("pod.npz.partial"), folder.path().join("pod.npz"));
/// let arrays = [("modes", &[3, 2][..]), ("mean", &[3])];
/// let (here, elsewhere) = (NpzRows::open(&partial, &arrays)?, NpzRows::open(&partial, &arrays)?);
/// elsewhere.write("modes", 2..3, mat![[5.0, 6.0]].as_ref())?;
/// here.write("modes", 0..2, mat![[1.0, 2.0], [3.0, 4.0]].as_ref())?;
/// here.write("mean", 0..3, mat![[0.1], [0.2], [0.3]].as_ref())?;
/// here.add_checksums(&elsewhere.checksums());
/// let mut npz = here.complete(&path)?;
/// npz.vector("times", &[0.0, 0.5])?;
/// npz.finish()?;
/// let npz = NpzReader::open(&path)?;
/// assert_eq!(npz.read("modes")?, mat![[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]);
/// assert_eq!(npz.vector("mean")?, [0.1, 0.2, 0.3]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct NpzRows {
    path: PathBuf,
    file: File,
    arrays: Vec<Array>,
    /// Where the last array ends.
    end: u64,
    /// Sizes and places from here on are written as ZIP64.
    limit: u64,
}

#[derive(Debug)]
struct Array {
    name: String,
    rows: usize,
    /// Bytes of a row.
    width: usize,
    member: Member,
    /// What stands before the numbers in the member.
    header: Vec<u8>,
    /// Where the numbers begin in the archive.
    data: u64,
    pieces: Mutex<Pieces>,
}

impl NpzRows {
    /// Makes the unfinished archive `path`, or opens the one that another process made, for arrays of
    /// these names and shapes, in C order.
    ///
    /// # Errors
    /// [`FormatError::Io`].
    pub fn open(path: &Path, arrays: &[(&str, &[usize])]) -> Result<Self, FormatError> {
        Self::with_limit(path, arrays, LIMIT)
    }

    fn with_limit(
        path: &Path,
        arrays: &[(&str, &[usize])],
        limit: u64,
    ) -> Result<Self, FormatError> {
        // Not truncated: another process may have written its rows.
        let file = File::options().write(true).create(true).truncate(false).open(path);
        let file = file.map_err(FormatError::io("create", path))?;
        let mut end = 0;
        let mut place = |&(name, shape): &(&str, &[usize])| {
            let array = Array::at(end, name, shape, limit);
            end = array.data + array.numbers();
            array
        };
        let arrays = arrays.iter().map(&mut place).collect();
        Ok(Self { path: path.to_owned(), file, arrays, end, limit })
    }

    /// Writes `rows` of the array `name`.
    ///
    /// # Errors
    /// [`FormatError::Io`]; the archive must then be given up.
    ///
    /// # Panics
    /// If there is no such array, or `x` is not of the shape of these rows of it.
    pub fn write(
        &self,
        name: &str,
        rows: Range<usize>,
        x: MatRef<'_, f64>,
    ) -> Result<(), FormatError> {
        let array = self.arrays.iter().find(|array| array.name == name).expect("a known name");
        assert_eq!((x.nrows(), 8 * x.ncols()), (rows.len(), array.width), "rows of the array");
        assert!(rows.end <= array.rows, "rows of the array");
        for (first, bytes) in by_rows(x) {
            let place = (rows.start + first) as u64 * array.width as u64;
            write_all_at(&self.file, &bytes, array.data + place)
                .map_err(FormatError::io("write", &self.path))?;
            let crc = crc32(0, &bytes);
            array.pieces().add(place, bytes.len() as u64, crc);
        }
        Ok(())
    }

    /// Brings the rows that this process wrote to the disk.
    ///
    /// # Errors
    /// [`FormatError::Io`].
    pub fn sync(&self) -> Result<(), FormatError> {
        self.file.sync_all().map_err(FormatError::io("write", &self.path))
    }

    /// The checksums of the rows that this process wrote, a message for the one that completes.
    pub fn checksums(&self) -> Vec<u8> {
        let message = |array: &Array| {
            let told = array.pieces().to_bytes();
            [&(told.len() as u64).to_le_bytes(), &told[..]].concat()
        };
        self.arrays.iter().flat_map(message).collect()
    }

    /// Takes the rows into account that another process wrote, from its [`checksums`](Self::checksums).
    ///
    /// # Panics
    /// If this is no such message of an archive of the same arrays.
    pub fn add_checksums(&self, mut message: &[u8]) {
        for array in &self.arrays {
            let (length, rest) = message.split_first_chunk().expect("a whole message");
            let length = usize::try_from(u64::from_le_bytes(*length)).expect("a whole message");
            let (told, rest) = rest.split_at(length);
            array.pieces().add_told(told);
            message = rest;
        }
    }

    /// Completes the arrays, all rows of which were written and synced, and goes on behind them: what
    /// the writer finishes is the archive `target`.
    ///
    /// # Errors
    /// [`FormatError::Io`], and [`FormatError::NotShared`] where rows of other processes are missing.
    ///
    /// # Panics
    /// If a row was not written, or twice.
    pub fn complete(self, target: &Path) -> Result<NpzWriter, FormatError> {
        let Self { path, file, arrays, end, limit } = self;
        drop(file);
        let failed = FormatError::io("write", &path);
        let mut file = AtomicFile::adopt(&path, target).map_err(&failed)?;
        // It may be longer: the end of an archive that was left unfinished.
        let found = file.file().metadata().map_err(&failed)?.len();
        if found < end {
            return Err(FormatError::NotShared { path: path.clone(), found, expected: end });
        }
        let write_headers = || -> io::Result<Vec<Member>> {
            file.file().set_len(end)?;
            let members = arrays.into_iter().map(|array| array.complete(&mut file, limit));
            let members = members.collect::<io::Result<_>>()?;
            file.seek(SeekFrom::Start(end))?;
            Ok(members)
        };
        let members = write_headers().map_err(&failed)?;
        Ok(NpzWriter::behind(members, file, target, limit))
    }
}

impl Array {
    /// The array that begins at `local` in the archive.
    fn at(local: u64, name: &str, shape: &[usize], limit: u64) -> Self {
        let header = npy::header(shape, false);
        let (rows, row) = shape.split_first().expect("at least one axis");
        let width = 8 * row.iter().product::<usize>();
        let size = header.len() as u64 + *rows as u64 * width as u64;
        let member = Member { name: format!("{name}.npy"), crc: 0, size, local };
        let data = local + (local_header(&member, limit).len() + header.len()) as u64;
        let (name, pieces) = (name.to_owned(), Mutex::default());
        Self { name, rows: *rows, width, member, header, data, pieces }
    }

    /// Bytes of the numbers.
    fn numbers(&self) -> u64 {
        self.rows as u64 * self.width as u64
    }

    fn pieces(&self) -> MutexGuard<'_, Pieces> {
        self.pieces.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Writes the headers, now that the checksum is known.
    fn complete(self, file: &mut AtomicFile, limit: u64) -> io::Result<Member> {
        let crc = self.pieces().whole(crc32(0, &self.header), self.numbers());
        let member = Member { crc, ..self.member };
        file.seek(SeekFrom::Start(member.local))?;
        file.write_all(&local_header(&member, limit))?;
        file.write_all(&self.header)?;
        Ok(member)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::npz::NpzReader;
    use crate::format::npz::directory::{END64, LOCATOR64};
    use faer::Mat;

    type Outcome = Result<(), Box<dyn std::error::Error>>;

    /// As beyond 4 GiB, without writing 4 GiB: every size and place as ZIP64.
    #[test]
    fn zip64_is_read_back() -> Outcome {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("large.npz");
        let rows = NpzRows::with_limit(&folder.path().join("a"), &[("x", &[4, 2])], 0)?;
        let x = Mat::from_fn(4, 2, |i, j| (2 * i + j) as f64);
        rows.write("x", 0..4, x.as_ref())?;
        let mut npz = rows.complete(&path)?;
        npz.vector("b", &[3.0])?;
        npz.finish()?;
        let bytes = std::fs::read(&path)?;
        for mark in [END64, LOCATOR64] {
            assert!(bytes.windows(4).any(|found| found == mark.to_le_bytes()));
        }
        let npz = NpzReader::open(&path)?;
        assert_eq!((npz.read("x")?, npz.vector("b")?), (x, vec![3.0]));
        Ok(())
    }

    /// Behind an array of 2^33 bytes, a hole in the file but for its last row, all places are ZIP64.
    #[cfg(unix)]
    #[test]
    fn places_beyond_4_gib() -> Outcome {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("hole.npz");
        let shapes: [(&str, &[usize]); 2] = [("hole", &[1 << 20, 1 << 10]), ("x", &[2, 1])];
        let rows = NpzRows::open(&folder.path().join("a"), &shapes)?;
        // The checksum of the hole does not matter here: the array behind it is read.
        rows.arrays[0].pieces().add(0, 1 << 33, 0);
        rows.write("x", 0..2, faer::mat![[1.0], [2.0]].as_ref())?;
        rows.complete(&path)?.finish()?;
        assert!(std::fs::metadata(&path)?.len() > 1 << 33);
        let npz = NpzReader::open(&path)?;
        assert_eq!(npz.vector("x")?, [1.0, 2.0]);
        assert_eq!(npz.unchecked("hole")?.shape(), [1 << 20, 1 << 10]);
        Ok(())
    }

    /// What a killed process left may be longer than the new archive.
    #[test]
    fn leftovers_do_not_show() -> Outcome {
        let folder = tempfile::tempdir()?;
        let (partial, path) = (folder.path().join("a"), folder.path().join("x.npz"));
        std::fs::write(&partial, vec![b'?'; 10_000])?;
        let rows = NpzRows::open(&partial, &[("x", &[2])])?;
        rows.write("x", 0..2, faer::mat![[1.0], [2.0]].as_ref())?;
        rows.complete(&path)?.finish()?;
        assert!(std::fs::metadata(&path)?.len() < 500);
        assert_eq!(NpzReader::open(&path)?.vector("x")?, [1.0, 2.0]);
        Ok(())
    }

    /// The rows of the other process went into a file of the same name on another machine.
    #[test]
    fn machines_without_a_shared_file_system_are_told() -> Outcome {
        let folder = tempfile::tempdir()?;
        let here = NpzRows::open(&folder.path().join("here"), &[("x", &[2])])?;
        let there = NpzRows::open(&folder.path().join("there"), &[("x", &[2])])?;
        here.write("x", 0..1, faer::mat![[1.0]].as_ref())?;
        there.write("x", 1..2, faer::mat![[2.0]].as_ref())?;
        here.add_checksums(&there.checksums());
        let error = here.complete(&folder.path().join("x.npz")).expect_err("half is missing");
        assert!(error.to_string().contains("they share"), "{error}");
        assert!(!folder.path().join("x.npz").exists());
        Ok(())
    }
}
