use crate::InnerProduct;
use crate::ensemble::subtract_from_columns;
use faer::{MatMut, MatRef};
use std::ops::Range;

/// The time mean of some rows, in two parts: without the second, the rounding of a large mean
/// stays in every snapshot and is found as a steady mode.
pub(crate) struct Mean {
    /// The mean, rounded.
    pub field: Vec<f64>,
    /// What rounding took away.
    remainder: Vec<f64>,
}

impl Mean {
    /// `<u> = u_0 + sum_j q_j (u_j - u_0)`: exact where the snapshots are constant. The same with
    /// the sum in the place of `u_0` leaves only errors relative to the fluctuation.
    pub fn new(x: MatRef<'_, f64>, weights: &[f64]) -> Self {
        let average_from = |origin: &[f64]| {
            let mut mean = vec![0.0; x.nrows()];
            for (q, column) in weights.iter().zip(x.col_iter()) {
                for ((mean, x), origin) in mean.iter_mut().zip(column.iter()).zip(origin) {
                    *mean += q * (x - origin);
                }
            }
            mean
        };
        let first: Vec<f64> = x.col(0).iter().copied().collect();
        let add = |(a, b): (&f64, f64)| a + b;
        let field: Vec<f64> = first.iter().zip(average_from(&first)).map(add).collect();
        let remainder = average_from(&field);
        Self { field, remainder }
    }

    /// This mean on the upper rows, another on the lower.
    pub fn above(mut self, lower: Self) -> Self {
        self.field.extend(lower.field);
        self.remainder.extend(lower.remainder);
        self
    }

    /// Subtracts the mean of these rows from every column.
    pub fn subtract(&self, rows: Range<usize>, mut x: MatMut<'_, f64>) {
        subtract_from_columns(&self.field[rows.clone()], x.as_mut());
        subtract_from_columns(&self.remainder[rows], x);
    }

    /// `sum_i W_ii <u_i>²`: the energy of errors of the size of the mean.
    pub fn amplified_energy(&self, product: &dyn InnerProduct) -> f64 {
        product.diagonal().iter().zip(&self.field).map(|(w, u)| w * u * u).sum()
    }
}
