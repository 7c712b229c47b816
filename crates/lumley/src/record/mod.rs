//! The record: snapshots of a run on disk, with times, body states, units and provenance.
//!
//! A record is a directory in Zarr v3 format, which other programs read without lumley (in Python:
//! `zarr.open_group(path)`):
//!
//! | path | shape | content |
//! |---|---|---|
//! | `zarr.json` | | format, **number of snapshots M**, frames, series, units, provenance, and a checksum of these |
//! | `time` | M | times, in s |
//! | `series/NAME` | M x k | short vectors, such as generalised positions |
//! | `frames/NAME/values` | M x n | the field: a row is a snapshot, component after component |
//! | `frames/NAME/bounds` | 2 x 2 | lower and upper corner of a uniform grid |
//! | `frames/NAME/nodes` | k x 2 | or the nodes one by one |
//!
//! Arrays are little-endian `float64`, not compressed, in chunks of about 1 MiB with their CRC-32C behind
//! them. M in the record's `zarr.json` commits: chunks and arrays may hold more after a crash, which counts
//! for nothing. `docs/adr/0001-record-store.md` tells why it is so.

mod array;
mod description;
mod error;
mod frame;
mod layout;
mod metadata;
mod reader;
mod writer;

pub use description::{Description, FrameDescription, Quantity, SeriesDescription, Support};
pub use error::{Damage, DamagedBlock, RecordError};
pub use frame::FrameReader;
pub use reader::{Record, Series};
pub use writer::{RecordWriter, Snapshot};
