use super::NpyMatrix;
use crate::format::FormatError;
use crate::format::region::Region;
use faer::MatMut;
use lumley_pod::SnapshotSource;
use std::io;
use std::ops::Range;
use std::path::Path;

/// Bytes of each snapshot that are worth a jump in a file that has one after the other.
const SPAN: usize = 1 << 16;

/// Bytes of a block that are not worth more, however many snapshots there are.
const MOST: usize = 1 << 25;

/// Bytes of a block from a file that has the unknowns one after the other: it stays in the cache.
const LINES: usize = 1 << 21;

/// Which axis of an array counts the snapshots.
///
/// ```
/// use lumley::format::npy::SnapshotLayout;
/// assert_eq!(SnapshotLayout::default(), SnapshotLayout::Rows);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SnapshotLayout {
    /// The first: an array (M, ...).
    #[default]
    Rows,
    /// The last: an array (..., M).
    Columns,
}

/// Snapshots in an NPY file of any program, read by blocks.
///
/// Where the array has more than two axes, all but the one that counts the snapshots are taken together.
///
/// ```
/// use lumley::format::npy::{self, NpySnapshots, SnapshotLayout};
/// use lumley_pod::SnapshotSource;
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("x.npy");
/// npy::write_matrix(&path, faer::mat![[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]].as_ref())?;
/// let snapshots = NpySnapshots::open(&path, SnapshotLayout::Rows)?.with_times(vec![0.0, 0.1])?;
/// assert_eq!((snapshots.dim(), snapshots.times().len()), (3, 2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct NpySnapshots {
    matrix: NpyMatrix,
    layout: SnapshotLayout,
    times: Vec<f64>,
}

impl NpySnapshots {
    /// The snapshots in the file `path`, at the times 0, 1, 2, ... s.
    ///
    /// # Errors
    /// [`FormatError`] as for [`NpyMatrix::open`], and for an array of one axis.
    pub fn open(path: impl AsRef<Path>, layout: SnapshotLayout) -> Result<Self, FormatError> {
        let matrix = NpyMatrix::in_region(Region::open(path.as_ref())?, |axes| match layout {
            SnapshotLayout::Rows => 1,
            SnapshotLayout::Columns => axes - 1,
        })?;
        if matrix.shape().len() < 2 {
            return Err(FormatError::Shape {
                path: matrix.path().to_owned(),
                shape: matrix.shape().to_vec(),
                expected: "at least two axes, one of which counts the snapshots",
            });
        }
        let count = match layout {
            SnapshotLayout::Rows => matrix.rows(),
            SnapshotLayout::Columns => matrix.cols(),
        };
        Ok(Self { matrix, layout, times: (0..count).map(|k| k as f64).collect() })
    }

    /// The same snapshots at `times`, in s.
    ///
    /// # Errors
    /// [`FormatError`]: not one for each snapshot, not finite, or not increasing.
    pub fn with_times(mut self, times: Vec<f64>) -> Result<Self, FormatError> {
        let path = || self.matrix.path().to_owned();
        if times.len() != self.times.len() {
            let (snapshots, times) = (self.times.len(), times.len());
            return Err(FormatError::TimeCount { path: path(), snapshots, times });
        }
        let mut previous = f64::NEG_INFINITY;
        for (snapshot, &time) in times.iter().enumerate() {
            if !time.is_finite() || time <= previous {
                return Err(FormatError::TimeOrder { path: path(), snapshot, time, previous });
            }
            previous = time;
        }
        self.times = times;
        Ok(self)
    }

    /// The array.
    pub fn matrix(&self) -> &NpyMatrix {
        &self.matrix
    }
}

impl SnapshotSource for NpySnapshots {
    fn dim(&self) -> usize {
        match self.layout {
            SnapshotLayout::Rows => self.matrix.cols(),
            SnapshotLayout::Columns => self.matrix.rows(),
        }
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
        let read = match self.layout {
            SnapshotLayout::Rows => self.matrix.read_block(cols, rows, out.transpose_mut()),
            SnapshotLayout::Columns => self.matrix.read_block(rows, cols, out),
        };
        read.map_err(io::Error::other)
    }

    fn read_size(&self) -> usize {
        let one_by_one = (self.layout == SnapshotLayout::Rows) != self.matrix.is_by_columns();
        if one_by_one {
            (8 * (SPAN / self.matrix.item_size()) * self.times.len()).min(MOST)
        } else {
            LINES
        }
    }
}
