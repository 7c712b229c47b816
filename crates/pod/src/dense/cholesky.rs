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
        let floors: Vec<f64> = (0..g.nrows()).map(|j| floor * g[(j, j)]).collect();
        Self::with_floors(g, &floors, 0)
    }

    /// The same with a floor for the square of what is left of each column.
    ///
    /// * `first`: number of columns that enter before the others, in the order that they have; were one
    ///   of them not resolved, none after it would be
    pub fn with_floors(g: MatRef<'_, f64>, floors: &[f64], first: usize) -> Self {
        let m = g.nrows();
        let mut elimination = Elimination {
            rows: Vec::with_capacity(m),
            order: (0..m).collect(),
            left: (0..m).map(|j| g[(j, j)]).collect(),
            open: m,
        };
        while let Some(pivot) = elimination.pivot(floors, first) {
            elimination.eliminate(g, pivot);
        }
        let Elimination { rows, order, .. } = elimination;
        let scale: Vec<f64> = rows.iter().map(|row| row[0]).collect();
        let unit = Mat::from_fn(m, m, |i, k| match rows.get(i) {
            Some(row) if i < k => row[k - i] / scale[i],
            _ => f64::from(u8::from(i == k)),
        });
        Self { order, resolved: scale.len(), unit, scale }
    }

    /// `D U`, m x m, whose columns are those of `X P`; rows of what is unresolved are zero.
    pub fn factor(&self) -> Mat<f64> {
        let m = self.order.len();
        let scale = |i: usize| self.scale.get(i).copied().unwrap_or(0.0);
        Mat::from_fn(m, m, |i, k| scale(i) * self.unit[(i, k)])
    }
}

/// A factorisation under way: places in the new order are resolved, then open, then unresolved.
struct Elimination {
    /// Row i of `D U` from its diagonal on.
    rows: Vec<Vec<f64>>,
    /// The column at each place.
    order: Vec<usize>,
    /// Square of what is left of the column at each place.
    left: Vec<f64>,
    /// End of the open places.
    open: usize,
}

impl Elimination {
    /// The place of the column that enters next; those that have become unresolved go to the end.
    fn pivot(&mut self, floors: &[f64], first: usize) -> Option<usize> {
        let next = self.rows.len();
        for place in (next..self.open).rev() {
            let left = self.left[place];
            if left <= floors[self.order[place]] || left < f64::MIN_POSITIVE || left.is_nan() {
                self.open -= 1;
                self.exchange(place, self.open);
            }
        }
        let mut open = next..self.open;
        if next < first {
            return open.find(|&place| self.order[place] == next);
        }
        open.reduce(|a, b| if self.left[b] > self.left[a] { b } else { a })
    }

    fn exchange(&mut self, a: usize, b: usize) {
        self.order.swap(a, b);
        self.left.swap(a, b);
        for (i, row) in self.rows.iter_mut().enumerate() {
            row.swap(a - i, b - i);
        }
    }

    /// The row of what is left of G at the pivot, divided by the root of its diagonal.
    fn eliminate(&mut self, g: MatRef<'_, f64>, pivot: usize) {
        let next = self.rows.len();
        self.exchange(next, pivot);
        let column = g.col(self.order[next]);
        let mut row: Vec<f64> = self.order[next..].iter().map(|&j| column[j]).collect();
        let before: Vec<&[f64]> =
            self.rows.iter().enumerate().map(|(i, row)| &row[next - i..]).collect();
        // By fours, as each number is then loaded and stored a quarter as often.
        let (fours, rest) = before.as_chunks::<4>();
        for [a, b, c, d] in fours {
            let by = [a[0], b[0], c[0], d[0]];
            for (r, (((a, b), c), d)) in row.iter_mut().zip(a.iter().zip(*b).zip(*c).zip(*d)) {
                *r -= by[0] * a + by[1] * b + by[2] * c + by[3] * d;
            }
        }
        for before in rest {
            row.iter_mut().zip(*before).for_each(|(r, b)| *r -= before[0] * b);
        }
        let root = self.left[next].sqrt();
        for r in &mut row {
            *r /= root;
        }
        row[0] = root;
        self.left[next..].iter_mut().zip(&row).for_each(|(left, r)| *left -= r * r);
        self.rows.push(row);
    }
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
        assert!(f.order[3..] == [0, 1] || f.order[3..] == [1, 0], "{:?}", f.order);
        // Column 1 is half of column 3, which came first as the larger of the two.
        let explained = f.order.iter().position(|&j| j == 3).expect("it is resolved");
        let half = f.order.iter().position(|&j| j == 1).expect("it comes last");
        assert!((f.unit[(explained, half)] - 0.5).abs() < 1e-14);
        assert!((0..5).all(|i| (0..i).all(|j| f.unit[(i, j)] == 0.0)));
    }

    #[test]
    fn nothing_is_resolved_in_nothing() {
        let f = PivotedCholesky::new(Mat::<f64>::zeros(3, 3).as_ref(), 1e-14);
        assert_eq!((f.resolved, f.factor().norm_max()), (0, 0.0));
    }
}
