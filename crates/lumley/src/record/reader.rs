use super::layout::Layout;
use super::metadata::Metadata;
use super::{Description, FrameReader, RecordError};
use std::path::Path;

/// A record of snapshots, open for reading.
///
/// ```
/// # use lumley::record::*;
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("record");
/// # let frame = FrameDescription {
/// #     name: "fixed".into(),
/// #     support: Support::Grid(lumley_fem::UniformGrid::line(0.0, 1.0, 3)),
/// #     length_unit: "m".into(),
/// #     components: vec![Quantity::new("u", "m/s")],
/// # };
/// # let position =
/// #     SeriesDescription { name: "position".into(), entries: vec![Quantity::new("X", "m")] };
/// # let description =
/// #     Description { frames: vec![frame], series: vec![position], ..Description::default() };
/// # let mut writer = RecordWriter::create(&path, &description)?;
/// # writer.append(&Snapshot { time: 0.5, series: &[&[0.9]], fields: &[&[0.0, 0.1, 0.2]] })?;
/// # writer.flush()?;
/// let record = Record::open(&path)?;
/// assert_eq!(record.times(), [0.5]);
/// assert_eq!(record.series("position")?.at(0), [0.9]);
/// let mut u = faer::Mat::zeros(3, 1);
/// lumley_pod::SnapshotSource::block(&record.frame("fixed")?, 0..3, 0..1, u.as_mut())?;
/// assert_eq!(u[(2, 0)], 0.2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Record {
    pub(super) metadata: Metadata,
    pub(super) layout: Layout,
    description: Description,
    times: Vec<f64>,
    series: Vec<Series>,
}

/// A short vector at each snapshot.
///
/// ```
/// let x = lumley::record::Series::new(2, vec![0.0, 0.1, 1.0, 1.1, 2.0, 2.1]);
/// assert_eq!(x.at(2), [2.0, 2.1]);
/// assert_eq!(x.entry(1).collect::<Vec<_>>(), [0.1, 1.1, 2.1]);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    width: usize,
    values: Vec<f64>,
}

impl Series {
    /// The series of vectors of length `width`, which stand in `values` one after the other.
    ///
    /// # Panics
    /// If `values` does not hold whole vectors.
    pub fn new(width: usize, values: Vec<f64>) -> Self {
        assert!(width > 0 && values.len().is_multiple_of(width), "whole vectors");
        Self { width, values }
    }

    /// The vector at snapshot `k`.
    ///
    /// # Panics
    /// If there is no such snapshot.
    pub fn at(&self, k: usize) -> &[f64] {
        &self.values[k * self.width..][..self.width]
    }

    /// Entry `i` at all snapshots.
    pub fn entry(&self, i: usize) -> impl Iterator<Item = f64> {
        self.values.iter().skip(i).step_by(self.width).copied()
    }
}

impl Record {
    /// Opens the record in the directory `path`: descriptions, times and series are read and checked.
    ///
    /// What is allocated grows with what is on disk, never with what a description claims.
    ///
    /// # Errors
    /// [`RecordError`]: no record, another version, or damaged, with the file and the place.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, RecordError> {
        let root = path.as_ref();
        let metadata = Metadata::read(root)?;
        let layout = Layout::new(root, &metadata);
        let description = layout.describe(&metadata)?;
        layout.check(&metadata)?;
        let times = layout.times.read_rows(metadata.snapshots)?;
        check_times(&times, root)?;
        let read = |array: &super::array::Array| {
            Ok(Series::new(array.width(), array.read_rows(metadata.snapshots)?))
        };
        let series = layout.series.iter().map(read).collect::<Result<_, RecordError>>()?;
        Ok(Self { metadata, layout, description, times, series })
    }

    /// Number of snapshots.
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// Whether nothing was recorded yet.
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// Times of the snapshots, in s.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// What the record holds.
    pub fn description(&self) -> &Description {
        &self.description
    }

    /// The series `name`, for example the generalised positions.
    ///
    /// # Errors
    /// [`RecordError::NoSuch`].
    pub fn series(&self, name: &str) -> Result<&Series, RecordError> {
        let names = self.description.series.iter().map(|series| &series.name);
        Ok(&self.series[position("series", name, names)?])
    }

    /// The snapshots in the frame `name`, to be read by blocks.
    ///
    /// # Errors
    /// [`RecordError::NoSuch`].
    pub fn frame(&self, name: &str) -> Result<FrameReader, RecordError> {
        let names = self.description.frames.iter().map(|frame| &frame.name);
        let k = position("frame", name, names)?;
        Ok(FrameReader::new(self.layout.values[k].clone(), self.times.clone()))
    }

    /// Reads every block and checks it; returns the number of blocks.
    ///
    /// # Errors
    /// [`RecordError::DamagedBlock`], naming the first damaged block and what it covers.
    pub fn verify(&self) -> Result<usize, RecordError> {
        self.layout.verify(&self.metadata)
    }
}

fn position<'a>(
    what: &'static str,
    name: &str,
    mut names: impl Iterator<Item = &'a String> + Clone,
) -> Result<usize, RecordError> {
    let available = names.clone();
    names.position(|known| known == name).ok_or_else(|| RecordError::NoSuch {
        what,
        name: name.to_owned(),
        available: available.cloned().collect(),
    })
}

fn check_times(times: &[f64], root: &Path) -> Result<(), RecordError> {
    let mut previous = f64::NEG_INFINITY;
    for (snapshot, &time) in times.iter().enumerate() {
        if !time.is_finite() || time <= previous {
            return Err(RecordError::Invalid {
                path: root.join("time"),
                key: format!("time of snapshot {snapshot}"),
                value: format!("{time} s after {previous} s"),
                expected: "finite, increasing times".into(),
            });
        }
        previous = time;
    }
    Ok(())
}
