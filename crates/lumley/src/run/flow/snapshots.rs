//! Numbers of recorded snapshots, a few of which are in memory at a time, and of their modes.

use crate::Error;
use crate::record::FrameReader;
use crate::run::grid_product;
use faer::{ColRef, Mat};
use lumley_fem::{DivergenceSquares, GridDivergence, UniformGrid};
use lumley_pod::{InnerProduct, ReducedBasis, SnapshotSource};

/// Snapshots in memory.
const COLUMNS: usize = 8;

/// Shows all snapshots, in order, a block of them at a time.
fn blocks(frame: &FrameReader, mut see: impl FnMut(Mat<f64>)) -> Result<(), Error> {
    let (rows, count) = (frame.dim(), frame.times().len());
    for first in (0..count).step_by(COLUMNS) {
        let last = count.min(first + COLUMNS);
        let mut x = Mat::zeros(rows, last - first);
        frame.read_block(0..rows, first..last, x.as_mut())?;
        see(x);
    }
    Ok(())
}

/// The largest norm of a snapshot in L2 of the grid.
pub(super) fn largest_norm(frame: &FrameReader, grid: &UniformGrid) -> Result<f64, Error> {
    let product = grid_product(grid, grid.dimension());
    let mut largest = 0.0_f64;
    blocks(frame, |mut x| {
        let factored = product.factor(0..x.nrows(), x.as_mut());
        factored.expect("the product of a grid reads no file");
        largest = x.col_iter().map(|column| column.norm_l2()).fold(largest, f64::max);
    })?;
    Ok(largest)
}

/// `||div u|| / ||grad u||` of all snapshots together; none where they have no gradient.
pub(super) fn divergence(frame: &FrameReader, at: &GridDivergence) -> Result<Option<f64>, Error> {
    let mut sum = DivergenceSquares::default();
    blocks(frame, |x| {
        sum = x.col_iter().map(|u| squares(u, at)).fold(sum, DivergenceSquares::plus);
    })?;
    Ok(sum.ratio())
}

/// The same of each mode.
pub(super) fn divergences(basis: &ReducedBasis, at: &GridDivergence) -> Vec<Option<f64>> {
    basis.modes.col_iter().map(|mode| squares(mode, at).ratio()).collect()
}

fn squares(field: ColRef<'_, f64>, at: &GridDivergence) -> DivergenceSquares {
    at.of(field.try_as_col_major().expect("columns of a matrix are contiguous").as_slice())
}
