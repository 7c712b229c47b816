use crate::Error;
use crate::model::{Frame, Model, Observer};
use faer::{Mat, MatRef};
use lumley_pod::{InnerProduct, SparseSpd};

/// Res (32) of a run that is under way.
pub(super) struct Comparison<'a> {
    frame: Frame,
    full: MatRef<'a, f64>,
    product: &'a SparseSpd,
    difference: Mat<f64>,
    error: f64,
    largest: f64,
}

impl<'a> Comparison<'a> {
    pub(super) fn new(frame: Frame, full: MatRef<'a, f64>, product: &'a SparseSpd) -> Self {
        let difference = Mat::zeros(full.nrows(), 1);
        let largest = norms(full, product).into_iter().fold(0.0, f64::max);
        Self { frame, full, product, difference, error: 0.0, largest }
    }

    pub(super) fn percent(&self) -> f64 {
        100.0 * self.error / self.largest
    }
}

impl<M: Model> Observer<M> for Comparison<'_> {
    fn observe(&mut self, model: &M, snapshot: usize) -> Result<(), Error> {
        if snapshot < self.full.ncols() {
            let column = self.difference.col_as_slice_mut(0);
            model.sample(&self.frame, column)?;
            for (v, u) in column.iter_mut().zip(self.full.col(snapshot).iter()) {
                *v -= u;
            }
            self.product.factor(0, self.difference.as_mut());
            self.error = self.error.max(self.difference.norm_l2());
        }
        Ok(())
    }
}

/// The norm of each column of `x` in `product`.
pub(super) fn norms(x: MatRef<'_, f64>, product: &dyn InnerProduct) -> Vec<f64> {
    let mut z = x.to_owned();
    product.factor(0, z.as_mut());
    z.col_iter().map(|column| column.norm_l2()).collect()
}
