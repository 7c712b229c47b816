use crate::{MemoryModes, ReducedBasis};
use faer::{Mat, MatMut};
use std::io;
use std::ops::Range;

/// Where the modes of an old basis come from, block of rows by block of rows: memory, or a file larger
/// than it.
///
/// ```
/// use lumley_pod::{Identity, MemorySnapshots, ModeSource, Options, svd};
/// let x = MemorySnapshots::new(faer::mat![[3.0, 1.0], [0.0, 0.0]], vec![0.0, 1.0]);
/// let basis = svd(&x, &Identity::new(2), &Options { center: true, ..Options::default() })?;
/// let mut last = faer::Mat::zeros(1, 1);
/// basis.block(1..2, last.as_mut())?;
/// assert_eq!((last[(0, 0)], basis.mean_of(0..2)?), (0.0, Some(vec![2.0, 0.0])));
/// # Ok::<(), lumley_pod::PodError>(())
/// ```
pub trait ModeSource: Sync {
    /// Length n of a mode.
    fn dim(&self) -> usize;
    /// Reads these rows of the first modes into `out`, which has a column for each.
    ///
    /// # Errors
    /// The failure of the medium, or damaged data, named.
    fn block(&self, rows: Range<usize>, out: MatMut<'_, f64>) -> io::Result<()>;
    /// These rows of the mean that was subtracted; nothing where none was.
    ///
    /// # Errors
    /// The failure of the medium, or damaged data, named.
    fn mean_of(&self, rows: Range<usize>) -> io::Result<Option<Vec<f64>>>;
}

impl ModeSource for ReducedBasis {
    fn dim(&self) -> usize {
        self.modes.nrows()
    }

    fn block(&self, rows: Range<usize>, out: MatMut<'_, f64>) -> io::Result<()> {
        copy_rows(&self.modes, &rows, out);
        Ok(())
    }

    fn mean_of(&self, rows: Range<usize>) -> io::Result<Option<Vec<f64>>> {
        Ok(self.mean.as_ref().map(|mean| mean[rows].to_vec()))
    }
}

impl ModeSource for MemoryModes {
    fn dim(&self) -> usize {
        self.with(|modes, _| modes.nrows())
    }

    fn block(&self, rows: Range<usize>, out: MatMut<'_, f64>) -> io::Result<()> {
        self.with(|modes, _| copy_rows(modes, &rows, out));
        Ok(())
    }

    fn mean_of(&self, rows: Range<usize>) -> io::Result<Option<Vec<f64>>> {
        Ok(self.with(|_, mean| mean.map(|mean| mean[rows].to_vec())))
    }
}

fn copy_rows(modes: &Mat<f64>, rows: &Range<usize>, mut out: MatMut<'_, f64>) {
    out.copy_from(modes.submatrix(rows.start, 0, rows.len(), out.ncols()));
}
