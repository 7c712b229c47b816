//! The correlation of the snapshots in time: the work that grows with n M².

use crate::contiguous::{columns, columns_mut};
use crate::inner_product::support;
use crate::kernel::{add_gram, solve_right};
use crate::partial::Partial;
use crate::partition::Partition;
use crate::run::Run;
use crate::{InnerProduct, PodError};
use faer::{Mat, MatMut, MatRef};
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

impl Preconditioner {
    fn apply(&self, z: MatRef<'_, f64>, mut y: MatMut<'_, f64>) {
        for (&from, to) in self.order.iter().zip(columns_mut(y.as_mut())) {
            columns(z.subcols(from, 1)).for_each(|from| to.copy_from_slice(from));
        }
        solve_right(y, self.unit.as_ref());
    }
}

/// One pass over the snapshots; with a preconditioner, `Yᵀ Y` of the columns that it makes.
pub(crate) fn correlation(
    run: &Run<'_>,
    name: &'static str,
    preconditioner: Option<&Preconditioner>,
) -> Result<Correlation, PodError> {
    let (ensemble, (_, m)) = (run.ensemble, run.ensemble.shape());
    let part = |rows: Range<usize>| {
        let mut sum = Partial::zeros(m * m + 1, 0);
        let block = ensemble.partition.block();
        let mut y = Mat::zeros(if preconditioner.is_some() { block } else { 0 }, m);
        ensemble.for_tiles(rows.clone(), &mut |mut tile| {
            if let Some(mean) = &tile.mean {
                sum.sums[m * m] += energy(ensemble.product, &tile.rows, &mean.field)?;
            }
            ensemble.product.factor(tile.rows.clone(), tile.x.as_mut())?;
            for rows in Partition::pieces(0..tile.rows.len(), block) {
                let z = tile.x.as_ref().subrows(rows.start, rows.len());
                match preconditioner {
                    None => add_gram(sum.matrix_mut(m, m), z),
                    Some(preconditioner) => {
                        let mut y = y.subrows_mut(0, rows.len());
                        preconditioner.apply(z, y.as_mut());
                        add_gram(sum.matrix_mut(m, m), y.as_ref());
                    }
                }
            }
            Ok(())
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

/// Completes a symmetric matrix from its lower triangle.
pub(crate) fn mirror(c: &mut Mat<f64>) {
    for j in 0..c.ncols() {
        for i in 0..j {
            c[(i, j)] = c[(j, i)];
        }
    }
}
