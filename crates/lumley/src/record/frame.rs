use super::RecordError;
use super::array::{Array, numbers};
use faer::MatMut;
use lumley_pod::SnapshotSource;
use std::collections::VecDeque;
use std::io;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

/// Bytes that are kept of the chunks read last.
const CACHE: usize = 1 << 26;

/// Chunks that are kept at most: they are searched one by one.
const CACHED_CHUNKS: usize = 64;

/// Numbers in little-endian bytes.
type Chunk = Arc<Vec<u8>>;

/// The snapshots of one frame of a record, read by blocks and checked on the way.
///
/// Memory is bounded: about 64 MiB of the chunks read last are kept. Threads may share it. See
/// [`Record::frame`](super::Record::frame).
///
/// ```
/// use lumley::record::FrameReader;
/// use lumley_pod::SnapshotSource;
/// fn largest(frame: &FrameReader) -> std::io::Result<f64> {
///     let mut x = faer::Mat::zeros(frame.dim(), frame.times().len());
///     frame.block(0..x.nrows(), 0..x.ncols(), x.as_mut())?;
///     Ok(x.norm_max())
/// }
/// ```
#[derive(Debug)]
pub struct FrameReader {
    values: Array,
    times: Vec<f64>,
    /// Chunks and their places, the one used last at the end.
    cache: Mutex<VecDeque<([usize; 2], Chunk)>>,
}

impl FrameReader {
    pub(super) fn new(values: Array, times: Vec<f64>) -> Self {
        Self { values, times, cache: Mutex::default() }
    }

    fn chunk(&self, place: [usize; 2]) -> Result<Chunk, RecordError> {
        let lock = || self.cache.lock().unwrap_or_else(PoisonError::into_inner);
        let mut cache = lock();
        if let Some(found) = cache.iter().position(|(cached, _)| *cached == place) {
            let entry = cache.remove(found).expect("found just before");
            cache.push_back(entry.clone());
            return Ok(entry.1);
        }
        drop(cache); // other threads go on while this one reads
        let chunk = Arc::new(self.values.read_chunk(place[0], place[1])?);
        let mut cache = lock();
        while cache.len() >= (CACHE / chunk.len()).clamp(1, CACHED_CHUNKS) {
            cache.pop_front();
        }
        cache.push_back((place, Arc::clone(&chunk)));
        Ok(chunk)
    }

    /// Reads the block of `rows` and `cols` into `out`, which has that shape.
    ///
    /// # Errors
    /// [`RecordError::DamagedBlock`], or the failure of the medium.
    ///
    /// # Panics
    /// If the block reaches beyond the snapshots or `out` has another shape.
    pub fn read_block(
        &self,
        rows: Range<usize>,
        cols: Range<usize>,
        mut out: MatMut<'_, f64>,
    ) -> Result<(), RecordError> {
        assert!(rows.end <= self.values.width() && cols.end <= self.times.len(), "a block inside");
        assert_eq!((out.nrows(), out.ncols()), (rows.len(), cols.len()), "room for the block");
        let [height, width] = self.values.chunk;
        // Rows first: the next block begins with the chunks that this one ends with.
        for j in parts(&rows, width) {
            let row = overlap(&rows, j, width);
            for i in parts(&cols, height) {
                let chunk = self.chunk([i, j])?;
                for snapshot in overlap(&cols, i, height) {
                    let first = (snapshot - i * height) * width + row.start - j * width;
                    let to = out.as_mut().col_mut(snapshot - cols.start);
                    let to = to.subrows_mut(row.start - rows.start, row.len());
                    let from = numbers(&chunk[8 * first..]);
                    to.iter_mut().zip(from).for_each(|(to, from)| *to = from);
                }
            }
        }
        Ok(())
    }
}

impl SnapshotSource for FrameReader {
    fn dim(&self) -> usize {
        self.values.width()
    }

    fn times(&self) -> &[f64] {
        &self.times
    }

    fn block(
        &self,
        rows: Range<usize>,
        cols: Range<usize>,
        out: MatMut<'_, f64>,
    ) -> io::Result<()> {
        self.read_block(rows, cols, out).map_err(io::Error::other)
    }

    /// A chunk in each snapshot: then every chunk is read once.
    fn read_size(&self) -> usize {
        8 * self.values.chunk[1] * self.times.len()
    }
}

/// The chunks of length `length` that `range` touches.
fn parts(range: &Range<usize>, length: usize) -> Range<usize> {
    if range.is_empty() { 0..0 } else { range.start / length..range.end.div_ceil(length) }
}

/// What of `range` lies in chunk `k`.
fn overlap(range: &Range<usize>, k: usize, length: usize) -> Range<usize> {
    range.start.max(k * length)..range.end.min((k + 1) * length)
}

#[cfg(test)]
mod tests {
    use super::{CACHED_CHUNKS, FrameReader};
    use crate::record::array::Array;
    use faer::Mat;

    /// Memory is bounded: old chunks go, also when all are read in turn and again.
    #[test]
    fn few_chunks_are_kept() -> Result<(), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        let values = Array {
            root: folder.path().to_owned(),
            name: "values".into(),
            axes: ["snapshots", "rows"],
            columns: Some(100),
            chunk: [1, 1],
            attributes: serde_json::Value::Null,
        };
        for j in 0..100 {
            let written = values.write_chunk(0, j, [[j as f64].as_slice()].into_iter());
            written.map_err(|(_, e)| e)?;
        }
        let frame = FrameReader::new(values, vec![0.0]);
        let mut x = Mat::zeros(100, 1);
        for _ in 0..2 {
            frame.read_block(0..100, 0..1, x.as_mut())?;
            let kept = frame.cache.lock().expect("no thread panicked").len();
            assert!(kept <= CACHED_CHUNKS, "{kept} chunks are kept");
        }
        assert_eq!(x, Mat::from_fn(100, 1, |i, _| i as f64));
        Ok(())
    }
}
