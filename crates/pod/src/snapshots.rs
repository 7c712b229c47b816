use crate::contiguous::copy;
use faer::{Mat, MatMut, MatRef};
use std::io;
use std::ops::Range;

/// Where snapshots come from: memory, disk, or the rows that one machine owns.
///
/// The snapshot matrix X has one column per snapshot, n rows and M columns.
///
/// ```
/// use faer::MatMut;
/// use lumley_pod::{Identity, Options, SnapshotSource, auto};
/// use std::{io, ops::Range};
/// /// A standing wave on a line of 100 points, computed where it is read.
/// struct Wave(Vec<f64>);
/// impl SnapshotSource for Wave {
///     fn dim(&self) -> usize { 100 }
///     fn times(&self) -> &[f64] { &self.0 }
///     fn block(&self, rows: Range<usize>, cols: Range<usize>, mut out: MatMut<'_, f64>)
///     -> io::Result<()> {
///         for (t, column) in self.0[cols].iter().zip(out.as_mut().col_iter_mut()) {
///             let at = |i: usize| (0.1 * i as f64).sin() * t.cos();
///             rows.clone().zip(column.iter_mut()).for_each(|(i, x)| *x = at(i));
///         }
///         Ok(())
///     }
/// }
/// let basis = auto(&Wave(vec![0.0, 0.5, 1.0]), &Identity::new(100), &Options::default())?;
/// assert_eq!(basis.size(), 1);
/// # Ok::<(), lumley_pod::PodError>(())
/// ```
pub trait SnapshotSource: Sync {
    /// Length n of a snapshot.
    fn dim(&self) -> usize;
    /// Times of the M snapshots, in s.
    fn times(&self) -> &[f64];
    /// Reads `X[rows, cols]` into `out`, which has that shape.
    ///
    /// # Errors
    /// The failure of the medium, or damaged data, named.
    fn block(&self, rows: Range<usize>, cols: Range<usize>, out: MatMut<'_, f64>)
    -> io::Result<()>;
    /// All of X, where it lies in memory with contiguous columns: it is then read there, not copied.
    fn view(&self) -> Option<MatRef<'_, f64>> {
        None
    }
    /// Bytes that one block should have for reading it to be cheap: none where any size is.
    fn read_size(&self) -> usize {
        0
    }
}

/// Snapshots held in memory.
///
/// ```
/// use lumley_pod::{MemorySnapshots, SnapshotSource};
/// let x = faer::mat![[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]];
/// let snapshots = MemorySnapshots::new(x, vec![0.0, 0.1]);
/// assert_eq!((snapshots.dim(), snapshots.times().len()), (3, 2));
/// ```
#[derive(Debug, Clone)]
pub struct MemorySnapshots {
    x: Mat<f64>,
    times: Vec<f64>,
}

impl MemorySnapshots {
    /// The columns of `x` as snapshots at `times`, in s.
    ///
    /// # Panics
    /// If there is not one time for each column.
    pub fn new(x: Mat<f64>, times: Vec<f64>) -> Self {
        assert_eq!(x.ncols(), times.len(), "one time for each snapshot");
        Self { x, times }
    }

    /// The snapshot matrix, n x M.
    pub fn matrix(&self) -> MatRef<'_, f64> {
        self.x.as_ref()
    }
}

impl SnapshotSource for MemorySnapshots {
    fn dim(&self) -> usize {
        self.x.nrows()
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
        copy(self.x.submatrix(rows.start, cols.start, rows.len(), cols.len()), out);
        Ok(())
    }

    fn view(&self) -> Option<MatRef<'_, f64>> {
        Some(self.x.as_ref())
    }
}
