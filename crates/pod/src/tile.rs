//! The snapshots as they are read: tile by tile, and weighted block by block.

use crate::PodError;
use crate::ensemble::Ensemble;
use crate::inner_product::{reach_of, support};
use crate::mean::Mean;
use crate::partition::Partition;
use faer::{Mat, MatMut, MatRef};
use std::ops::Range;
use std::sync::PoisonError;

/// Some rows of the snapshots.
pub(crate) struct Tile<'t> {
    pub rows: Range<usize>,
    /// These rows and those after them that the inner product reaches, centred and weighted in time.
    pub x: MatRef<'t, f64>,
    /// Their mean, where it was subtracted.
    pub mean: Option<Vec<f64>>,
    /// Where some of the rows are weighted.
    scratch: MatMut<'t, f64>,
}

/// What a thread reads into and weighs in.
pub(crate) struct Workspace {
    tile: Mat<f64>,
    scratch: Mat<f64>,
}

impl Default for Workspace {
    fn default() -> Self {
        Self { tile: Mat::new(), scratch: Mat::new() }
    }
}

impl Ensemble<'_> {
    /// Reads `rows` tile by tile.
    pub fn for_tiles(
        &self,
        rows: Range<usize>,
        visit: &mut dyn FnMut(Tile<'_>) -> Result<(), PodError>,
    ) -> Result<(), PodError> {
        let kept = self.workspaces.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let Workspace { mut tile, mut scratch } = kept.unwrap_or_default();
        let (m, reach) = (self.scale.len(), reach_of(self.product));
        grow(&mut scratch, self.partition.piece(reach).min(rows.len()) + reach, m);
        let view = self.source.view().filter(|_| self.is_plain());
        let visited = Partition::pieces(rows, self.plan.tile).try_for_each(|rows| {
            let support = support(self.product, &rows);
            let scratch = scratch.as_mut();
            if let Some(x) = view {
                let x = x.subrows(support.start, support.len());
                return visit(Tile { rows, x, mean: None, scratch });
            }
            grow(&mut tile, support.len(), m);
            let mut x = tile.subrows_mut(0, support.len());
            let mean = self.read(support, x.as_mut())?;
            visit(Tile { rows, x: x.as_ref(), mean, scratch })
        });
        let workspace = Workspace { tile, scratch };
        self.workspaces.lock().unwrap_or_else(PoisonError::into_inner).push(workspace);
        visited
    }

    /// Whether the algorithms see the snapshots as their source holds them.
    fn is_plain(&self) -> bool {
        !self.options.center && self.options.time_weights.is_none() && self.previous.is_none()
    }

    /// Reads rows of all snapshots, centred and weighted in time.
    fn read(
        &self,
        rows: Range<usize>,
        mut out: MatMut<'_, f64>,
    ) -> Result<Option<Vec<f64>>, PodError> {
        let (columns, m) = (self.scale.len(), self.time_weights.len());
        let mut x = out.as_mut().subcols_mut(columns - m, m);
        self.source.block(rows.clone(), 0..m, x.as_mut())?;
        let mean = self.options.center.then(|| Mean::new(x.as_ref(), &self.time_weights));
        self.prepare(mean.as_ref(), columns - m..columns, x);
        match self.previous {
            None => Ok(mean.map(|mean| mean.field)),
            Some(previous) => Ok(previous.read(rows, mean, out.subcols_mut(0, columns - m))?),
        }
    }
}

impl<'t> Tile<'t> {
    /// Its rows in pieces to be weighted at a time. They are whole blocks: sums are taken block by block,
    /// as a tile depends on the memory that may be taken and sums must not.
    pub fn pieces(&self, ensemble: &Ensemble<'_>) -> impl Iterator<Item = Range<usize>> + use<> {
        let size = ensemble.partition.piece(reach_of(ensemble.product));
        Partition::pieces(self.rows.clone(), size)
    }

    /// The snapshots on a piece and on the rows after it that the inner product reaches.
    pub fn on(&self, ensemble: &Ensemble<'_>, piece: &Range<usize>) -> MatRef<'t, f64> {
        let rows = support(ensemble.product, piece);
        self.x.subrows(rows.start - self.rows.start, rows.len())
    }

    /// Some columns of `F X` on a piece, in this order.
    pub fn weighted(
        &mut self,
        ensemble: &Ensemble<'_>,
        piece: &Range<usize>,
        columns: &[usize],
    ) -> Result<MatMut<'_, f64>, PodError> {
        let x = self.on(ensemble, piece);
        let mut z = self.scratch.as_mut().submatrix_mut(0, 0, x.nrows(), columns.len());
        ensemble.product.factor_columns(piece.clone(), x, columns, z.as_mut())?;
        Ok(z.subrows_mut(0, piece.len()))
    }

    /// Gives `visit` some columns of `F X`, in this order, block by block.
    ///
    /// * `visit`: takes the number of the first row of a block, and the block
    pub fn for_blocks(
        &mut self,
        ensemble: &Ensemble<'_>,
        columns: &[usize],
        visit: &mut dyn FnMut(usize, MatMut<'_, f64>),
    ) -> Result<(), PodError> {
        for piece in self.pieces(ensemble) {
            let mut z = self.weighted(ensemble, &piece, columns)?;
            for rows in Partition::pieces(0..piece.len(), ensemble.partition.block()) {
                visit(piece.start + rows.start, z.as_mut().subrows_mut(rows.start, rows.len()));
            }
        }
        Ok(())
    }
}

/// Gives a matrix that is written before it is read at least so many rows.
fn grow(buffer: &mut Mat<f64>, rows: usize, columns: usize) {
    if buffer.nrows() < rows {
        *buffer = Mat::zeros(rows, columns);
    }
}
