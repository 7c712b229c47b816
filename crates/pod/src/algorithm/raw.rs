//! Columns that are nearly modes, as they come out of the snapshots.

use crate::correlation::mirror;
use crate::ensemble::Ensemble;
use crate::kernel::add_gram;
use crate::partial::Partial;
use crate::partition::Partition;
use crate::run::Run;
use crate::tile::Tile;
use crate::{ModeStore, PodError};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatMut, MatRef, Par};
use std::ops::Range;

/// How the columns come out of the snapshots.
pub(crate) struct Lift<'a> {
    /// M x k: the columns are X times this.
    pub to_modes: MatRef<'a, f64>,
    /// k x M: the columns times this are what they hold of the snapshots.
    pub coefficients: MatRef<'a, f64>,
    /// Whether to measure what that leaves of each snapshot.
    pub measured: bool,
}

/// Stored columns, as far as they are known without reading them.
pub(crate) struct Columns {
    /// Their Gram matrix in the inner product.
    pub gram: Mat<f64>,
    /// Of each an entry of largest magnitude.
    pub extremes: Vec<f64>,
}

/// Squares of the norms of what the modes leave of each snapshot, and of the snapshot itself; empty
/// unless asked for.
#[derive(Debug, Clone, Default)]
pub(crate) struct Residual {
    pub left: Vec<f64>,
    pub whole: Vec<f64>,
}

pub(crate) struct RawModes {
    pub columns: Columns,
    pub residual: Residual,
}

/// One pass over the snapshots: stores the columns, and the mean behind them where it is subtracted.
pub(crate) fn raw_modes(run: &Run<'_>, lift: &Lift<'_>) -> Result<RawModes, PodError> {
    let (n, m) = run.ensemble.shape();
    let (kept, options) = (lift.to_modes.ncols(), run.ensemble.options);
    run.all_or_none(run.modes.reserve(n, kept + usize::from(options.center)))?;
    let residuals = if lift.measured { m } else { 0 };
    let (ensemble, modes) = (run.ensemble, run.modes);
    let part = |rows: Range<usize>| {
        let mut sum = Partial::zeros(kept * kept + 2 * residuals, kept);
        ensemble.for_tiles(rows, &mut |tile| lift.tile(ensemble, modes, tile, &mut sum))?;
        Ok(sum)
    };
    let sum = run.over_snapshots("modes", &part)?;
    let (left, whole) = sum.sums[kept * kept..].split_at(residuals);
    let residual = Residual { left: left.to_vec(), whole: whole.to_vec() };
    Ok(RawModes { columns: Columns::of(&sum, kept), residual })
}

impl Columns {
    /// * `sum`: of the entries and the products of so many columns
    pub fn of(sum: &Partial, count: usize) -> Self {
        let mut gram = sum.matrix(count, count).to_owned();
        mirror(&mut gram);
        Self { gram, extremes: sum.extremes.clone() }
    }
}

impl Lift<'_> {
    fn tile(
        &self,
        ensemble: &Ensemble<'_>,
        modes: &dyn ModeStore,
        mut tile: Tile<'_>,
        sum: &mut Partial,
    ) -> Result<(), PodError> {
        let (kept, first) = (self.to_modes.ncols(), tile.rows.start);
        let mut columns = Mat::zeros(tile.rows.len(), kept + usize::from(tile.mean.is_some()));
        for piece in tile.pieces(ensemble) {
            let mean = tile.mean.as_ref().map(|mean| &mean[piece.start - first..]);
            let mut own = self.columns(ensemble, tile.on(ensemble, &piece), mean);
            let raw = own.subrows(0, piece.len());
            columns.subrows_mut(piece.start - first, piece.len()).copy_from(raw);
            sum.add_extremes(raw.subcols(0, kept));
            ensemble.product.factor(piece.clone(), own.as_mut())?;
            let measured = self.measured.then_some(&ensemble.every);
            let mut z = measured.map(|all| tile.weighted(ensemble, &piece, all)).transpose()?;
            for rows in Partition::pieces(0..piece.len(), ensemble.partition.block()) {
                let weighted = own.subrows(rows.start, rows.len());
                add_gram(sum.matrix_mut(kept, kept), weighted.subcols(0, kept));
                if let Some(z) = &mut z {
                    let z = z.as_mut().subrows_mut(rows.start, rows.len());
                    self.add_residuals(&mut sum.sums[kept * kept..], &ensemble.scale, weighted, z);
                }
            }
        }
        Ok(modes.write(tile.rows, columns.as_ref())?)
    }

    /// Rows of the columns, and of the mean behind them where it was subtracted.
    fn columns(
        &self,
        ensemble: &Ensemble<'_>,
        x: MatRef<'_, f64>,
        mean: Option<&[f64]>,
    ) -> Mat<f64> {
        let kept = self.to_modes.ncols();
        let mut columns = Mat::zeros(x.nrows(), kept + usize::from(mean.is_some()));
        // Block by block: how a product is taken depends on its shape.
        for rows in Partition::pieces(0..x.nrows(), ensemble.partition.block()) {
            let x = x.subrows(rows.start, rows.len());
            let to = columns.get_mut(rows, ..kept);
            matmul(to, Accum::Replace, x, self.to_modes, 1.0, Par::Seq);
        }
        if let Some(mean) = mean {
            columns.col_mut(kept).iter_mut().zip(mean).for_each(|(to, u)| *to = *u);
        }
        columns
    }

    /// * `weighted`: F times the columns, and the mean behind them where it was subtracted
    /// * `z`: F times the snapshots as they were decomposed
    fn add_residuals(
        &self,
        sums: &mut [f64],
        scale: &[f64],
        weighted: MatRef<'_, f64>,
        mut z: MatMut<'_, f64>,
    ) {
        let (kept, m) = (self.to_modes.ncols(), z.ncols());
        let (left, whole) = sums.split_at_mut(m);
        let mean = (weighted.ncols() > kept).then(|| weighted.col(kept));
        for ((sum, column), s) in whole.iter_mut().zip(z.as_ref().col_iter()).zip(scale) {
            *sum += match mean {
                None => column.squared_norm_l2(),
                Some(mean) => {
                    column.iter().zip(mean.iter()).map(|(z, u)| (z + s * u).powi(2)).sum()
                }
            };
        }
        let held = weighted.subcols(0, kept);
        matmul(z.as_mut(), Accum::Add, held, self.coefficients, -1.0, Par::Seq);
        for (sum, column) in left.iter_mut().zip(z.as_ref().col_iter()) {
            *sum += column.squared_norm_l2();
        }
    }
}
