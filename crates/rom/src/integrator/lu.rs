/// A dense LU factorisation with partial pivoting, in place: for the Jacobians of reduced models,
/// whose size is that of the state, about ten.
pub(crate) struct Lu {
    size: usize,
    /// Row by row: U above and on the diagonal, the unit lower L below.
    entries: Vec<f64>,
    /// Row that was exchanged with row k in step k.
    pivots: Vec<usize>,
}

impl Lu {
    pub fn new(size: usize) -> Self {
        Self { size, entries: vec![0.0; size * size], pivots: vec![0; size] }
    }

    /// The matrix, row by row, to be filled before [`factor`](Self::factor).
    pub fn matrix(&mut self) -> &mut [f64] {
        &mut self.entries
    }

    /// Replaces the matrix by its factors. A singular or non-finite one gives factors that are not
    /// finite, and so do its solutions.
    pub fn factor(&mut self) {
        let n = self.size;
        for k in 0..n {
            let mut pivot = k;
            for i in k + 1..n {
                if self.entries[i * n + k].abs() > self.entries[pivot * n + k].abs() {
                    pivot = i;
                }
            }
            self.pivots[k] = pivot;
            for j in 0..n {
                self.entries.swap(k * n + j, pivot * n + j);
            }
            let (top, below) = self.entries.split_at_mut((k + 1) * n);
            let top = &top[k * n..];
            for row in below.chunks_exact_mut(n) {
                row[k] /= top[k];
                for j in k + 1..n {
                    row[j] -= row[k] * top[j];
                }
            }
        }
    }

    /// Replaces `b` by the solution.
    pub fn solve(&self, b: &mut [f64]) {
        let n = self.size;
        for k in 0..n {
            b.swap(k, self.pivots[k]);
        }
        for i in 1..n {
            let known: f64 = (0..i).map(|j| self.entries[i * n + j] * b[j]).sum();
            b[i] -= known;
        }
        for i in (0..n).rev() {
            let known: f64 = (i + 1..n).map(|j| self.entries[i * n + j] * b[j]).sum();
            b[i] = (b[i] - known) / self.entries[i * n + i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A matrix with a zero on the diagonal, so that pivoting is needed, times a known vector.
    #[test]
    fn solves_what_needs_pivoting() {
        let matrix = [0.0, 2.0, -1.0, 3.0, 0.5, 4.0, -6.0, 1.0, 0.25];
        let x = [1.5, -2.0, 0.75];
        let mut lu = Lu::new(3);
        lu.matrix().copy_from_slice(&matrix);
        lu.factor();
        let mut b = [0, 1, 2].map(|i| (0..3).map(|j| matrix[3 * i + j] * x[j]).sum());
        lu.solve(&mut b);
        for (found, expected) in b.iter().zip(x) {
            assert!((found - expected).abs() < 1e-14, "{found} and {expected}");
        }
    }

    #[test]
    fn a_singular_matrix_shows_in_the_solution() {
        let mut lu = Lu::new(2);
        lu.matrix().copy_from_slice(&[1.0, 2.0, 2.0, 4.0]);
        lu.factor();
        let mut b = [1.0, 1.0];
        lu.solve(&mut b);
        assert!(b.iter().any(|v| !v.is_finite()), "{b:?}");
    }
}
