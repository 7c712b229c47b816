use super::{InnerProduct, InnerProductError, Reach};
use crate::contiguous::columns_mut;
use faer::MatMut;
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
