//! NumPy's format of one array: NPY versions 1 to 3.
//!
//! Source: NumPy enhancement proposal 1, "A simple file format for NumPy arrays".

mod block;
mod dtype;
mod header;
mod matrix;
mod snapshots;
mod weights;
mod write;

pub use matrix::{NpyMatrix, read_vector};
pub use snapshots::{NpySnapshots, SnapshotLayout};
pub use weights::NpyWeights;
pub(in crate::format) use write::{FLOATS, INTEGERS, file_size, header, push_columns};
pub use write::{NpyWriter, write_matrix, write_vector};
