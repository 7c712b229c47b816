use faer::{Mat, MatRef};

/// The factor of a Gram matrix with pivoting, `Pᵀ G P = Uᵀ D² U` for the columns that it can tell apart.
///
/// `G = Xᵀ X` is known to `eps |x_i| |x_j|`, entry by entry. The columns of X enter in the order of
/// what of them the earlier ones have not explained; one of which less than `floor` is left is
/// unresolved: the remainder is round-off. Pivoting keeps the entries of U below one in magnitude and its condition
/// small, also where G itself has none to speak of.
pub(crate) struct PivotedCholesky {
    /// Column k of `X P` is column `order[k]` of X; the unresolved ones are the last.
    pub order: Vec<usize>,
    /// Number of columns that are resolved.
    pub resolved: usize,
    /// U, unit upper triangular; unresolved columns stand in it as far as the others explain them.
    pub unit: Mat<f64>,
    /// `D_kk`, the norm of what is new in column k; one for each that is resolved.
    pub scale: Vec<f64>,
}

impl PivotedCholesky {
    /// * `g`: symmetric positive semidefinite up to round-off, m x m
    /// * `floor`: share of the square of a column's norm under which its remainder is round-off
    pub fn new(g: MatRef<'_, f64>, floor: f64) -> Self {
        let m = g.nrows();
        let norms: Vec<f64> = (0..m).map(|j| g[(j, j)]).collect();
        let mut left = norms.clone();
        let mut open: Vec<usize> = (0..m).collect();
        // Rows of D U, one after the other, in the order of the original columns.
        let (mut rows, mut order, mut scale) = (Vec::<Vec<f64>>::new(), Vec::new(), Vec::new());
        loop {
            open.retain(|&j| left[j] > floor * norms[j] && left[j] >= f64::MIN_POSITIVE);
            let Some(&pivot) = open.iter().reduce(|a, b| if left[*b] > left[*a] { b } else { a })
            else {
                break;
            };
            let row = next_row(g, &rows, pivot, left[pivot].sqrt());
            left.iter_mut().zip(&row).for_each(|(left, r)| *left -= r * r);
            scale.push(row[pivot]);
            order.push(pivot);
            open.retain(|&j| j != pivot);
            rows.push(row);
        }
        let resolved = order.len();
        let mut is_resolved = vec![false; m];
        for &j in &order {
            is_resolved[j] = true;
        }
        order.extend((0..m).filter(|&j| !is_resolved[j]));
        let unit = Mat::from_fn(m, m, |i, k| match rows.get(i) {
            Some(row) if i < k => row[order[k]] / scale[i],
            _ => f64::from(u8::from(i == k)),
        });
        Self { order, resolved, unit, scale }
    }

    /// `D U`, m x m, whose columns are those of `X P`; rows of what is unresolved are zero.
    pub fn factor(&self) -> Mat<f64> {
        let m = self.order.len();
        let scale = |i: usize| self.scale.get(i).copied().unwrap_or(0.0);
        Mat::from_fn(m, m, |i, k| scale(i) * self.unit[(i, k)])
    }
}

/// Row `pivot` of what is left of G, divided by the root of its diagonal.
fn next_row(g: MatRef<'_, f64>, rows: &[Vec<f64>], pivot: usize, root: f64) -> Vec<f64> {
    let mut row: Vec<f64> = g.col(pivot).iter().copied().collect();
    for before in rows {
        let by = before[pivot];
        row.iter_mut().zip(before).for_each(|(r, b)| *r -= by * b);
    }
    for r in &mut row {
        *r /= root;
    }
    row[pivot] = root;
    row
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `G = Pᵀ Uᵀ D² U P` for columns of very different size, which are all resolved.
    #[test]
    fn graded_columns_are_all_resolved() {
        let x = Mat::from_fn(40, 6, |i, j| {
            (0.1 * (i * (j + 2)) as f64).sin() * [1.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15][j]
        });
        let g = x.transpose() * &x;
        let f = PivotedCholesky::new(g.as_ref(), 1e-14);
        assert_eq!((f.resolved, f.order.as_slice()), (6, &[0, 1, 2, 3, 4, 5][..]));
        let again = f.factor().transpose() * f.factor();
        for j in 0..6 {
            for i in 0..6 {
                let defect = (again[(i, j)] - g[(i, j)]).abs();
                assert!(defect <= 1e-14 * (g[(i, i)] * g[(j, j)]).sqrt(), "({i}, {j})");
            }
        }
    }

    #[test]
    fn dependent_and_empty_columns_come_last() {
        let mut x = Mat::from_fn(30, 5, |i, j| ((i * (j + 1)) as f64).cos());
        let twice = &x.col(1).to_owned() * faer::Scale(2.0);
        x.col_mut(3).copy_from(&twice);
        x.col_mut(0).fill(0.0);
        let g = x.transpose() * &x;
        let f = PivotedCholesky::new(g.as_ref(), 1e-13);
        assert_eq!(f.resolved, 3);
        assert_eq!(f.order[3..], [0, 1]);
        // Column 1 is half of column 3, which came first as the larger of the two.
        let explained = f.order.iter().position(|&j| j == 3).expect("it is resolved");
        assert!((f.unit[(explained, 4)] - 0.5).abs() < 1e-14);
        assert!((0..5).all(|i| (0..i).all(|j| f.unit[(i, j)] == 0.0)));
    }

    #[test]
    fn nothing_is_resolved_in_nothing() {
        let f = PivotedCholesky::new(Mat::<f64>::zeros(3, 3).as_ref(), 1e-14);
        assert_eq!((f.resolved, f.factor().norm_max()), (0, 0.0));
    }
}
