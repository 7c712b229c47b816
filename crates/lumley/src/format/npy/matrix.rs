use super::header::Header;
use crate::format::FormatError;
use crate::format::region::Region;
use faer::{Mat, MatMut};
use std::ops::Range;
use std::path::Path;

/// Bytes that are read at a time.
const BUFFER: usize = 1 << 20;

/// Bytes that are rather read and thrown away than jumped over by another system call.
const GAP: usize = 1 << 14;

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
            self.read_lines(cols, rows, self.rows, out.transpose_mut())
        } else {
            self.read_lines(rows, cols, self.cols, out)
        }
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

    /// Row, column and value of the first number, in the order of the file, that is not finite.
    ///
    /// # Errors
    /// [`FormatError::Io`].
    pub fn first_non_finite(&self) -> Result<Option<(usize, usize, f64)>, FormatError> {
        let total = self.rows * self.cols;
        for first in (0..total).step_by(BUFFER / 8) {
            let mut values = vec![0.0; (total - first).min(BUFFER / 8)];
            self.read_span(first, &mut Vec::new(), &mut values)?;
            if let Some(k) = values.iter().position(|value| !value.is_finite()) {
                let (place, value) = (first + k, values[k]);
                return Ok(Some(if self.header.fortran_order {
                    (place % self.rows, place / self.rows, value)
                } else {
                    (place / self.cols, place % self.cols, value)
                }));
            }
        }
        Ok(None)
    }

    /// Reads `entries` of `lines`: a line is what is contiguous in the file, of length `stride`.
    fn read_lines(
        &self,
        lines: Range<usize>,
        entries: Range<usize>,
        stride: usize,
        mut out: MatMut<'_, f64>,
    ) -> Result<(), FormatError> {
        let size = self.header.dtype.size();
        let at_once = match (stride - entries.len()) * size {
            gap if gap > GAP => 1,
            _ => (BUFFER / (stride * size)).max(1),
        };
        let (mut bytes, mut values) = (Vec::new(), Vec::new());
        for first in lines.clone().step_by(at_once) {
            let count = at_once.min(lines.end - first);
            values.resize((count - 1) * stride + entries.len(), 0.0);
            self.read_span(first * stride + entries.start, &mut bytes, &mut values)?;
            for k in 0..count {
                let line = &values[k * stride..][..entries.len()];
                let target = out.as_mut().row_mut(first - lines.start + k);
                target.iter_mut().zip(line).for_each(|(out, value)| *out = *value);
            }
        }
        Ok(())
    }

    /// Fills `values` with the numbers that stand in the file from number `first` on.
    fn read_span(
        &self,
        first: usize,
        bytes: &mut Vec<u8>,
        values: &mut [f64],
    ) -> Result<(), FormatError> {
        let size = self.header.dtype.size();
        bytes.resize(values.len() * size, 0);
        self.file.read(self.header.data + (first * size) as u64, bytes)?;
        self.header.dtype.decode(bytes, values);
        Ok(())
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
        if self.rows != 1 && self.cols != 1 {
            return Err(FormatError::Shape {
                path: self.path().to_owned(),
                shape: self.shape().to_vec(),
                expected: "a vector",
            });
        }
        let mut values = vec![0.0; self.rows * self.cols];
        self.read_span(0, &mut Vec::new(), &mut values)?;
        Ok(values)
    }
}
