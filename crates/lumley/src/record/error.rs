use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Why a record could not be written or read.
///
/// ```
/// use lumley::record::{Record, RecordError};
/// let error = Record::open("no/such/record").expect_err("there is none");
/// assert!(matches!(error, RecordError::NotARecord { .. }));
/// ```
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// The system refused.
    #[error("cannot {action} {}: {source}\n  help: check permissions and free space; the {committed} snapshots recorded before are safe", path.display())]
    Write {
        /// What was tried.
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// Snapshots that are safely on disk.
        committed: usize,
        /// The system's answer.
        source: io::Error,
    },
    /// The system refused.
    #[error("cannot {action} {}: {source}\n  help: check the path and its permissions", path.display())]
    Read {
        /// What was tried.
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// The system's answer.
        source: io::Error,
    },
    /// There is something where the record should go.
    #[error("{}: exists already and is not empty\n  help: name another directory", path.display())]
    Exists {
        /// The directory.
        path: PathBuf,
    },
    /// There is no record.
    #[error("{}: no record of snapshots (zarr.json is missing)\n  help: name the directory that a run calls `record`", path.display())]
    NotARecord {
        /// The directory.
        path: PathBuf,
    },
    /// A description is not JSON, or not of the form that lumley writes.
    #[error("{}: line {line}, column {column}: {message}\n  help: the file was changed or damaged; record again or restore a copy", path.display())]
    Json {
        /// The file.
        path: PathBuf,
        /// The line, counted from 1.
        line: usize,
        /// The column, counted from 1.
        column: usize,
        /// What is wrong.
        message: String,
    },
    /// An entry of a description has a value that cannot be.
    #[error("{}: {key} is {value}, expected {expected}\n  help: a record holds what its description says; correct one of them", path.display())]
    Invalid {
        /// The file, or the record that is to be made.
        path: PathBuf,
        /// The entry.
        key: String,
        /// Its value.
        value: String,
        /// What was expected.
        expected: String,
    },
    /// The description does not have the checksum that stands beside it.
    #[error("{}: CRC-32C {computed}, the file says {stored:?}\n  help: the file was changed or damaged; restore a copy", path.display())]
    MetadataChecksum {
        /// The file.
        path: PathBuf,
        /// The checksum kept, in hexadecimal.
        stored: String,
        /// The checksum of what stands there.
        computed: String,
    },
    /// A record of another version of the format.
    #[error("{}: record format {found}, this program reads {supported}\n  help: use the version of lumley that wrote it", path.display())]
    Version {
        /// The file.
        path: PathBuf,
        /// The version it has.
        found: u64,
        /// The version that is read.
        supported: u32,
    },
    /// A block is not as it was written.
    #[error(transparent)]
    DamagedBlock(#[from] Box<DamagedBlock>),
    /// A number to be recorded is not finite.
    #[error(
        "snapshot {snapshot} at {time} s: {array} has {value} at index {index}; it was not recorded\n  help: the computation diverged before; look at smaller time steps"
    )]
    NonFinite {
        /// The frame or series.
        array: String,
        /// The snapshot, counted from 0.
        snapshot: usize,
        /// Its time, in s.
        time: f64,
        /// The place in it, counted from 0.
        index: usize,
        /// The number.
        value: f64,
    },
    /// Times do not increase.
    #[error(
        "snapshot {snapshot}: time {time} s does not come after {previous} s\n  help: record at finite, strictly increasing times"
    )]
    TimeOrder {
        /// The snapshot, counted from 0.
        snapshot: usize,
        /// Its time, in s.
        time: f64,
        /// The time before, in s.
        previous: f64,
    },
    /// A snapshot has not the parts that the record was made for.
    #[error(
        "snapshot {snapshot}: {found} numbers for {array}, expected {expected}\n  help: record what the description of the record says"
    )]
    Shape {
        /// The snapshot, counted from 0.
        snapshot: usize,
        /// The frame or series, or `frames`, `series` where their number is wrong.
        array: String,
        /// Numbers given.
        found: usize,
        /// Numbers expected.
        expected: usize,
    },
    /// There are not so many snapshots.
    #[error(
        "cannot go back to {count} snapshots: there are {len}\n  help: name a number up to {len}"
    )]
    TooFew {
        /// Snapshots asked for.
        count: usize,
        /// Snapshots there.
        len: usize,
    },
    /// There is no frame or series of this name.
    #[error("no {what} {name} in this record; it has {}\n  help: name one of these", available.join(", "))]
    NoSuch {
        /// `frame` or `series`.
        what: &'static str,
        /// The name asked for.
        name: String,
        /// The names there are.
        available: Vec<String>,
    },
}

/// A block that is not as it was written, and what it covers.
///
/// ```
/// use lumley::record::{Damage, DamagedBlock};
/// let block = DamagedBlock {
///     path: "record/frames/fixed/values/c/0/1".into(),
///     array: "frames/fixed/values".into(),
///     axes: ["snapshots", "rows"],
///     first: 0..256,
///     second: 512..1024,
///     damage: Damage::Missing,
/// };
/// assert!(block.to_string().contains("snapshots 0..256, rows 512..1024"));
/// ```
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}: damaged block of {array}: {damage}; it covers {} {first:?}, {} {second:?}\n  help: restore the file from a copy, or run again", path.display(), axes[0], axes[1])]
pub struct DamagedBlock {
    /// The file.
    pub path: PathBuf,
    /// The array, for example `frames/fixed/values`.
    pub array: String,
    /// What its axes count, for example snapshots and rows.
    pub axes: [&'static str; 2],
    /// What the block covers along the first axis.
    pub first: Range<usize>,
    /// What the block covers along the second axis.
    pub second: Range<usize>,
    /// What is wrong with it.
    pub damage: Damage,
}

/// What is wrong with a block.
///
/// ```
/// use lumley::record::Damage;
/// assert_eq!(Damage::Length { found: 7, expected: 12 }.to_string(), "7 bytes, expected 12");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Damage {
    /// There is no such file.
    #[error("the file is missing")]
    Missing,
    /// The file has not the length that all blocks have.
    #[error("{found} bytes, expected {expected}")]
    Length {
        /// Bytes there are.
        found: u64,
        /// Bytes there should be.
        expected: u64,
    },
    /// The bytes do not have the checksum that stands behind them.
    #[error("CRC-32C {computed:08x}, the file says {stored:08x}")]
    Checksum {
        /// The checksum kept.
        stored: u32,
        /// The checksum of the bytes.
        computed: u32,
    },
}

impl RecordError {
    /// For `map_err`: the system refused to `action` the file `path`.
    pub(super) fn read<'a>(
        action: &'static str,
        path: &'a Path,
    ) -> impl Fn(io::Error) -> Self + 'a {
        move |source| Self::Read { action, path: path.to_owned(), source }
    }

    /// For `map_err`: the description `path` is not as it should be.
    pub(super) fn json(path: &Path) -> impl Fn(serde_json::Error) -> Self + '_ {
        |source| {
            let (line, column, text) = (source.line(), source.column(), source.to_string());
            let place = format!(" at line {line} column {column}");
            let message = printable(text.strip_suffix(&place).unwrap_or(&text));
            Self::Json { path: path.to_owned(), line, column, message }
        }
    }
}

/// The beginning of a text from a file, fit for a message: keys and names may be long, or made to play
/// tricks on a terminal.
pub(super) fn printable(text: &str) -> String {
    let shown: String = text.chars().take(120).collect();
    let ellipsis = if shown.len() < text.len() { "..." } else { "" };
    let visible = shown.replace(|c: char| c.is_control(), "\u{fffd}");
    format!("{visible}{ellipsis}")
}
