use super::InnerProduct;
use faer::MatMut;

/// The Euclidean inner product, W = I.
///
/// ```
/// use lumley_pod::{Identity, InnerProduct};
/// assert_eq!(Identity::new(3).dim(), 3);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Identity {
    dim: usize,
}

impl Identity {
    /// The product of vectors of length `dim`.
    pub fn new(dim: usize) -> Self {
        Self { dim }
    }
}

impl InnerProduct for Identity {
    fn dim(&self) -> usize {
        self.dim
    }

    fn couples_rows(&self) -> bool {
        false
    }

    fn diagonal(&self) -> Vec<f64> {
        vec![1.0; self.dim]
    }

    fn apply(&self, _first: usize, _x: MatMut<'_, f64>) {}

    fn factor(&self, _first: usize, _x: MatMut<'_, f64>) {}

    fn unfactor(&self, _first: usize, _x: MatMut<'_, f64>) {}
}
