use super::array::Array;
use super::layout::Layout;
use super::metadata::Metadata;
use super::{Description, Record, RecordError};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// What is recorded at one time, in the order of the [`Description`].
///
/// ```
/// let u = [0.0, 0.1, 0.2];
/// let snapshot = lumley::record::Snapshot { time: 0.5, series: &[&[0.9]], fields: &[&u] };
/// assert_eq!(snapshot.fields[0].len(), 3);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Snapshot<'a> {
    /// The time, in s.
    pub time: f64,
    /// The series, in the units of their entries.
    pub series: &'a [&'a [f64]],
    /// The fields, one a frame, in the units of their components.
    pub fields: &'a [&'a [f64]],
}

/// Writes a record, snapshot by snapshot.
///
/// Snapshots are gathered and go to disk a batch of chunks at a time, or at [`flush`](Self::flush). First the
/// chunks are written, each whole or not at all; then the number of snapshots is raised, and with that
/// readers see them. After a crash, [`open`](Self::open) goes on behind the last snapshot so committed. What was
/// not flushed when the writer is dropped is lost. Only one writer may work on a record.
///
/// ```
/// use lumley::record::*;
/// let folder = tempfile::tempdir()?;
/// let description = Description {
///     frames: vec![FrameDescription {
///         name: "reference".into(),
///         support: Support::Nodes(vec![[0.0, 0.0], [1.0, 0.0]]),
///         length_unit: "1".into(),
///         components: vec![Quantity::new("u", "m/s")],
///     }],
///     ..Description::default()
/// };
/// let path = folder.path().join("record");
/// let mut writer = RecordWriter::create(&path, &description)?;
/// writer.append(&Snapshot { time: 0.0, series: &[], fields: &[&[0.0, 0.1]] })?;
/// writer.flush()?;
/// let mut writer = RecordWriter::open(&path)?;
/// assert_eq!(writer.len(), 1);
/// let diverged = writer.append(&Snapshot { time: 0.1, series: &[], fields: &[&[0.0, f64::NAN]] });
/// assert!(matches!(diverged, Err(RecordError::NonFinite { index: 1, .. })));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct RecordWriter {
    layout: Layout,
    /// As it stands on disk.
    metadata: Metadata,
    batch: Batch,
}

/// The snapshots of one row of chunks, those on disk and those to come there.
#[derive(Debug, Default)]
struct Batch {
    /// Number of the row of chunks.
    index: usize,
    /// Time of the last snapshot before these.
    previous: Option<f64>,
    times: Vec<f64>,
    /// One vector a series, one snapshot after the other.
    series: Vec<Vec<f64>>,
    /// One vector a frame, one snapshot after the other.
    fields: Vec<Vec<f64>>,
}

impl RecordWriter {
    /// Makes an empty record in the directory `path`, which must not exist or be empty.
    ///
    /// # Errors
    /// [`RecordError`]: the directory is taken, the description is impossible, or a file cannot be written.
    pub fn create(path: impl AsRef<Path>, description: &Description) -> Result<Self, RecordError> {
        let root = path.as_ref();
        description.check(root)?;
        if fs::read_dir(root).map_or(root.exists(), |mut entries| entries.next().is_some()) {
            return Err(RecordError::Exists { path: root.to_owned() });
        }
        let metadata = Metadata::new(description);
        let layout = Layout::new(root, &metadata);
        layout
            .create(description)
            .and_then(|()| metadata.write(root))
            .map_err(|(path, source)| write_error(path, source, 0))?;
        Self::open(root)
    }

    /// Goes on with the record in the directory `path`, behind its last committed snapshot.
    ///
    /// # Errors
    /// [`RecordError`]: no record, damaged, or not writable.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, RecordError> {
        let Record { metadata, layout, .. } = Record::open(path)?;
        let mut writer = Self { layout, metadata, batch: Batch::default() };
        writer.load_batch()?;
        Ok(writer)
    }

    /// Number of snapshots, those not yet on disk included.
    pub fn len(&self) -> usize {
        self.first() + self.batch.times.len()
    }

    /// Whether nothing was recorded yet.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Time of the last snapshot, in s.
    pub fn last_time(&self) -> Option<f64> {
        self.batch.times.last().copied().or(self.batch.previous)
    }

    /// Takes a snapshot. A full batch goes to disk first.
    ///
    /// # Errors
    /// [`RecordError`]: numbers that are not finite, times that do not increase, other lengths than
    /// described, or a full disk. The snapshot is then not taken, and the call may be repeated.
    pub fn append(&mut self, snapshot: &Snapshot) -> Result<(), RecordError> {
        self.check(snapshot)?;
        if self.batch.times.len() == self.metadata.chunk_snapshots {
            self.flush()?;
            self.batch.begin_next();
        }
        self.batch.push(snapshot);
        Ok(())
    }

    /// Brings all snapshots to disk and shows them to readers.
    ///
    /// # Errors
    /// [`RecordError::Write`], naming the file. What was committed before stays as it was, and the call may be
    /// repeated.
    pub fn flush(&mut self) -> Result<(), RecordError> {
        let count = self.len();
        if count == self.metadata.snapshots {
            return Ok(());
        }
        let committed = self.metadata.snapshots;
        let next = self.metadata.with_snapshots(count);
        self.batch
            .write(&self.layout)
            .and_then(|()| self.layout.growing().try_for_each(|array| array.write_metadata(count)))
            .and_then(|()| next.write(&self.layout.root))
            .map_err(|(path, source)| write_error(path, source, committed))?;
        self.metadata = next;
        Ok(())
    }

    /// Forgets all snapshots but the first `count`: those after a checkpoint are computed again.
    ///
    /// # Errors
    /// [`RecordError`]: fewer snapshots than `count`; or a file that cannot be written or read, and then the
    /// writer must be opened anew.
    pub fn truncate(&mut self, count: usize) -> Result<(), RecordError> {
        if count > self.len() {
            return Err(RecordError::TooFew { count, len: self.len() });
        }
        self.flush()?;
        let next = self.metadata.with_snapshots(count);
        let failed = |(path, source)| write_error(path, source, count);
        next.write(&self.layout.root).map_err(failed)?;
        self.metadata = next;
        self.load_batch()?;
        self.layout.growing().try_for_each(|array| array.write_metadata(count)).map_err(failed)
    }

    /// [`flush`](Self::flush), and the end.
    ///
    /// # Errors
    /// [`RecordError::Write`].
    pub fn finish(mut self) -> Result<(), RecordError> {
        self.flush()
    }

    /// Number of the first snapshot of the batch.
    fn first(&self) -> usize {
        self.batch.index * self.metadata.chunk_snapshots
    }

    /// Takes up the row of chunks that the next snapshot belongs to, and clears away what a crash left there.
    fn load_batch(&mut self) -> Result<(), RecordError> {
        let (count, height) = (self.metadata.snapshots, self.metadata.chunk_snapshots);
        let (index, kept) = (count / height, count % height);
        let load = |array: &Array| match kept {
            0 => Ok(Vec::new()),
            _ => array.read_band(index, kept),
        };
        let times = &self.layout.times;
        self.batch = Batch {
            index,
            previous: match index {
                0 => None,
                _ => times.read_band(index - 1, height)?.last().copied(),
            },
            times: load(times)?,
            series: self.layout.series.iter().map(load).collect::<Result<_, _>>()?,
            fields: self.layout.values.iter().map(load).collect::<Result<_, _>>()?,
        };
        for array in self.layout.growing() {
            array.remove_after(index).map_err(|e| write_error(array.folder(), e, count))?;
        }
        Ok(())
    }

    fn check(&self, snapshot: &Snapshot) -> Result<(), RecordError> {
        let (number, time) = (self.len(), snapshot.time);
        let previous = self.last_time().unwrap_or(f64::NEG_INFINITY);
        if !time.is_finite() || time <= previous {
            return Err(RecordError::TimeOrder { snapshot: number, time, previous });
        }
        let parts = [
            ("series", &self.layout.series, snapshot.series),
            ("frames", &self.layout.values, snapshot.fields),
        ];
        for (what, arrays, vectors) in parts {
            if vectors.len() != arrays.len() {
                return Err(RecordError::Shape {
                    snapshot: number,
                    array: what.to_owned(),
                    found: vectors.len(),
                    expected: arrays.len(),
                });
            }
            for (array, vector) in arrays.iter().zip(vectors) {
                check_vector(&array.name, array.width(), vector, number, time)?;
            }
        }
        Ok(())
    }
}

impl Batch {
    fn push(&mut self, snapshot: &Snapshot) {
        self.times.push(snapshot.time);
        let series = self.series.iter_mut().zip(snapshot.series);
        let fields = self.fields.iter_mut().zip(snapshot.fields);
        series.chain(fields).for_each(|(kept, vector)| kept.extend_from_slice(vector));
    }

    fn begin_next(&mut self) {
        self.index += 1;
        self.previous = self.times.last().copied();
        self.times.clear();
        self.series.iter_mut().chain(&mut self.fields).for_each(Vec::clear);
    }

    /// Writes the row of chunks of every array.
    fn write(&self, layout: &Layout) -> Result<(), (PathBuf, io::Error)> {
        let vectors = [&self.times].into_iter().chain(&self.series).chain(&self.fields);
        for (array, vectors) in layout.growing().zip(vectors) {
            for j in 0..array.chunk_columns() {
                let columns = array.columns_of(j);
                let rows = vectors.chunks_exact(array.width()).map(|row| &row[columns.clone()]);
                array.write_chunk(self.index, j, rows)?;
            }
            array.sync_band(self.index);
        }
        Ok(())
    }
}

fn check_vector(
    array: &str,
    expected: usize,
    vector: &[f64],
    snapshot: usize,
    time: f64,
) -> Result<(), RecordError> {
    let (array, found) = (array.to_owned(), vector.len());
    if found != expected {
        return Err(RecordError::Shape { snapshot, array, found, expected });
    }
    match vector.iter().position(|value| !value.is_finite()) {
        Some(index) => {
            Err(RecordError::NonFinite { array, snapshot, time, index, value: vector[index] })
        }
        None => Ok(()),
    }
}

fn write_error(path: PathBuf, source: io::Error, committed: usize) -> RecordError {
    RecordError::Write { action: "write", path, committed, source }
}
