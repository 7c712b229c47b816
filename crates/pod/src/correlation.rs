//! The correlation of the snapshots in time: the work that grows with n M².

use crate::inner_product::support;
use crate::kernel::{add_gram, solve_right};
use crate::partial::Partial;
use crate::run::Run;
use crate::{InnerProduct, PodError};
use faer::{Mat, MatRef};
use std::ops::Range;

/// `Zᵀ Z` with `Z = F X`, in full, and the energy of the mean that was subtracted.
pub(crate) struct Correlation {
    pub matrix: Mat<f64>,
    pub steady: f64,
}

/// New columns `Y = Z P U⁻¹`, formed block by block and never stored.
pub(crate) struct Preconditioner {
    /// Column k of `Z P` is column `order[k]` of Z.
    pub order: Vec<usize>,
    /// U, unit upper triangular.
    pub unit: Mat<f64>,
}

/// One pass over the snapshots; with a preconditioner, `Yᵀ Y` of the columns that it makes.
pub(crate) fn correlation(
    run: &Run<'_>,
    name: &'static str,
    preconditioner: Option<&Preconditioner>,
) -> Result<Correlation, PodError> {
    let (ensemble, (_, m)) = (run.ensemble, run.ensemble.shape());
    let order = preconditioner.map_or(&ensemble.every, |preconditioner| &preconditioner.order);
    let part = |rows: Range<usize>| {
        let mut sum = Partial::zeros(m * m + 1, 0);
        ensemble.for_tiles(rows.clone(), &mut |mut tile| {
            if let Some(mean) = &tile.mean {
                for piece in tile.pieces(ensemble) {
                    let field = &mean[piece.start - tile.rows.start..];
                    sum.sums[m * m] += energy(ensemble.product, &piece, field)?;
                }
            }
            tile.for_blocks(ensemble, order, &mut |_, mut z| {
                if let Some(preconditioner) = preconditioner {
                    solve_right(z.as_mut(), preconditioner.unit.as_ref());
                }
                add_gram(sum.matrix_mut(m, m), z.as_ref());
            })
        })?;
        // An entry that is not finite makes the square of its column so: no need to look at each.
        let finite = (0..m).all(|j| sum.sums[j * m + j].is_finite());
        if finite { Ok(sum) } else { Err(ensemble.not_finite(rows)) }
    };
    let sum = run.over_snapshots(name, &part)?;
    let mut matrix = sum.matrix(m, m).to_owned();
    mirror(&mut matrix);
    Ok(Correlation { matrix, steady: sum.sums[m * m] })
}

/// `|F u|²` of the rows of a field that is given on them and on what they reach.
fn energy(product: &dyn InnerProduct, rows: &Range<usize>, field: &[f64]) -> Result<f64, PodError> {
    let mut u = Mat::from_fn(support(product, rows).len(), 1, |i, _| field[i]);
    product.factor(rows.clone(), u.as_mut())?;
    Ok(u.subrows(0, rows.len()).squared_norm_l2())
}

/// `Zᵀ Z` of few rows, in full.
pub(crate) fn gram(z: MatRef<'_, f64>) -> Mat<f64> {
    let mut g = Mat::zeros(z.ncols(), z.ncols());
    add_gram(g.as_mut(), z);
    mirror(&mut g);
    g
}

/// Completes a symmetric matrix from its lower triangle.
pub(crate) fn mirror(c: &mut Mat<f64>) {
    for j in 0..c.ncols() {
        for i in 0..j {
            c[(i, j)] = c[(j, i)];
        }
    }
}
