//! NumPy's format of several named arrays: a ZIP archive of NPY files, not compressed.
//!
//! Source: PKWARE's APPNOTE 6.3.10 (ZIP and ZIP64); `numpy.savez` writes the same.

mod crc32;
mod directory;
mod pieces;
mod read;
mod records;
mod rows;
mod write;

pub use read::NpzReader;
pub use rows::NpzRows;
pub use write::NpzWriter;
