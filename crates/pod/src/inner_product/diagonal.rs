use super::{InnerProduct, InnerProductError, Reach};
use crate::contiguous::{column, columns_mut};
use faer::{MatMut, MatRef};
use std::io;
use std::ops::Range;

/// A weight for each unknown, W = diag(w): cell volumes, or a lumped mass matrix.
///
/// ```
/// use lumley_pod::{Diagonal, InnerProduct};
/// let w = Diagonal::new(vec![0.25, 4.0])?;
/// let mut x = faer::mat![[2.0], [2.0]];
/// w.factor(0..2, x.as_mut())?;
/// assert_eq!(x, faer::mat![[1.0], [4.0]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Diagonal {
    weights: Vec<f64>,
    roots: Vec<f64>,
}

impl Diagonal {
    /// The product with these positive weights; for integrals their unit is m, m² or m³.
    ///
    /// # Errors
    /// [`InnerProductError::Weight`] names the first that is not positive and finite.
    pub fn new(weights: Vec<f64>) -> Result<Self, InnerProductError> {
        let bad = |w: &f64| !(*w > 0.0 && w.is_finite());
        if let Some(index) = weights.iter().position(bad) {
            return Err(InnerProductError::Weight { index, value: weights[index] });
        }
        let roots = weights.iter().map(|w| w.sqrt()).collect();
        Ok(Self { weights, roots })
    }
}

impl InnerProduct for Diagonal {
    fn dim(&self) -> usize {
        self.weights.len()
    }

    fn reach(&self) -> Reach {
        Reach::Rows(0)
    }

    fn diagonal(&self) -> io::Result<Vec<f64>> {
        Ok(self.weights.clone())
    }

    fn apply(&self, x: MatMut<'_, f64>) -> io::Result<()> {
        update_rows(&self.weights, x, |x, w| x * w);
        Ok(())
    }

    fn factor(&self, rows: Range<usize>, x: MatMut<'_, f64>) -> io::Result<()> {
        update_rows(&self.roots[rows], x, |x, root| x * root);
        Ok(())
    }

    fn factor_columns(
        &self,
        rows: Range<usize>,
        x: MatRef<'_, f64>,
        columns: &[usize],
        out: MatMut<'_, f64>,
    ) -> io::Result<()> {
        let roots = &self.roots[rows];
        let mut out: Vec<&mut [f64]> = columns_mut(out).collect();
        // By fours: memory answers to several streams at once.
        let (fours, rest) = columns.as_chunks::<4>();
        let (out_fours, out_rest) = out.as_chunks_mut::<4>();
        for (from, [a, b, c, d]) in fours.iter().zip(out_fours) {
            let from = from.map(|k| column(x, k));
            let from = from[0].iter().zip(from[1]).zip(from[2].iter().zip(from[3]));
            let to = a.iter_mut().zip(b.iter_mut()).zip(c.iter_mut().zip(d.iter_mut()));
            for ((to, from), root) in to.zip(from).zip(roots) {
                let (((a, b), (c, d)), ((x, y), (z, w))) = (to, from);
                *a = x * root;
                *b = y * root;
                *c = z * root;
                *d = w * root;
            }
        }
        for (&from, to) in rest.iter().zip(out_rest) {
            for ((to, x), root) in to.iter_mut().zip(column(x, from)).zip(roots) {
                *to = x * root;
            }
        }
        Ok(())
    }

    fn unfactor(&self, x: MatMut<'_, f64>) -> io::Result<()> {
        update_rows(&self.roots, x, |x, root| x / root);
        Ok(())
    }
}

fn update_rows(by: &[f64], x: MatMut<'_, f64>, f: impl Fn(f64, f64) -> f64) {
    for column in columns_mut(x) {
        for (x, &by) in column.iter_mut().zip(by) {
            *x = f(*x, by);
        }
    }
}
