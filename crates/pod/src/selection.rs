use crate::agreement::together;
use crate::ensemble::Ensemble;
use crate::partial::Partial;
use crate::run::Run;
use crate::{Execution, Identity, MemoryModes, Options, PodError, SnapshotSource, Truncation};
use faer::MatMut;
use std::io;
use std::ops::Range;

/// Some of the snapshots of a source.
///
/// ```
/// use lumley_pod::{MemorySnapshots, Selection, SnapshotSource};
/// let x = faer::mat![[1.0, f64::NAN, 3.0], [4.0, 5.0, 6.0]];
/// let all = MemorySnapshots::new(x, vec![0.0, 0.1, 0.2]);
/// let some = Selection::new(&all, vec![0, 2]);
/// let mut y = faer::Mat::zeros(2, 2);
/// some.block(0..2, 0..2, y.as_mut())?;
/// assert_eq!((some.times(), y), ([0.0, 0.2].as_slice(), faer::mat![[1.0, 3.0], [4.0, 6.0]]));
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Clone)]
pub struct Selection<'a> {
    source: &'a dyn SnapshotSource,
    columns: Vec<usize>,
    times: Vec<f64>,
}

impl<'a> Selection<'a> {
    /// The snapshots of these numbers, counted from 0, in this order.
    ///
    /// # Panics
    /// If the source has no snapshot of one of these numbers.
    pub fn new(source: &'a dyn SnapshotSource, columns: Vec<usize>) -> Self {
        let times = columns.iter().map(|&column| source.times()[column]).collect();
        Self { source, columns, times }
    }
}

impl SnapshotSource for Selection<'_> {
    fn dim(&self) -> usize {
        self.source.dim()
    }

    fn times(&self) -> &[f64] {
        &self.times
    }

    fn block(
        &self,
        rows: Range<usize>,
        cols: Range<usize>,
        mut out: MatMut<'_, f64>,
    ) -> io::Result<()> {
        let mut done = 0;
        for run in self.columns[cols].chunk_by(|column, next| column + 1 == *next) {
            let neighbours = run[0]..run[0] + run.len();
            let part = out.as_mut().subcols_mut(done, run.len());
            self.source.block(rows.clone(), neighbours, part)?;
            done += run.len();
        }
        Ok(())
    }

    fn read_size(&self) -> usize {
        self.source.read_size()
    }
}

/// Numbers of the snapshots, from 0, that hold neither NaN nor infinity, found in one pass.
///
/// * `options`: threads and the limit on memory; nothing else of them counts
///
/// ```
/// use lumley_pod::{Execution, MemorySnapshots, Options, finite_snapshots};
/// let x = faer::mat![[1.0, f64::NAN, 3.0], [4.0, 5.0, 6.0]];
/// let x = MemorySnapshots::new(x, vec![0.0, 0.1, 0.2]);
/// let finite = finite_snapshots(&x, &Options::default(), Execution::default())?;
/// assert_eq!(finite, [0, 2]);
/// # Ok::<(), lumley_pod::PodError>(())
/// ```
///
/// # Errors
/// [`PodError::Empty`], [`PodError::Memory`], [`PodError::Medium`], or
/// [`PodError::Elsewhere`] with the failure of another rank.
pub fn finite_snapshots(
    x: &dyn SnapshotSource,
    options: &Options,
    execution: Execution<'_>,
) -> Result<Vec<usize>, PodError> {
    let (product, modes) = (Identity::new(x.dim()), MemoryModes::default());
    let Options { par, memory_limit, .. } = *options;
    // Not centred: one infinite entry would spoil its whole row.
    let truncation = Truncation::Modes(1); // none are made
    let as_they_are = Options { truncation, par, memory_limit, ..Options::default() };
    let ensemble = Ensemble::for_sums(x, &product, &as_they_are, 1);
    let ensemble = together(execution.ranks, ensemble)?;
    let part = |rows: Range<usize>| {
        let mut sum = Partial::zeros(x.times().len(), 0);
        ensemble.for_tiles(rows, &mut |tile| {
            for (bad, column) in sum.sums.iter_mut().zip(tile.x.as_ref().col_iter()) {
                *bad += column.iter().filter(|entry| !entry.is_finite()).count() as f64;
            }
            Ok(())
        })?;
        Ok(sum)
    };
    let bad = Run::new(&ensemble, execution, &modes).over_snapshots("finite", &part)?.sums;
    Ok((0..bad.len()).filter(|&snapshot| bad[snapshot] == 0.0).collect())
}
