use super::crc32::crc32;
use super::directory::{self, Entry};
use crate::format::FormatError;
use crate::format::error::excerpt;
use crate::format::npy::NpyMatrix;
use crate::format::region::Region;
use faer::Mat;
use std::path::Path;

/// Names that a message lists at most.
const LISTED: usize = 10;

/// Whole numbers below it are exact.
const LARGEST: f64 = 9e15;

/// The named arrays of an NPZ archive.
///
/// ```
/// use lumley::format::npz::{NpzReader, NpzWriter};
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("pod.npz");
/// let mut npz = NpzWriter::create(&path)?;
/// npz.vector("eigenvalues", &[2.0, 1.0])?;
/// npz.finish()?;
/// let npz = NpzReader::open(&path)?;
/// assert_eq!(npz.vector("eigenvalues")?, [2.0, 1.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct NpzReader {
    file: Region,
    entries: Vec<Entry>,
    /// Where the arrays end and the directory begins.
    end: u64,
}

impl NpzReader {
    /// Opens the archive and reads its directory.
    ///
    /// # Errors
    /// [`FormatError`]: not a ZIP archive, truncated, or damaged.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, FormatError> {
        let file = Region::open(path.as_ref())?;
        let (entries, end) = directory::read(&file)?;
        Ok(Self { file, entries, end })
    }

    /// The names of the arrays, without the ending `.npy`.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().filter_map(|entry| entry.name.strip_suffix(".npy"))
    }

    /// The array `name`, to be read by blocks, after its checksum was found right.
    ///
    /// # Errors
    /// [`FormatError`]: no such array, compressed, damaged, or not what [`NpyMatrix`] reads.
    pub fn matrix(&self, name: &str) -> Result<NpyMatrix, FormatError> {
        let (member, crc) = self.member(name)?;
        check(&member, crc)?;
        NpyMatrix::in_region(member, |_| 1)
    }

    /// The array `name`, to be read by blocks; its checksum, which takes a pass over it, is left unread.
    ///
    /// # Errors
    /// As for [`matrix`](Self::matrix).
    pub fn unchecked(&self, name: &str) -> Result<NpyMatrix, FormatError> {
        let (member, _) = self.member(name)?;
        NpyMatrix::in_region(member, |_| 1)
    }

    /// Where the array `name` lies, and its checksum.
    fn member(&self, name: &str) -> Result<(Region, u32), FormatError> {
        let entry = self.entries.iter().find(|e| e.name.strip_suffix(".npy") == Some(name));
        let entry = entry.ok_or_else(|| FormatError::NoSuchArray {
            path: self.file.path().to_owned(),
            name: name.to_owned(),
            available: self.names().take(LISTED).map(|name| excerpt(name.as_bytes())).collect(),
        })?;
        if entry.method != 0 || entry.encrypted || entry.packed != entry.size {
            let path = self.file.path().join(&entry.name);
            return Err(FormatError::Compressed { path, method: entry.method });
        }
        Ok((directory::member(&self.file, entry, self.end)?, entry.crc))
    }

    /// The whole of the matrix `name`.
    ///
    /// # Errors
    /// As for [`matrix`](Self::matrix).
    pub fn read(&self, name: &str) -> Result<Mat<f64>, FormatError> {
        self.matrix(name)?.read()
    }

    /// The whole of the vector `name`.
    ///
    /// # Errors
    /// As for [`matrix`](Self::matrix), and for a matrix that is not a vector.
    pub fn vector(&self, name: &str) -> Result<Vec<f64>, FormatError> {
        self.matrix(name)?.read_as_vector()
    }

    /// The rows of the matrix of whole numbers `name`, such as the nodes of cells.
    ///
    /// # Errors
    /// As for [`matrix`](Self::matrix), and [`FormatError::Shape`] for other than N columns, or numbers that
    /// count nothing.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "checked to be in range"
    )]
    pub fn integers<const N: usize>(&self, name: &str) -> Result<Vec<[usize; N]>, FormatError> {
        let array = self.matrix(name)?;
        let refused = || FormatError::Shape {
            path: array.path().to_owned(),
            shape: array.shape().to_vec(),
            expected: "rows of whole numbers from 0 on, as many in each as a cell or an edge has nodes",
        };
        if array.cols() != N {
            return Err(refused());
        }
        let numbers = array.read()?;
        let whole = |x: f64| (x >= 0.0 && x.fract() == 0.0 && x < LARGEST).then_some(x as usize);
        let row = |i: usize| -> Option<[usize; N]> {
            let mut row = [0; N];
            for (j, n) in row.iter_mut().enumerate() {
                *n = whole(numbers[(i, j)])?;
            }
            Some(row)
        };
        (0..numbers.nrows()).map(|i| row(i).ok_or_else(refused)).collect()
    }
}

fn check(member: &Region, stored: u32) -> Result<(), FormatError> {
    let mut bytes = Vec::new();
    let mut computed = 0;
    for offset in (0..member.len()).step_by(1 << 20) {
        let length = (member.len() - offset).min(1 << 20);
        bytes.resize(usize::try_from(length).expect("at most 1 MiB"), 0);
        member.read(offset, &mut bytes)?;
        computed = crc32(computed, &bytes);
    }
    if computed == stored {
        Ok(())
    } else {
        Err(FormatError::Checksum { path: member.path().to_owned(), stored, computed })
    }
}
