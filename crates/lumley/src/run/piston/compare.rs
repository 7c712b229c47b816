use crate::Error;
use crate::model::{Frame, Model, Observer, Stop};
use crate::run::Work;
use faer::Mat;
use lumley_pod::{InnerProduct, Kronecker};

/// Res (32) of a run that is under way.
pub(super) struct Comparison<'a> {
    frame: Frame,
    full: &'a Snapshots,
    product: &'a Kronecker,
    difference: Mat<f64>,
    error: f64,
}

impl<'a> Comparison<'a> {
    pub(super) fn new(full: &'a Snapshots, frame: Frame, product: &'a Kronecker) -> Self {
        let difference = Mat::zeros(full.velocities.nrows(), 1);
        Self { frame, full, product, difference, error: 0.0 }
    }

    pub(super) fn percent(&self) -> f64 {
        100.0 * self.error / self.full.largest
    }
}

impl<M: Model> Observer<M> for Comparison<'_> {
    fn observe(&mut self, model: &M, stop: Stop, _: &Work) -> Result<(), Error> {
        if stop.number < self.full.velocities.ncols() {
            let column = self.difference.col_as_slice_mut(0);
            model.sample(&self.frame, column)?;
            for (v, u) in column.iter_mut().zip(self.full.velocities.col(stop.number).iter()) {
                *v -= u;
            }
            weighted(self.product, &mut self.difference);
            self.error = self.error.max(self.difference.norm_l2());
        }
        Ok(())
    }
}

/// The full-order model on the fixed grid, its snapshots in columns, and the largest norm among them.
pub(super) struct Snapshots {
    pub velocities: Mat<f64>,
    pub largest: f64,
}

impl Snapshots {
    pub(super) fn new(velocities: Mat<f64>, product: &Kronecker) -> Self {
        let mut z = velocities.clone();
        weighted(product, &mut z);
        let largest = z.col_iter().map(|column| column.norm_l2()).fold(0.0, f64::max);
        Self { velocities, largest }
    }
}

/// Columns x become `F x`, whose norms are those of the product.
fn weighted(product: &Kronecker, x: &mut Mat<f64>) {
    let factored = product.factor(0..x.nrows(), x.as_mut());
    factored.expect("the product of a grid reads no file");
}
