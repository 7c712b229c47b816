use super::block::Lines;
use super::header::Header;
use crate::format::FormatError;
use crate::format::region::Region;
use faer::{Mat, MatMut};
use std::ops::Range;
use std::path::Path;

/// A matrix in an NPY file, read by blocks: the file need not fit into memory.
///
/// Floats of 4 and 8 bytes and integers of either byte order and in C or Fortran order are read as `f64`;
/// integers beyond 2⁵³ are rounded. An array of more than two axes (in C order) is taken as the matrix of
/// its first axis by all others, a vector as one column.
///
/// ```
/// use lumley::format::npy::{self, NpyMatrix};
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("x.npy");
/// npy::write_matrix(&path, faer::mat![[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]].as_ref())?;
/// let x = NpyMatrix::open(&path)?;
/// assert_eq!((x.rows(), x.cols(), x.dtype()), (3, 2, "f8"));
/// let mut corner = faer::Mat::zeros(2, 1);
/// x.read_block(1..3, 1..2, corner.as_mut())?;
/// assert_eq!(corner, faer::mat![[4.0], [6.0]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct NpyMatrix {
    file: Region,
    header: Header,
    rows: usize,
    cols: usize,
}

impl NpyMatrix {
    /// The array in the file `path`: its header is read and checked against the length of the file.
    ///
    /// # Errors
    /// [`FormatError`]: not an NPY file, truncated, numbers of a kind that is not read, no numbers, or more
    /// than two axes in Fortran order.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, FormatError> {
        Self::in_region(Region::open(path.as_ref())?, |_| 1)
    }

    /// The array in `file`, whose first `split(number of axes)` axes become the rows.
    pub(in crate::format) fn in_region(
        file: Region,
        split: impl Fn(usize) -> usize,
    ) -> Result<Self, FormatError> {
        let header = Header::read(&file)?;
        if header.fortran_order && header.shape.len() > 2 {
            return Err(FormatError::Shape {
                path: file.path().to_owned(),
                shape: header.shape,
                expected: "C order where there are more than two axes (numpy.ascontiguousarray)",
            });
        }
        // The product of all axes fits: it was checked against the length of the file.
        let (rows, cols) = header.shape.split_at(split(header.shape.len()));
        let (rows, cols) = (rows.iter().product(), cols.iter().product());
        Ok(Self { file, header, rows, cols })
    }

    /// Number of rows: the length of the first axis.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of columns: the product of all other axes.
    pub fn cols(&self) -> usize {
        self.cols
    }

    /// The axes as the file has them.
    pub fn shape(&self) -> &[usize] {
        &self.header.shape
    }

    /// NumPy's name of the type of the numbers, without the byte order: `f8`, `f4`, `i4`, ...
    pub fn dtype(&self) -> &'static str {
        self.header.dtype.name()
    }

    /// Bytes a number.
    pub(super) fn item_size(&self) -> usize {
        self.header.dtype.size()
    }

    /// Whether the file has one column after the other.
    pub(super) fn is_by_columns(&self) -> bool {
        self.header.fortran_order
    }

    /// The file, or archive and member.
    pub fn path(&self) -> &Path {
        self.file.path()
    }

    /// Reads the block of `rows` and `cols` into `out`, which has that shape.
    ///
    /// # Errors
    /// [`FormatError::Io`].
    ///
    /// # Panics
    /// If the block reaches beyond the matrix or `out` has another shape.
    pub fn read_block(
        &self,
        rows: Range<usize>,
        cols: Range<usize>,
        out: MatMut<'_, f64>,
    ) -> Result<(), FormatError> {
        assert!(rows.end <= self.rows && cols.end <= self.cols, "a block inside the matrix");
        assert_eq!((out.nrows(), out.ncols()), (rows.len(), cols.len()), "room for the block");
        if rows.is_empty() || cols.is_empty() {
            Ok(())
        } else if self.header.fortran_order {
            self.lines(self.rows).read(cols, rows, out.transpose_mut())
        } else {
            self.lines(self.cols).read(rows, cols, out)
        }
    }

    fn lines(&self, length: usize) -> Lines<'_> {
        let Header { dtype, data, .. } = self.header;
        Lines { file: &self.file, dtype, start: data, length }
    }

    /// The whole matrix.
    ///
    /// # Errors
    /// [`FormatError::Io`].
    pub fn read(&self) -> Result<Mat<f64>, FormatError> {
        let mut out = Mat::zeros(self.rows, self.cols);
        self.read_block(0..self.rows, 0..self.cols, out.as_mut())?;
        Ok(out)
    }
}

/// Reads a vector: one axis, or two of which one has length 1.
///
/// # Errors
/// [`FormatError`] as for [`NpyMatrix::open`], and for a matrix that is not a vector.
pub fn read_vector(path: impl AsRef<Path>) -> Result<Vec<f64>, FormatError> {
    NpyMatrix::open(path)?.read_as_vector()
}

impl NpyMatrix {
    /// The entries of a matrix of one row or one column.
    ///
    /// # Errors
    /// [`FormatError`]: the matrix is not a vector, or the system refused.
    pub fn read_as_vector(&self) -> Result<Vec<f64>, FormatError> {
        let mut values = vec![0.0; self.vector_length()?];
        self.read_vector_part(0, &mut values)?;
        Ok(values)
    }

    /// Length of a matrix of one row or one column.
    pub(super) fn vector_length(&self) -> Result<usize, FormatError> {
        if self.rows != 1 && self.cols != 1 {
            return Err(FormatError::Shape {
                path: self.path().to_owned(),
                shape: self.shape().to_vec(),
                expected: "a vector",
            });
        }
        Ok(self.rows * self.cols)
    }

    /// Fills `part` with the entries of a matrix of one row or one column from entry `first` on.
    pub(super) fn read_vector_part(
        &self,
        first: usize,
        part: &mut [f64],
    ) -> Result<(), FormatError> {
        let all = first..first + part.len();
        let (rows, cols) = if self.cols == 1 { (all, 0..1) } else { (0..1, all) };
        let out = MatMut::from_column_major_slice_mut(part, rows.len(), cols.len());
        self.read_block(rows, cols, out)
    }
}
