//! How a block of a matrix comes out of a file: some lines of it are read into a buffer that stays in
//! the cache, and decoded from there to their place.

use super::dtype::Dtype;
use crate::format::FormatError;
use crate::format::region::Region;
use faer::MatMut;
use std::ops::Range;

/// Bytes that are read at a time: half of a small second-level cache.
const BUFFER: usize = 1 << 18;

/// Bytes that are rather read and thrown away than jumped over by another system call.
const GAP: usize = 1 << 14;

/// A matrix in a file: a line is what is contiguous there, and the lines follow each other.
pub(super) struct Lines<'a> {
    pub file: &'a Region,
    pub dtype: Dtype,
    /// Where the first line begins, in bytes.
    pub start: u64,
    /// Numbers in a line.
    pub length: usize,
}

impl Lines<'_> {
    /// Reads `entries` of `lines` into `out`, which has a row for each line.
    pub fn read(
        &self,
        lines: Range<usize>,
        entries: Range<usize>,
        mut out: MatMut<'_, f64>,
    ) -> Result<(), FormatError> {
        let size = self.dtype.size();
        let width = (BUFFER / size).min(entries.len());
        let joined = (self.length - entries.len()) * size <= GAP;
        let pitch = if joined { self.length } else { width };
        let height = (BUFFER / (pitch * size)).max(1);
        let mut bytes = Vec::new();
        for (i, lines) in pieces(lines, height) {
            for (j, entries) in pieces(entries.clone(), width) {
                let shape = (lines.len(), entries.len());
                self.fill(&mut bytes, lines.clone(), entries, pitch)?;
                self.place(&bytes, pitch, out.as_mut().submatrix_mut(i, j, shape.0, shape.1));
            }
        }
        Ok(())
    }

    /// Reads lines so that one begins every `pitch` numbers: all at once where they do so in the file.
    fn fill(
        &self,
        bytes: &mut Vec<u8>,
        lines: Range<usize>,
        entries: Range<usize>,
        pitch: usize,
    ) -> Result<(), FormatError> {
        let size = self.dtype.size();
        let place = |line| self.start + ((line * self.length + entries.start) * size) as u64;
        bytes.resize(((lines.len() - 1) * pitch + entries.len()) * size, 0);
        if pitch == self.length {
            return self.file.read(place(lines.start), bytes);
        }
        let mut parts = lines.zip(bytes.chunks_mut(pitch * size));
        parts.try_for_each(|(line, part)| {
            let length = part.len().min(entries.len() * size);
            self.file.read(place(line), &mut part[..length])
        })
    }

    /// Decodes lines in the order of `out`: what is written is contiguous, what is read is in the cache.
    fn place(&self, bytes: &[u8], pitch: usize, out: MatMut<'_, f64>) {
        let size = self.dtype.size();
        if out.col_stride() == 1 {
            for (line, row) in bytes.chunks(pitch * size).zip(out.row_iter_mut()) {
                let row = row.try_as_row_major_mut().expect("its stride is 1").as_slice_mut();
                self.dtype.decode(line, 1, row.iter_mut());
            }
        } else {
            for (j, mut column) in out.col_iter_mut().enumerate() {
                let bytes = &bytes[j * size..];
                match column.as_mut().try_as_col_major_mut() {
                    Some(column) => {
                        self.dtype.decode(bytes, pitch, column.as_slice_mut().iter_mut());
                    }
                    None => self.dtype.decode(bytes, pitch, column.iter_mut()),
                }
            }
        }
    }
}

/// `range` in pieces of at most `size`, and where they begin in it.
fn pieces(range: Range<usize>, size: usize) -> impl Iterator<Item = (usize, Range<usize>)> {
    let Range { start, end } = range;
    (start..end).step_by(size).map(move |first| (first - start, first..(first + size).min(end)))
}
