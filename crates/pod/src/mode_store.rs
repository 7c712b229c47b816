use crate::contiguous::copy;
use faer::{Mat, MatMut, MatRef};
use std::io;
use std::ops::Range;
use std::sync::{PoisonError, RwLock, RwLockWriteGuard};

/// Where modes go, block of rows by block of rows: memory, or a file larger than it.
///
/// Columns are written as they come out of the snapshots ([`write`](Self::write)), read again when it
/// is known how to make them orthonormal, and then published in their final form. Blocks come
/// from any thread, in any order, each row once.
///
/// ```
/// use lumley_pod::{MemoryModes, ModeStore};
/// let store = MemoryModes::default();
/// store.reserve(3, 2)?;
/// store.write(1..3, faer::mat![[1.0, 2.0], [3.0, 4.0]].as_ref())?;
/// let mut row = faer::Mat::zeros(1, 2);
/// store.read(2..3, row.as_mut())?;
/// assert_eq!(row, faer::mat![[3.0, 4.0]]);
/// # Ok::<(), std::io::Error>(())
/// ```
pub trait ModeStore: Sync {
    /// Makes room for columns of `rows` rows that are yet to be made orthonormal; what a resumed
    /// decomposition wrote before stays.
    ///
    /// # Errors
    /// The failure of the medium.
    fn reserve(&self, rows: usize, columns: usize) -> io::Result<()>;
    /// Keeps these rows of all columns.
    ///
    /// # Errors
    /// The failure of the medium.
    fn write(&self, rows: Range<usize>, columns: MatRef<'_, f64>) -> io::Result<()>;
    /// Reads rows that were written.
    ///
    /// # Errors
    /// The failure of the medium.
    fn read(&self, rows: Range<usize>, out: MatMut<'_, f64>) -> io::Result<()>;
    /// Whether what was written so far outlives the process, so that a journal may count on it.
    fn is_lasting(&self) -> bool {
        true
    }
    /// Brings everything that was written to the medium, before a journal counts on it.
    ///
    /// # Errors
    /// The failure of the medium.
    fn sync(&self) -> io::Result<()>;
    /// Makes room for the modes in their final form, and for the mean where it was subtracted.
    ///
    /// # Errors
    /// The failure of the medium.
    fn begin(&self, rows: usize, modes: usize, mean: bool) -> io::Result<()>;
    /// These rows of the modes, and of the mean where it was subtracted, in their final form.
    ///
    /// # Errors
    /// The failure of the medium.
    fn publish(
        &self,
        rows: Range<usize>,
        modes: MatRef<'_, f64>,
        mean: Option<&[f64]>,
    ) -> io::Result<()>;
}

/// Modes in memory.
///
/// ```
/// use lumley_pod::{MemoryModes, ModeStore};
/// let store = MemoryModes::default();
/// store.begin(2, 1, true)?;
/// store.publish(0..2, faer::mat![[1.0], [0.0]].as_ref(), Some(&[0.5, 0.5]))?;
/// let (modes, mean) = store.into_parts();
/// assert_eq!((modes.shape(), mean), ((2, 1), Some(vec![0.5, 0.5])));
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug, Default)]
pub struct MemoryModes {
    held: RwLock<Held>,
}

#[derive(Debug)]
struct Held {
    /// The modes take the place of the columns that they are made of, and are never more.
    columns: Mat<f64>,
    modes: usize,
    mean: Option<Vec<f64>>,
}

impl Default for Held {
    fn default() -> Self {
        Self { columns: Mat::new(), modes: 0, mean: None }
    }
}

impl MemoryModes {
    /// The modes and the mean that were published.
    pub fn into_parts(self) -> (Mat<f64>, Option<Vec<f64>>) {
        let Held { mut columns, modes, mean } =
            self.held.into_inner().unwrap_or_else(PoisonError::into_inner);
        columns.truncate(columns.nrows(), modes);
        (columns, mean)
    }

    /// What a look at the modes and at the mean gives.
    pub(crate) fn with<T>(&self, look: impl FnOnce(&Mat<f64>, Option<&Vec<f64>>) -> T) -> T {
        let held = self.held.read().unwrap_or_else(PoisonError::into_inner);
        look(&held.columns, held.mean.as_ref())
    }

    fn held(&self) -> RwLockWriteGuard<'_, Held> {
        self.held.write().unwrap_or_else(PoisonError::into_inner)
    }
}

impl ModeStore for MemoryModes {
    fn reserve(&self, rows: usize, columns: usize) -> io::Result<()> {
        self.held().columns = Mat::zeros(rows, columns);
        Ok(())
    }

    fn write(&self, rows: Range<usize>, columns: MatRef<'_, f64>) -> io::Result<()> {
        put(&mut self.held().columns, &rows, columns);
        Ok(())
    }

    fn read(&self, rows: Range<usize>, out: MatMut<'_, f64>) -> io::Result<()> {
        let held = self.held.read().unwrap_or_else(PoisonError::into_inner);
        copy(held.columns.submatrix(rows.start, 0, rows.len(), out.ncols()), out);
        Ok(())
    }

    /// Columns go down with the process; before there are any, there is nothing to lose.
    fn is_lasting(&self) -> bool {
        self.with(|columns, _| columns.ncols() == 0)
    }

    fn sync(&self) -> io::Result<()> {
        Ok(())
    }

    fn begin(&self, rows: usize, modes: usize, mean: bool) -> io::Result<()> {
        let mut held = self.held();
        if held.columns.nrows() != rows || held.columns.ncols() < modes {
            held.columns = Mat::zeros(rows, modes);
        }
        held.modes = modes;
        held.mean = mean.then(|| vec![0.0; rows]);
        Ok(())
    }

    fn publish(
        &self,
        rows: Range<usize>,
        modes: MatRef<'_, f64>,
        mean: Option<&[f64]>,
    ) -> io::Result<()> {
        let mut held = self.held();
        put(&mut held.columns, &rows, modes);
        if let (Some(all), Some(mean)) = (&mut held.mean, mean) {
            all[rows].copy_from_slice(mean);
        }
        Ok(())
    }
}

fn put(all: &mut Mat<f64>, rows: &Range<usize>, columns: MatRef<'_, f64>) {
    copy(columns, all.submatrix_mut(rows.start, 0, rows.len(), columns.ncols()));
}
