use super::array::Array;
use super::metadata::{FrameMetadata, Metadata, SupportMetadata, check_group, write_group};
use super::{Description, FrameDescription, RecordError, Support};
use lumley_fem::{Point, UniformGrid};
use serde_json::json;
use std::io;
use std::path::{Path, PathBuf};

/// Nodes in a chunk of coordinates: 1 MiB.
const CHUNK_NODES: usize = 1 << 16;

/// The arrays of a record.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    pub root: PathBuf,
    pub times: Array,
    pub series: Vec<Array>,
    /// The fields, one array a frame.
    pub values: Vec<Array>,
    /// Where the fields live: the two corners of a grid, or the nodes.
    supports: Vec<Array>,
}

impl Layout {
    pub fn new(root: &Path, metadata: &Metadata) -> Self {
        let height = metadata.chunk_snapshots;
        let array = |name: String, axes, columns: Option<usize>, chunk, attributes| Array {
            root: root.to_owned(),
            name,
            axes,
            columns,
            chunk,
            attributes,
        };
        let series = |series: &super::SeriesDescription| {
            let (name, width) = (format!("series/{}", series.name), series.entries.len());
            let attributes = json!({ "entries": series.entries });
            array(name, ["snapshots", "entries"], Some(width), [height, width], attributes)
        };
        let values = |frame: &FrameMetadata| {
            let name = format!("frames/{}/values", frame.name);
            let attributes = json!({ "components": frame.components });
            let chunk = [height, frame.chunk_rows];
            array(name, ["snapshots", "rows"], Some(frame.rows()), chunk, attributes)
        };
        let support = |frame: &FrameMetadata| {
            let (part, rows) = match frame.support {
                SupportMetadata::Grid(_) => ("bounds", 2),
                SupportMetadata::Nodes(count) => ("nodes", count.min(CHUNK_NODES)),
            };
            let name = format!("frames/{}/{part}", frame.name);
            let attributes = json!({ "unit": frame.length_unit });
            array(name, ["points", "coordinates"], Some(2), [rows, 2], attributes)
        };
        let axes = ["snapshots", ""];
        Self {
            root: root.to_owned(),
            times: array("time".into(), axes, None, [height, 1], json!({ "unit": "s" })),
            series: metadata.series.iter().map(series).collect(),
            values: metadata.frames.iter().map(values).collect(),
            supports: metadata.frames.iter().map(support).collect(),
        }
    }

    /// The arrays that grow with each snapshot.
    pub fn growing(&self) -> impl Iterator<Item = &Array> {
        [&self.times].into_iter().chain(&self.series).chain(&self.values)
    }

    /// Checks that each array is described as the record says, and that its blocks are there in their length.
    pub fn check(&self, metadata: &Metadata) -> Result<(), RecordError> {
        let frames = self.root.join("frames");
        let folders = metadata.frames.iter().map(|frame| frames.join(&frame.name));
        for folder in [self.root.join("series"), frames.clone()].into_iter().chain(folders) {
            check_group(&folder)?;
        }
        for (array, rows) in self.arrays(metadata) {
            array.check_metadata(rows)?;
            array.chunks(rows).try_for_each(|(i, j)| array.check_chunk(i, j))?;
        }
        Ok(())
    }

    /// Writes all that is there before the first snapshot but the record's own description.
    pub fn create(&self, description: &Description) -> Result<(), (PathBuf, io::Error)> {
        for folder in ["frames", "series"] {
            write_group(&self.root.join(folder), &json!({}))?;
        }
        for (array, frame) in self.supports.iter().zip(&description.frames) {
            write_group(&self.root.join("frames").join(&frame.name), &json!({}))?;
            let points: Vec<Point> = match &frame.support {
                Support::Grid(grid) => vec![grid.bounds().0, grid.bounds().1],
                Support::Nodes(nodes) => nodes.clone(),
            };
            array.write_metadata(points.len())?;
            for (i, part) in points.chunks(array.chunk[0]).enumerate() {
                array.write_chunk(i, 0, part.iter().map(<[f64; 2]>::as_slice))?;
                array.sync_band(i);
            }
        }
        self.growing().try_for_each(|array| array.write_metadata(0))
    }

    /// The description with what stands in arrays.
    pub fn describe(&self, metadata: &Metadata) -> Result<Description, RecordError> {
        let frames = self.supports.iter().zip(&metadata.frames).map(|(array, frame)| {
            Ok(FrameDescription {
                name: frame.name.clone(),
                support: support(array, frame)?,
                length_unit: frame.length_unit.clone(),
                components: frame.components.clone(),
            })
        });
        Ok(Description {
            frames: frames.collect::<Result<_, RecordError>>()?,
            series: metadata.series.clone(),
            provenance: metadata.provenance.clone(),
            gathered: None,
        })
    }

    /// Reads every block of `snapshots` snapshots and of the supports; returns their number.
    pub fn verify(&self, metadata: &Metadata) -> Result<usize, RecordError> {
        let mut blocks = 0;
        for (array, rows) in self.arrays(metadata) {
            for (i, j) in array.chunks(rows) {
                array.read_chunk(i, j)?;
                blocks += 1;
            }
        }
        Ok(blocks)
    }

    /// All arrays and the number of their rows.
    fn arrays(&self, metadata: &Metadata) -> impl Iterator<Item = (&Array, usize)> {
        let growing = self.growing().map(|array| (array, metadata.snapshots));
        growing.chain(self.supports.iter().zip(metadata.frames.iter().map(points)))
    }
}

fn points(frame: &FrameMetadata) -> usize {
    match frame.support {
        SupportMetadata::Grid(_) => 2,
        SupportMetadata::Nodes(count) => count,
    }
}

fn support(array: &Array, frame: &FrameMetadata) -> Result<Support, RecordError> {
    let coordinates = array.read_rows(points(frame))?;
    let points = coordinates.as_chunks::<2>().0;
    let invalid = |expected: &str| RecordError::Invalid {
        path: array.folder(),
        key: format!("{} of a grid of {:?}", array.name, frame.support),
        value: format!("{points:?}").chars().take(80).collect(),
        expected: expected.to_owned(),
    };
    if !coordinates.iter().all(|x| x.is_finite()) {
        return Err(invalid("finite coordinates"));
    }
    match (frame.support, points) {
        (SupportMetadata::Grid([nodes, 1]), &[[a, 0.0], [b, 0.0]]) if nodes >= 2 && a < b => {
            Ok(Support::Grid(UniformGrid::line(a, b, nodes)))
        }
        (SupportMetadata::Grid(nodes), &[lower, upper])
            if nodes.into_iter().all(|n| n >= 2) && (0..2).all(|d| lower[d] < upper[d]) =>
        {
            Ok(Support::Grid(UniformGrid::rectangle(lower, upper, nodes)))
        }
        (SupportMetadata::Nodes(_), points) => Ok(Support::Nodes(points.to_vec())),
        _ => Err(invalid("two nodes and a length in each direction")),
    }
}
