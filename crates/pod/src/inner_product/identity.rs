use super::{InnerProduct, Reach};
use faer::MatMut;
use std::io;
use std::ops::Range;

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

    fn reach(&self) -> Reach {
        Reach::Rows(0)
    }

    fn diagonal(&self) -> io::Result<Vec<f64>> {
        Ok(vec![1.0; self.dim])
    }

    fn apply(&self, _x: MatMut<'_, f64>) -> io::Result<()> {
        Ok(())
    }

    fn factor(&self, _rows: Range<usize>, _x: MatMut<'_, f64>) -> io::Result<()> {
        Ok(())
    }

    fn unfactor(&self, _x: MatMut<'_, f64>) -> io::Result<()> {
        Ok(())
    }
}
