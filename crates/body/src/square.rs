use std::ops::{Index, IndexMut};

/// A small dense square matrix, of one row and one column for each generalised coordinate.
///
/// ```
/// use lumley_body::Square;
/// let mut matrix = Square::zeros(2);
/// (matrix[(0, 1)], matrix[(1, 0)]) = (2.0, 4.0);
/// let mut x = [6.0, 8.0];
/// assert_eq!(matrix.solve(&mut x), Ok(()));
/// assert_eq!(x, [2.0, 3.0]);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Square {
    size: usize,
    entries: Vec<f64>,
}

/// A pivot of the inertia that is smaller than this part of its diagonal entry is round-off.
const ROUND_OFF: f64 = 1e-13;

impl Square {
    /// Of `size` rows and columns, all 0.
    pub fn zeros(size: usize) -> Self {
        Self { size, entries: vec![0.0; size * size] }
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Row `i`.
    pub fn row(&self, i: usize) -> &[f64] {
        &self.entries[i * self.size..(i + 1) * self.size]
    }

    pub(crate) fn clear(&mut self) {
        self.entries.fill(0.0);
    }

    /// Becomes `other`, of the same size.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.entries.copy_from_slice(&other.entries);
    }

    /// Makes row `i` that of the unit matrix.
    pub fn unit_row(&mut self, i: usize) {
        let size = self.size;
        self.entries[i * size..(i + 1) * size].fill(0.0);
        self[(i, i)] = 1.0;
    }

    /// Replaces `b` by the solution of `A x = b`; the matrix is lost. Gauss's elimination with partial
    /// pivoting; allocates nothing.
    ///
    /// # Errors
    /// The column in which no pivot was found: the matrix is singular or not finite.
    ///
    /// # Panics
    /// If `b` has another length than the matrix.
    pub fn solve(&mut self, b: &mut [f64]) -> Result<(), usize> {
        assert_eq!(b.len(), self.size, "one entry for each row");
        for k in 0..self.size {
            let row = self.pivot_row(k);
            let pivot = self[(row, k)];
            if pivot == 0.0 || !pivot.is_finite() {
                return Err(k);
            }
            self.swap_rows(k, row);
            b.swap(k, row);
            self.eliminate(k, b);
        }
        for k in (0..self.size).rev() {
            let known: f64 = (k + 1..self.size).map(|j| self[(k, j)] * b[j]).sum();
            b[k] = (b[k] - known) / self[(k, k)];
        }
        Ok(())
    }

    fn pivot_row(&self, k: usize) -> usize {
        let magnitude = |i: usize| self[(i, k)].abs();
        (k..self.size).max_by(|&i, &j| magnitude(i).total_cmp(&magnitude(j))).unwrap_or(k)
    }

    fn swap_rows(&mut self, a: usize, b: usize) {
        if a != b {
            for j in 0..self.size {
                self.entries.swap(a * self.size + j, b * self.size + j);
            }
        }
    }

    fn eliminate(&mut self, k: usize, b: &mut [f64]) {
        for i in k + 1..self.size {
            let factor = self[(i, k)] / self[(k, k)];
            if factor != 0.0 {
                for j in k + 1..self.size {
                    let above = self[(k, j)];
                    self[(i, j)] -= factor * above;
                }
                b[i] -= factor * b[k];
            }
        }
    }

    /// The first row in which a symmetric positive semidefinite matrix is singular. The verdict does not depend
    /// on the units of the coordinates.
    pub(crate) fn null_row(mut self) -> Option<usize> {
        let diagonal: Vec<f64> = (0..self.size).map(|k| self[(k, k)]).collect();
        let mut unused = vec![0.0; self.size];
        (0..self.size).find(|&k| {
            let null = self[(k, k)] <= ROUND_OFF * diagonal[k];
            if !null {
                self.eliminate(k, &mut unused);
            }
            null
        })
    }
}

impl Index<(usize, usize)> for Square {
    type Output = f64;

    fn index(&self, (i, j): (usize, usize)) -> &f64 {
        &self.entries[i * self.size + j]
    }
}

impl IndexMut<(usize, usize)> for Square {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut f64 {
        &mut self.entries[i * self.size + j]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(rows: [[f64; 3]; 3]) -> Square {
        Square { size: 3, entries: rows.concat() }
    }

    #[test]
    fn solves_with_row_exchanges() {
        let rows = [[0.0, 2.0, 1.0], [1.0, 1e-3, 0.0], [3.0, 1.0, 2.0]];
        let x = [1.0, -2.0, 0.5];
        let mut b = rows.map(|row| (0..3).map(|j| row[j] * x[j]).sum());
        assert_eq!(matrix(rows).solve(&mut b), Ok(()));
        assert!((0..3).all(|j| (b[j] - x[j]).abs() < 1e-15), "{b:?}");
    }

    #[test]
    fn singular_matrices_are_named_by_their_row_in_any_units() {
        let null_third = [[2.0, 1.0, 3.0], [1.0, 1.0, 2.0], [3.0, 2.0, 5.0]];
        let twice = [[2.0, 0.0, 0.0], [0.0, 1.0, 2.0], [0.0, 2.0, 4.0]];
        assert_eq!(matrix(twice).solve(&mut [1.0; 3]), Err(2));
        for unit in [1e-6, 1.0, 1e6] {
            let scale = [1.0, unit, 1.0];
            let scaled = |i: usize, j: usize| null_third[i][j] * scale[i] * scale[j];
            let rows = [0, 1, 2].map(|i| [0, 1, 2].map(|j| scaled(i, j)));
            assert_eq!(matrix(rows).null_row(), Some(2));
            let mut regular = rows;
            regular[2][2] += 1e-6;
            assert_eq!(matrix(regular).null_row(), None);
        }
        assert_eq!(matrix([[f64::NAN; 3]; 3]).solve(&mut [1.0; 3]), Err(0));
    }
}
