use crate::format::FormatError;
use crate::format::atomic::AtomicFile;
use faer::MatRef;
use std::io::{self, Write};
use std::path::Path;

/// NumPy's names of the types that are written, both of eight bytes.
pub(in crate::format) const FLOATS: &str = "<f8";
pub(in crate::format) const INTEGERS: &str = "<i8";

/// Writes an array of `f64` in NPY format as its numbers come, the first index fastest (Fortran order).
///
/// ```
/// use lumley::format::npy::NpyWriter;
/// let mut npy = NpyWriter::new(Vec::new(), &[2, 3])?;
/// npy.push(&[1.0, 2.0])?; // the first column
/// npy.push(&[3.0, 4.0, 5.0, 6.0])?;
/// assert_eq!(npy.finish().len(), 128 + 6 * 8);
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug)]
pub struct NpyWriter<W: Write> {
    out: W,
    missing: usize,
}

impl<W: Write> NpyWriter<W> {
    /// Begins an array of this shape.
    ///
    /// # Errors
    /// The failure of `out`.
    pub fn new(out: W, shape: &[usize]) -> io::Result<Self> {
        Self::of(out, FLOATS, shape)
    }

    /// Begins an array of numbers of this type, of eight bytes.
    pub(in crate::format) fn of(mut out: W, descr: &str, shape: &[usize]) -> io::Result<Self> {
        out.write_all(&header_of(descr, shape, shape.len() > 1))?;
        Ok(Self { out, missing: shape.iter().product() })
    }

    /// Appends numbers.
    ///
    /// # Errors
    /// The failure of `out`.
    ///
    /// # Panics
    /// If these are more numbers than the shape has places.
    pub fn push(&mut self, values: &[f64]) -> io::Result<()> {
        values.chunks(4096).try_for_each(|part| {
            let bytes: Vec<u8> = part.iter().flat_map(|value| value.to_le_bytes()).collect();
            self.push_encoded(&bytes)
        })
    }

    /// Appends whole numbers to an array of them.
    pub(in crate::format) fn push_integers(
        &mut self,
        values: impl Iterator<Item = i64>,
    ) -> io::Result<()> {
        self.push_encoded(&values.flat_map(i64::to_le_bytes).collect::<Vec<u8>>())
    }

    fn push_encoded(&mut self, bytes: &[u8]) -> io::Result<()> {
        let numbers = bytes.len() / 8;
        assert!(numbers <= self.missing, "no more numbers than places");
        self.missing -= numbers;
        self.out.write_all(bytes)
    }

    /// Ends the array.
    ///
    /// # Panics
    /// If numbers are missing.
    pub fn finish(self) -> W {
        assert_eq!(self.missing, 0, "a number for each place");
        self.out
    }
}

/// Writes a matrix as an NPY file.
///
/// # Errors
/// [`FormatError::Io`]; an older file then stands as it was.
pub fn write_matrix(path: impl AsRef<Path>, x: MatRef<'_, f64>) -> Result<(), FormatError> {
    write_file(path.as_ref(), &[x.nrows(), x.ncols()], |npy| push_columns(npy, x))
}

/// Writes a vector as an NPY file.
///
/// # Errors
/// [`FormatError::Io`]; an older file then stands as it was.
pub fn write_vector(path: impl AsRef<Path>, x: &[f64]) -> Result<(), FormatError> {
    write_file(path.as_ref(), &[x.len()], |npy| npy.push(x))
}

fn write_file(
    path: &Path,
    shape: &[usize],
    push: impl FnOnce(&mut NpyWriter<AtomicFile>) -> io::Result<()>,
) -> Result<(), FormatError> {
    let write = || -> io::Result<()> {
        let mut npy = NpyWriter::new(AtomicFile::create(path)?, shape)?;
        push(&mut npy)?;
        npy.finish().commit()
    };
    write().map_err(FormatError::io("write", path))
}

/// Appends the columns of `x`, one after the other.
pub(in crate::format) fn push_columns(
    npy: &mut NpyWriter<impl Write>,
    x: MatRef<'_, f64>,
) -> io::Result<()> {
    (0..x.ncols()).try_for_each(|j| match x.col(j).try_as_col_major() {
        Some(column) => npy.push(column.as_slice()),
        None => npy.push(&x.col(j).iter().copied().collect::<Vec<f64>>()),
    })
}

/// Bytes of an NPY file of this shape.
pub(in crate::format) fn file_size(shape: &[usize]) -> u64 {
    header(shape, shape.len() > 1).len() as u64 + 8 * shape.iter().product::<usize>() as u64
}

/// The header, version 1.0, padded as NumPy does so that the numbers are aligned to 64 bytes.
pub(in crate::format) fn header(shape: &[usize], fortran_order: bool) -> Vec<u8> {
    header_of(FLOATS, shape, fortran_order)
}

fn header_of(descr: &str, shape: &[usize], fortran_order: bool) -> Vec<u8> {
    let axes: Vec<String> = shape.iter().map(|axis| format!("{axis},")).collect();
    let order = if fortran_order { "True" } else { "False" };
    let text = format!(
        "{{'descr': '{descr}', 'fortran_order': {order}, 'shape': ({}), }}",
        axes.join(" ")
    );
    let total = (10 + text.len() + 1).next_multiple_of(64);
    let length = u16::try_from(total - 10).expect("an array of few axes");
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(length.to_le_bytes());
    bytes.extend(text.bytes());
    bytes.resize(total - 1, b' ');
    bytes.push(b'\n');
    bytes
}
