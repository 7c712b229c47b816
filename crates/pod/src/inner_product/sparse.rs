use super::cholesky::cholesky;
use super::{InnerProduct, InnerProductError, Reach};
use faer::MatMut;
use faer::sparse::{CreationError, SparseColMat, Triplet};
use std::io;
use std::ops::Range;

/// A sparse symmetric positive definite W, such as a finite-element mass matrix.
///
/// `W = Fᵀ F` with `F = Lᵀ P`: L is the sparse Cholesky factor of the matrix in a fill-reducing
/// order P. Rows are coupled, so that only whole columns have a product. Cost of each operation:
/// the stored entries of W, or of L, for each column.
///
/// ```
/// use lumley_pod::{InnerProduct, SparseSpd};
/// // The mass matrix of one linear element of length 6.
/// let w = SparseSpd::from_triplets(2, &[(0, 0, 2.0), (0, 1, 1.0), (1, 0, 1.0), (1, 1, 2.0)])?;
/// let mut x = faer::mat![[1.0], [1.0]];
/// w.apply(x.as_mut())?;
/// assert_eq!(x, faer::mat![[3.0], [3.0]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct SparseSpd {
    matrix: SparseColMat<usize, f64>,
    /// L, each column starting with its diagonal.
    lower: SparseColMat<usize, f64>,
    /// `(P x)_i = x[order[i]]`.
    order: Vec<usize>,
}

impl SparseSpd {
    /// The product with this matrix, both of its triangles stored.
    ///
    /// # Errors
    /// [`InnerProductError`]: not square, not finite, not symmetric, not positive definite.
    pub fn new(matrix: SparseColMat<usize, f64>) -> Result<Self, InnerProductError> {
        check_symmetric(&matrix)?;
        let (lower, order) = cholesky(&matrix)?;
        Ok(Self { matrix, lower, order })
    }

    /// The product with the `size` x `size` matrix of these `(row, column, value)`, counted from
    /// 0; values in the same place are added, as in assembly.
    ///
    /// # Errors
    /// [`InnerProductError::Outside`], and those of [`new`](Self::new).
    pub fn from_triplets(
        size: usize,
        entries: &[(usize, usize, f64)],
    ) -> Result<Self, InnerProductError> {
        let triplets: Vec<_> = entries.iter().map(|&(i, j, v)| Triplet::new(i, j, v)).collect();
        let matrix = SparseColMat::try_new_from_triplets(size, size, &triplets);
        Self::new(matrix.map_err(|error| match error {
            CreationError::OutOfBounds { row, col } => {
                InnerProductError::Outside { row, column: col, size }
            }
            CreationError::Generic(_) => InnerProductError::Memory { size },
        })?)
    }

    /// Replaces each column, which `f` computes from the old one.
    fn by_column(&self, mut x: MatMut<'_, f64>, f: impl Fn(&[f64], &mut [f64])) {
        assert_eq!(x.nrows(), self.dim(), "a product that couples all rows needs whole columns");
        let mut new = vec![0.0; self.dim()];
        for column in x.as_mut().col_iter_mut() {
            let old: Vec<f64> = column.as_ref().iter().copied().collect();
            f(&old, &mut new);
            column.iter_mut().zip(&new).for_each(|(x, &new)| *x = new);
        }
    }
}

impl InnerProduct for SparseSpd {
    fn dim(&self) -> usize {
        self.matrix.nrows()
    }

    fn reach(&self) -> Reach {
        Reach::All
    }

    fn diagonal(&self) -> io::Result<Vec<f64>> {
        let at = |i| self.matrix.get(i, i).copied().unwrap_or(0.0);
        Ok((0..self.dim()).map(at).collect())
    }

    fn apply(&self, x: MatMut<'_, f64>) -> io::Result<()> {
        self.by_column(x, |old, new| {
            for (j, new) in new.iter_mut().enumerate() {
                *new = dot(column(&self.matrix, j), old); // W is symmetric: its column is its row.
            }
        });
        Ok(())
    }

    fn factor(&self, _rows: Range<usize>, x: MatMut<'_, f64>) -> io::Result<()> {
        self.by_column(x, |old, new| {
            let ordered: Vec<f64> = self.order.iter().map(|&k| old[k]).collect();
            for (j, new) in new.iter_mut().enumerate() {
                *new = dot(column(&self.lower, j), &ordered);
            }
        });
        Ok(())
    }

    fn unfactor(&self, x: MatMut<'_, f64>) -> io::Result<()> {
        self.by_column(x, |old, new| {
            let mut y = old.to_vec();
            for j in (0..y.len()).rev() {
                let (rows, values) = column(&self.lower, j);
                y[j] = (y[j] - dot((&rows[1..], &values[1..]), &y)) / values[0];
            }
            for (&k, &y) in self.order.iter().zip(&y) {
                new[k] = y;
            }
        });
        Ok(())
    }
}

/// Row indices and values of column j.
fn column(a: &SparseColMat<usize, f64>, j: usize) -> (&[usize], &[f64]) {
    (&a.row_idx()[a.col_range(j)], a.val_of_col(j))
}

fn dot((rows, values): (&[usize], &[f64]), x: &[f64]) -> f64 {
    rows.iter().zip(values).map(|(&i, v)| v * x[i]).sum()
}

fn check_symmetric(matrix: &SparseColMat<usize, f64>) -> Result<(), InnerProductError> {
    let (rows, columns) = (matrix.nrows(), matrix.ncols());
    if rows != columns {
        return Err(InnerProductError::NotSquare { rows, columns });
    }
    let at = |i: usize, j: usize| matrix.get(i, j).copied().unwrap_or(0.0);
    for t in matrix.triplet_iter() {
        let (row, column, value) = (t.row, t.col, *t.val);
        if !value.is_finite() {
            return Err(InnerProductError::NonFinite { row, column, value });
        }
        let mirror = at(column, row);
        let scale = (at(row, row) * at(column, column)).abs().sqrt();
        if (value - mirror).abs() > 1e-12 * scale {
            return Err(InnerProductError::NotSymmetric { row, column, value, mirror });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::Mat;

    /// Mass and stiffness matrix of linear elements on a line, numbered at random.
    fn mass_and_stiffness(size: usize) -> [Vec<(usize, usize, f64)>; 2] {
        let number = |k: usize| (k * 7) % size; // a permutation when 7 does not divide the size
        let element = |diagonal: f64, other: f64| {
            let of_cell = move |k: usize| {
                let (i, j) = (number(k), number(k + 1));
                [(i, i, diagonal), (i, j, other), (j, i, other), (j, j, diagonal)]
            };
            (0..size - 1).flat_map(of_cell).collect()
        };
        [element(2.0, 1.0), element(1.0, -1.0)]
    }

    #[test]
    fn w_is_the_square_of_its_factor() -> Result<(), Box<dyn std::error::Error>> {
        let size = 40;
        let [mass, _] = mass_and_stiffness(size);
        let w = SparseSpd::from_triplets(size, &mass)?;
        let mut dense = Mat::<f64>::zeros(size, size);
        for &(i, j, v) in &mass {
            dense[(i, j)] += v;
        }

        let mut applied = Mat::<f64>::identity(size, size);
        w.apply(applied.as_mut())?;
        assert_eq!(applied, dense);

        let mut f = Mat::<f64>::identity(size, size);
        w.factor(0..size, f.as_mut())?;
        let defect = (f.transpose() * &f - &dense).norm_max();
        assert!(defect < 1e-14, "|FᵀF - W| = {defect:e}");

        w.unfactor(f.as_mut())?;
        let defect = (f - Mat::<f64>::identity(size, size)).norm_max();
        assert!(defect < 1e-14, "|F⁻¹F - I| = {defect:e}");
        Ok(())
    }

    /// Bilinear elements on a square of 9 x 9 nodes: the factor has entries where W has none.
    #[test]
    fn w_is_the_square_of_a_factor_with_fill_in() -> Result<(), Box<dyn std::error::Error>> {
        const SIDE: usize = 9;
        let line = |i: usize, j: usize| match i.abs_diff(j) {
            0 if i == 0 || i == SIDE - 1 => 2.0,
            0 => 4.0,
            1 => 1.0,
            _ => 0.0,
        };
        let mass = Mat::from_fn(SIDE * SIDE, SIDE * SIDE, |i, j| {
            line(i / SIDE, j / SIDE) * line(i % SIDE, j % SIDE)
        });
        let all = (0..SIDE * SIDE).flat_map(|i| (0..SIDE * SIDE).map(move |j| (i, j)));
        let entries: Vec<_> =
            all.map(|(i, j)| (i, j, mass[(i, j)])).filter(|entry| entry.2 != 0.0).collect();
        let w = SparseSpd::from_triplets(SIDE * SIDE, &entries)?;
        let triangle = entries.iter().filter(|(i, j, _)| i >= j).count();
        assert!(w.lower.compute_nnz() > triangle, "no fill-in");
        let mut f = Mat::<f64>::identity(SIDE * SIDE, SIDE * SIDE);
        w.factor(0..SIDE * SIDE, f.as_mut())?;
        let defect = (f.transpose() * &f - &mass).norm_max();
        assert!(defect < 1e-13, "|FᵀF - W| = {defect:e}");
        w.unfactor(f.as_mut())?;
        let defect = (f - Mat::<f64>::identity(SIDE * SIDE, SIDE * SIDE)).norm_max();
        assert!(defect < 1e-14, "|F⁻¹F - I| = {defect:e}");
        Ok(())
    }

    #[test]
    fn a_matrix_that_is_no_inner_product_is_refused() {
        use InnerProductError as E;
        let spoil = |more: &[(usize, usize, f64)]| {
            let [mut entries, _] = mass_and_stiffness(10);
            entries.extend_from_slice(more);
            SparseSpd::from_triplets(10, &entries).expect_err("this is no inner product")
        };
        assert!(matches!(spoil(&[(2, 5, 0.5)]), E::NotSymmetric { .. }));
        assert!(matches!(spoil(&[(2, 2, -9.0)]), E::NotPositiveDefinite { .. }));
        assert!(matches!(spoil(&[(3, 3, f64::NAN)]), E::NonFinite { row: 3, column: 3, .. }));
        assert!(matches!(spoil(&[(10, 0, 1.0)]), E::Outside { row: 10, column: 0, size: 10 }));

        let [_, singular] = mass_and_stiffness(10);
        let error = SparseSpd::from_triplets(10, &singular).expect_err("constants have no energy");
        assert!(matches!(error, E::NotPositiveDefinite { .. }));

        let flat = SparseColMat::try_new_from_triplets(2, 3, &[]).expect("an empty matrix");
        assert_eq!(SparseSpd::new(flat).err(), Some(E::NotSquare { rows: 2, columns: 3 }));
    }

    /// An unknown without any entry: the factorisation must not be asked for its diagonal.
    #[test]
    fn an_empty_row_is_not_positive_definite() {
        let error = SparseSpd::from_triplets(2, &[(0, 0, 1.0)]).err();
        assert_eq!(error, Some(InnerProductError::NotPositiveDefinite { index: 1 }));
    }
}
