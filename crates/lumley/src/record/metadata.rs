use super::array::{read_text, write_json};
use super::description::check_parts;
use super::error::printable;
use super::{Description, FrameDescription, Quantity, RecordError, SeriesDescription, Support};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

/// Version of the format on disk.
const FORMAT: u32 = 1;

/// Longest description of a record that is read, in bytes: that of thousands of quantities.
const LIMIT: u64 = 1 << 20;

/// Numbers in a chunk that is written: 1 MiB.
const CHUNK: usize = 1 << 17;

/// Numbers in the largest chunk that is read: 64 MiB.
const LARGEST_CHUNK: usize = 1 << 23;

/// Numbers that a writer gathers before they go to disk, unless 16 snapshots are more: 64 MiB.
const BATCH: usize = 1 << 23;

/// What the record's own zarr.json says, under `attributes.lumley`. It holds no floating-point number: those
/// stand in arrays, bit for bit.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Metadata {
    format: u32,
    /// Snapshots that are wholly on disk. To raise this number is to commit.
    pub snapshots: usize,
    pub chunk_snapshots: usize,
    pub frames: Vec<FrameMetadata>,
    pub series: Vec<SeriesDescription>,
    pub provenance: BTreeMap<String, String>,
}

#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FrameMetadata {
    pub name: String,
    pub length_unit: String,
    pub components: Vec<Quantity>,
    pub support: SupportMetadata,
    pub chunk_rows: usize,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum SupportMetadata {
    /// Nodes in each direction.
    Grid([usize; 2]),
    /// Number of nodes.
    Nodes(usize),
}

impl SupportMetadata {
    fn len(self) -> Option<usize> {
        match self {
            Self::Grid([nx, ny]) => nx.checked_mul(ny),
            Self::Nodes(count) => Some(count),
        }
    }
}

impl FrameMetadata {
    fn new(frame: &FrameDescription, chunk_snapshots: usize) -> Self {
        Self {
            name: frame.name.clone(),
            length_unit: frame.length_unit.clone(),
            components: frame.components.clone(),
            support: match &frame.support {
                Support::Grid(grid) => SupportMetadata::Grid(grid.nodes()),
                Support::Nodes(nodes) => SupportMetadata::Nodes(nodes.len()),
            },
            chunk_rows: frame.rows().min(CHUNK / chunk_snapshots),
        }
    }

    fn checked_rows(&self) -> Option<usize> {
        self.support.len()?.checked_mul(self.components.len()).filter(|rows| *rows > 0)
    }

    /// Length of a snapshot.
    pub fn rows(&self) -> usize {
        self.checked_rows().expect("a frame that was checked")
    }
}

impl Metadata {
    /// An empty record.
    pub fn new(description: &Description) -> Self {
        let rows: usize = description.frames.iter().map(FrameDescription::rows).sum();
        let chunk_snapshots = (BATCH / rows).clamp(16, 256);
        let chunk_snapshots = description.gathered.unwrap_or(usize::MAX).clamp(1, chunk_snapshots);
        let frames = description.frames.iter();
        Self {
            format: FORMAT,
            snapshots: 0,
            chunk_snapshots,
            frames: frames.map(|frame| FrameMetadata::new(frame, chunk_snapshots)).collect(),
            series: description.series.clone(),
            provenance: description.provenance.clone(),
        }
    }

    /// The same record with another number of snapshots.
    pub fn with_snapshots(&self, snapshots: usize) -> Self {
        Self { snapshots, ..self.clone() }
    }

    /// Commits: readers see from now on what this says.
    pub fn write(&self, root: &Path) -> Result<(), (PathBuf, io::Error)> {
        write_group(root, &self.attributes())
    }

    /// Reads what a record says of itself, and checks that it can be.
    pub fn read(root: &Path) -> Result<Self, RecordError> {
        let path = root.join("zarr.json");
        if !path.exists() {
            return Err(RecordError::NotARecord { path: root.to_owned() });
        }
        let text = read_text(&path, LIMIT)?;
        // Of another version nothing else may be as it is in this one.
        let any: Option<AnyVersion> = serde_json::from_str(&text).ok();
        let format = any.map(|any| any.attributes.lumley.format);
        if let Some(found) = format.filter(|format| *format != u64::from(FORMAT)) {
            return Err(RecordError::Version { path, found, supported: FORMAT });
        }
        let Attributes { lumley: metadata, lumley_crc32c: stored } = parse_group(&path, &text)?;
        let computed = metadata.checksum();
        if stored != computed {
            let stored = printable(&stored);
            return Err(RecordError::MetadataChecksum { path, stored, computed });
        }
        metadata.check_parts(&path)?;
        metadata.check_sizes(&path)?;
        Ok(metadata)
    }

    fn attributes(&self) -> Value {
        json!({ "lumley": self, "lumley_crc32c": self.checksum() })
    }

    /// CRC-32C of the entries in their order here, in hexadecimal.
    fn checksum(&self) -> String {
        let text = serde_json::to_vec(self).expect("strings and integers become JSON");
        format!("{:08x}", crc32c::crc32c(&text))
    }

    fn check_parts(&self, path: &Path) -> Result<(), RecordError> {
        let frames = self.frames.iter().map(|frame| (&frame.name, &frame.components));
        let series = self.series.iter().map(|series| (&series.name, &series.entries));
        check_parts(path, "frames", frames)?;
        check_parts(path, "series", series)
    }

    /// Refuses sizes that no record has, before anything is allocated or computed with them.
    fn check_sizes(&self, path: &Path) -> Result<(), RecordError> {
        let invalid = |key: String, value: String| RecordError::Invalid {
            path: path.to_owned(),
            key,
            value,
            expected: format!("chunks of 1 to {LARGEST_CHUNK} numbers, and sizes below 2^64"),
        };
        let fits = |width: usize| {
            let numbers = width.checked_mul(self.chunk_snapshots);
            numbers.is_some_and(|numbers| (1..=LARGEST_CHUNK).contains(&numbers))
        };
        if !fits(1) {
            return Err(invalid("chunk_snapshots".into(), self.chunk_snapshots.to_string()));
        }
        if let Some(series) = self.series.iter().find(|series| !fits(series.entries.len())) {
            let entries = format!("{} entries", series.entries.len());
            return Err(invalid(format!("series {:?}", series.name), entries));
        }
        let wrong = self.frames.iter().find(|f| f.checked_rows().is_none() || !fits(f.chunk_rows));
        wrong.map_or(Ok(()), |frame| {
            let value = format!("{:?} with chunk_rows {}", frame.support, frame.chunk_rows);
            Err(invalid(format!("frame {:?}", frame.name), value))
        })
    }
}

/// The zarr.json of a group: other programs read this much of it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Group<A> {
    zarr_format: u64,
    node_type: String,
    attributes: A,
}

/// Attributes of a record.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Attributes {
    lumley: Metadata,
    lumley_crc32c: String,
}

/// Attributes of a group of arrays.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct NoAttributes {}

/// What records of all versions say.
#[derive(Deserialize)]
struct AnyVersion {
    attributes: AnyAttributes,
}

#[derive(Deserialize)]
struct AnyAttributes {
    lumley: AnyMetadata,
}

#[derive(Deserialize)]
struct AnyMetadata {
    format: u64,
}

/// Writes the zarr.json of a group of arrays.
pub(super) fn write_group(folder: &Path, attributes: &Value) -> Result<(), (PathBuf, io::Error)> {
    let group = json!({ "zarr_format": 3, "node_type": "group", "attributes": attributes });
    write_json(&folder.join("zarr.json"), &group)
}

/// Checks that the zarr.json of a group of arrays says what it must.
pub(super) fn check_group(folder: &Path) -> Result<(), RecordError> {
    let path = folder.join("zarr.json");
    parse_group(&path, &read_text(&path, LIMIT)?).map(|NoAttributes {}| ())
}

/// The attributes in the zarr.json of a group. It is read into the types above and no others: what stands
/// there can take little more memory than the file.
fn parse_group<A: DeserializeOwned>(path: &Path, text: &str) -> Result<A, RecordError> {
    let group: Group<A> = serde_json::from_str(text).map_err(RecordError::json(path))?;
    if (group.zarr_format, group.node_type.as_str()) == (3, "group") {
        return Ok(group.attributes);
    }
    Err(RecordError::Invalid {
        path: path.to_owned(),
        key: "zarr_format, node_type".into(),
        value: format!("{}, {}", group.zarr_format, printable(&group.node_type)),
        expected: "3, group".into(),
    })
}
