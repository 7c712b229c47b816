//! Reading and writing at a place of a file, by any thread: what the systems call differently; and
//! matrices laid out by rows, the order in which threads and processes can share a file.

use faer::MatRef;
use std::fs::File;
use std::io;

/// Fills `bytes` from `offset` on.
#[cfg(unix)]
pub(crate) fn read_exact_at(file: &File, bytes: &mut [u8], offset: u64) -> io::Result<()> {
    std::os::unix::fs::FileExt::read_exact_at(file, bytes, offset)
}

/// Fills `bytes` from `offset` on.
#[cfg(windows)]
pub(crate) fn read_exact_at(file: &File, mut bytes: &mut [u8], mut offset: u64) -> io::Result<()> {
    while !bytes.is_empty() {
        match std::os::windows::fs::FileExt::seek_read(file, bytes, offset)? {
            0 => return Err(io::ErrorKind::UnexpectedEof.into()),
            n => {
                bytes = &mut bytes[n..];
                offset += n as u64;
            }
        }
    }
    Ok(())
}

/// Writes all of `bytes` from `offset` on.
#[cfg(unix)]
pub(crate) fn write_all_at(file: &File, bytes: &[u8], offset: u64) -> io::Result<()> {
    std::os::unix::fs::FileExt::write_all_at(file, bytes, offset)
}

/// Writes all of `bytes` from `offset` on.
#[cfg(windows)]
pub(crate) fn write_all_at(file: &File, mut bytes: &[u8], mut offset: u64) -> io::Result<()> {
    while !bytes.is_empty() {
        match std::os::windows::fs::FileExt::seek_write(file, bytes, offset)? {
            0 => return Err(io::ErrorKind::WriteZero.into()),
            n => {
                bytes = &bytes[n..];
                offset += n as u64;
            }
        }
    }
    Ok(())
}

/// Bytes that are read or written at a time: they stay in the cache.
const PIECE: usize = 1 << 18;

/// Rows of `cols` numbers that are read or written at a time.
pub(crate) fn rows_at_once(cols: usize) -> usize {
    (PIECE / (8 * cols.max(1))).max(1)
}

/// The bytes of `x` in C order, little-endian, in pieces of whole rows; each with its first row.
pub(crate) fn by_rows(x: MatRef<'_, f64>) -> impl Iterator<Item = (usize, Vec<u8>)> {
    let at_once = rows_at_once(x.ncols());
    (0..x.nrows()).step_by(at_once).map(move |first| {
        let piece = x.subrows(first, at_once.min(x.nrows() - first));
        (first, bytes_by_rows(piece))
    })
}

fn bytes_by_rows(x: MatRef<'_, f64>) -> Vec<u8> {
    let (width, mut bytes) = (8 * x.ncols(), vec![0; 8 * x.nrows() * x.ncols()]);
    for (j, column) in x.col_iter().enumerate() {
        for (row, number) in bytes.chunks_exact_mut(width).zip(column.iter()) {
            row[8 * j..][..8].copy_from_slice(&number.to_le_bytes());
        }
    }
    bytes
}
