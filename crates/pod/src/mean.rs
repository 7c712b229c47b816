use crate::contiguous::{columns, columns_mut};
use faer::{MatMut, MatRef};

/// The time mean of some rows, in two parts: without the second, the rounding of a large mean
/// stays in every snapshot and is found as a steady mode.
#[derive(Default)]
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
            for (q, column) in weights.iter().zip(columns(x)) {
                for ((mean, x), origin) in mean.iter_mut().zip(column).zip(origin) {
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
    pub fn extend(&mut self, lower: Self) {
        self.field.extend(lower.field);
        self.remainder.extend(lower.remainder);
    }

    /// What a field on the same rows has over this mean.
    pub fn difference(&self, field: &[f64]) -> impl Iterator<Item = f64> {
        let parts = field.iter().zip(&self.field).zip(&self.remainder);
        parts.map(|((u, mean), remainder)| (u - mean) - remainder)
    }

    /// The mean of two sets of snapshots, the other of which has this share in it.
    pub fn mixed(&self, other: &[f64], share: f64) -> Vec<f64> {
        self.field
            .iter()
            .zip(self.difference(other))
            .map(|(mean, gap)| mean + share * gap)
            .collect()
    }

    /// Subtracts the mean from every column.
    pub fn subtract(&self, mut x: MatMut<'_, f64>) {
        subtract_from_columns(&self.field, x.as_mut());
        subtract_from_columns(&self.remainder, x);
    }
}

/// Subtracts one field from every column.
pub(crate) fn subtract_from_columns(field: &[f64], x: MatMut<'_, f64>) {
    for column in columns_mut(x) {
        column.iter_mut().zip(field).for_each(|(x, f)| *x -= f);
    }
}
