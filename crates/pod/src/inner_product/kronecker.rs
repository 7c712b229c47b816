use super::{InnerProduct, InnerProductError, Reach};
use crate::contiguous::columns_mut;
use faer::MatMut;
use std::io;
use std::ops::Range;

/// A symmetric positive definite tridiagonal matrix, such as the mass matrix of linear elements on a line.
///
/// ```
/// use lumley_pod::Tridiagonal;
/// // One element of length 6 m.
/// let mass = Tridiagonal::new(&[2.0, 2.0], &[1.0])?;
/// assert_eq!(mass.size(), 2);
/// # Ok::<(), lumley_pod::InnerProductError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Tridiagonal {
    /// The factor F, `T = Fᵀ F`: its diagonal and what stands right of it, 0 in the last row.
    factor: Vec<(f64, f64)>,
}

impl Tridiagonal {
    /// The matrix with this diagonal and these entries beside it, one fewer.
    ///
    /// # Errors
    /// [`InnerProductError::NotPositiveDefinite`] names the unknown at which the factorisation
    /// found it; so does an entry that is not finite.
    ///
    /// # Panics
    /// If there is not one entry fewer beside the diagonal than on it.
    pub fn new(diagonal: &[f64], beside: &[f64]) -> Result<Self, InnerProductError> {
        assert_eq!(diagonal.len(), beside.len() + 1, "one entry fewer beside the diagonal");
        let (mut factor, mut carried) = (Vec::with_capacity(diagonal.len()), 0.0_f64);
        for (index, a) in diagonal.iter().enumerate() {
            let square = a - carried * carried;
            // Less than round-off of the entry itself is left where the matrix is singular.
            if !(square > 4.0 * f64::EPSILON * a && square.is_finite()) {
                return Err(InnerProductError::NotPositiveDefinite { index });
            }
            let d = square.sqrt();
            carried = beside.get(index).map_or(0.0, |b| b / d);
            factor.push((d, carried));
        }
        Ok(Self { factor })
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.factor.len()
    }

    /// `T_kk = |F e_k|²`.
    fn diagonal(&self, k: usize) -> f64 {
        let above = k.checked_sub(1).map_or(0.0, |before| self.factor[before].1);
        self.factor[k].0.powi(2) + above * above
    }
}

/// `W = I ⊗ ... ⊗ T_2 ⊗ T_1`: the mass matrix of a uniform grid, direction by direction.
///
/// Rows of x list the first direction fastest, then the second, and so on; then the whole again
/// for each component. `F = I ⊗ ... ⊗ F_2 ⊗ F_1` is the product of the bidiagonal factors, so
/// that row i of `F x` depends on neighbours after i alone ([`Reach::Rows`]), no factor is
/// stored and grids of any size are read by blocks.
///
/// ```
/// use lumley_pod::{InnerProduct, Kronecker, Reach, Tridiagonal};
/// let line = Tridiagonal::new(&[2.0, 4.0, 2.0], &[1.0, 1.0])?;
/// // Two components of velocity on 3 x 3 nodes.
/// let w = Kronecker::new(vec![line.clone(), line], 2);
/// assert_eq!((w.dim(), w.reach()), (18, Reach::Rows(4)));
/// let mut one = faer::Mat::<f64>::from_fn(18, 1, |_, _| 1.0);
/// w.factor(0..18, one.as_mut())?;
/// assert!((one.squared_norm_l2() - 2.0 * 144.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Kronecker {
    directions: Vec<Tridiagonal>,
    copies: usize,
}

impl Kronecker {
    /// The product of these directions, the fastest first, for `copies` components.
    pub fn new(directions: Vec<Tridiagonal>, copies: usize) -> Self {
        Self { directions, copies }
    }

    /// Each direction with the distance in rows of two neighbours along it.
    fn strides(&self) -> impl DoubleEndedIterator<Item = (&Tridiagonal, usize)> {
        let mut stride = 1;
        let strides: Vec<_> = self
            .directions
            .iter()
            .map(|t| {
                let of_this = stride;
                stride *= t.size();
                (t, of_this)
            })
            .collect();
        strides.into_iter()
    }
}

impl InnerProduct for Kronecker {
    fn dim(&self) -> usize {
        self.directions.iter().map(Tridiagonal::size).product::<usize>() * self.copies
    }

    fn reach(&self) -> Reach {
        Reach::Rows(self.strides().filter(|(t, _)| t.size() > 1).map(|(_, stride)| stride).sum())
    }

    fn diagonal(&self) -> io::Result<Vec<f64>> {
        let of_row = |i: usize| {
            self.strides().map(|(t, stride)| t.diagonal(i / stride % t.size())).product()
        };
        Ok((0..self.dim()).map(of_row).collect())
    }

    fn apply(&self, mut x: MatMut<'_, f64>) -> io::Result<()> {
        self.factor(0..x.nrows(), x.as_mut())?;
        for x in columns_mut(x.as_mut()) {
            for (t, stride) in self.strides() {
                let at = |i: usize| t.factor[i / stride % t.size()];
                for i in (0..x.len()).rev() {
                    let before = i.checked_sub(stride).map_or(0.0, |b| at(b).1 * x[b]);
                    x[i] = at(i).0 * x[i] + before;
                }
            }
        }
        Ok(())
    }

    fn factor(&self, rows: Range<usize>, mut x: MatMut<'_, f64>) -> io::Result<()> {
        for x in columns_mut(x.as_mut()) {
            for (t, stride) in self.strides() {
                multiply(t, stride, rows.start, x);
            }
        }
        Ok(())
    }

    fn unfactor(&self, mut x: MatMut<'_, f64>) -> io::Result<()> {
        for x in columns_mut(x.as_mut()) {
            for (t, stride) in self.strides() {
                for i in (0..x.len()).rev() {
                    let (d, beside) = t.factor[i / stride % t.size()];
                    let after = if beside == 0.0 { 0.0 } else { beside * x[i + stride] };
                    x[i] = (x[i] - after) / d;
                }
            }
        }
        Ok(())
    }
}

/// `x <- F x` along one direction, in place and upwards: what stands after a row is still the old
/// value. Rows whose neighbour is not there are left without it.
fn multiply(t: &Tridiagonal, stride: usize, first: usize, x: &mut [f64]) {
    let (mut place, mut k) = (first % stride, first / stride % t.size());
    let mut start = 0;
    while start < x.len() {
        // Rows with one pair of factors; with stride 1 that is each row for itself.
        let end = (start + stride - place).min(x.len());
        let (d, beside) = t.factor[k];
        let (here, after) = x.split_at_mut(end);
        let here = &mut here[start..];
        // The neighbours of the first rows of a long run lie within the run's own length.
        if stride == 1 {
            here[0] = d * here[0] + beside * after.first().copied().unwrap_or(0.0);
        } else {
            let shift = stride - (end - start);
            let neighbours = after.get(shift..).unwrap_or_default();
            let both = here.len().min(neighbours.len());
            for (x, y) in here[..both].iter_mut().zip(neighbours) {
                *x = d * *x + beside * y;
            }
            here[both..].iter_mut().for_each(|x| *x *= d);
        }
        (start, place, k) = (end, 0, (k + 1) % t.size());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::Mat;

    fn grid() -> Kronecker {
        let line = |n: usize, h: f64| {
            let diagonal: Vec<f64> =
                (0..n).map(|k| if k == 0 || k == n - 1 { 2.0 * h } else { 4.0 * h }).collect();
            Tridiagonal::new(&diagonal, &vec![h; n - 1]).expect("a mass matrix")
        };
        Kronecker::new(vec![line(5, 1.0), line(4, 0.5), line(3, 2.0)], 2)
    }

    /// The matrix itself, entry by entry.
    fn dense(w: &Kronecker) -> Mat<f64> {
        let entry = |t: &Tridiagonal, a: usize, b: usize| match a.abs_diff(b) {
            0 => t.diagonal(a),
            1 => t.factor[a.min(b)].0 * t.factor[a.min(b)].1,
            _ => 0.0,
        };
        let nodes = w.dim() / w.copies;
        Mat::from_fn(w.dim(), w.dim(), |i, j| {
            if i / nodes != j / nodes {
                return 0.0;
            }
            let of_direction = |(t, stride): (&Tridiagonal, usize)| {
                entry(t, i / stride % t.size(), j / stride % t.size())
            };
            w.strides().map(of_direction).product()
        })
    }

    #[test]
    fn w_is_the_square_of_its_factor() -> Result<(), Box<dyn std::error::Error>> {
        let w = grid();
        let n = w.dim();
        let mut f = Mat::<f64>::identity(n, n);
        w.factor(0..n, f.as_mut())?;
        let defect = (f.transpose() * &f - dense(&w)).norm_max();
        assert!(defect < 1e-13, "{defect:e}");
        let mut applied = Mat::<f64>::identity(n, n);
        w.apply(applied.as_mut())?;
        assert!((applied - dense(&w)).norm_max() < 1e-13);
        w.unfactor(f.as_mut())?;
        assert!((f - Mat::<f64>::identity(n, n)).norm_max() < 1e-13);
        let diagonal = w.diagonal()?;
        assert!((0..n).all(|i| (diagonal[i] - dense(&w)[(i, i)]).abs() < 1e-13));
        Ok(())
    }

    /// Any block of rows, read with what it reaches, gives the rows of the whole to the last bit.
    #[test]
    fn blocks_of_rows_give_the_rows_of_the_whole() -> io::Result<()> {
        let w = grid();
        let (n, Reach::Rows(reach)) = (w.dim(), w.reach()) else { panic!("rows are local") };
        assert_eq!(reach, 1 + 5 + 20);
        let x = Mat::from_fn(n, 2, |i, j| ((3 * i + 7 * j) as f64).sin());
        let mut whole = x.clone();
        w.factor(0..n, whole.as_mut())?;
        for start in 0..n {
            for length in [1, 3, 17, 64] {
                let rows = start..(start + length).min(n);
                let end = (rows.end + reach).min(n);
                let mut part = x.subrows(start, end - start).to_owned();
                w.factor(rows.clone(), part.as_mut())?;
                assert_eq!(
                    part.subrows(0, rows.len()),
                    whole.subrows(start, rows.len()),
                    "{rows:?}"
                );
            }
        }
        Ok(())
    }

    #[test]
    fn a_singular_matrix_is_refused() {
        let stiffness = Tridiagonal::new(&[1.0, 2.0, 1.0], &[-1.0, -1.0]);
        assert_eq!(stiffness, Err(InnerProductError::NotPositiveDefinite { index: 2 }));
        let nan = Tridiagonal::new(&[1.0, f64::NAN], &[0.0]);
        assert_eq!(nan, Err(InnerProductError::NotPositiveDefinite { index: 1 }));
    }
}
