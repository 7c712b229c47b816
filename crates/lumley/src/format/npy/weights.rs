use super::NpyMatrix;
use crate::format::FormatError;
use faer::MatMut;
use lumley_pod::{InnerProduct, InnerProductError, Reach};
use std::io;
use std::ops::Range;
use std::path::Path;

/// Weights that are held at a time.
const AT_ONCE: usize = 1 << 13;

/// Weights of an inner product that stay in an NPY file: there may be more of them than memory holds.
///
/// W is diagonal, with a weight for each unknown, or for each node where the field has several components,
/// which come one after the other. The unit of a weight is that of the cell that it stands for: m, m² or m³.
///
/// ```
/// use lumley::format::npy::{self, NpyWeights};
/// use lumley_pod::InnerProduct;
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("w.npy");
/// npy::write_vector(&path, &[0.25, 4.0])?;
/// let w = NpyWeights::open(&path)?.repeated(2);
/// let mut x = faer::mat![[1.0], [1.0], [2.0], [2.0]];
/// w.apply(x.as_mut())?;
/// assert_eq!(x, faer::mat![[0.25], [4.0], [0.5], [8.0]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct NpyWeights {
    file: NpyMatrix,
    nodes: usize,
    components: usize,
}

impl NpyWeights {
    /// The weights in the file `path`, one for each unknown. All of them are read once and checked.
    ///
    /// # Errors
    /// [`FormatError`] as for [`NpyMatrix::open`], for a matrix that is not a vector, and
    /// [`FormatError::Weights`] for the first weight that is not positive and finite.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, FormatError> {
        Self::open_share(path, 0, 1)
    }

    /// As [`open`](Self::open), by one of `count` processes that share the work: number `rank` reads and checks
    /// a share of the weights, and they can be relied on once every process has found its share right.
    ///
    /// # Errors
    /// As for [`open`](Self::open).
    ///
    /// # Panics
    /// Unless `rank < count`.
    pub fn open_share(
        path: impl AsRef<Path>,
        rank: usize,
        count: usize,
    ) -> Result<Self, FormatError> {
        assert!(rank < count, "process {rank} of {count}");
        let file = NpyMatrix::open(path)?;
        let nodes = file.vector_length()?;
        let weights = Self { file, nodes, components: 1 };
        let share = nodes.div_ceil(count);
        let first = share.saturating_mul(rank).min(nodes);
        weights.check(first..first.saturating_add(share).min(nodes))?;
        Ok(weights)
    }

    /// Whether the weights of `nodes` are positive and finite.
    fn check(&self, nodes: Range<usize>) -> Result<(), FormatError> {
        let from = nodes.start;
        self.visit(nodes, |first, part| {
            let bad = part.iter().position(|w| !(*w > 0.0 && w.is_finite()));
            bad.map_or(Ok(()), |i| {
                let source = InnerProductError::Weight { index: from + first + i, value: part[i] };
                Err(FormatError::Weights { path: self.file.path().to_owned(), source })
            })
        })
    }

    /// The same weights for each of so many components.
    ///
    /// # Panics
    /// If they cannot be counted.
    #[must_use]
    pub fn repeated(self, components: usize) -> Self {
        assert!(self.nodes.checked_mul(components).is_some(), "weights that can be counted");
        Self { components, ..self }
    }

    /// Gives `f` the weights of `rows` part by part, and where in `rows` a part begins.
    fn visit(
        &self,
        rows: Range<usize>,
        mut f: impl FnMut(usize, &mut [f64]) -> Result<(), FormatError>,
    ) -> Result<(), FormatError> {
        let mut weights = vec![0.0; rows.len().min(AT_ONCE)];
        let mut next = rows.start;
        while next < rows.end {
            let node = next % self.nodes;
            let length = AT_ONCE.min(self.nodes - node).min(rows.end - next);
            let part = &mut weights[..length];
            self.file.read_vector_part(node, part)?;
            f(next - rows.start, part)?;
            next += length;
        }
        Ok(())
    }

    /// Does `f` to every entry of these rows of x and its weight, or what `prepare` makes of the weight.
    fn update(
        &self,
        rows: Range<usize>,
        mut x: MatMut<'_, f64>,
        prepare: impl Fn(f64) -> f64,
        f: impl Fn(f64, f64) -> f64,
    ) -> io::Result<()> {
        let updated = self.visit(rows, |first, weights| {
            for w in weights.iter_mut() {
                *w = prepare(*w);
            }
            for column in x.as_mut().subrows_mut(first, weights.len()).col_iter_mut() {
                column.iter_mut().zip(&*weights).for_each(|(x, w)| *x = f(*x, *w));
            }
            Ok(())
        });
        updated.map_err(io::Error::other)
    }
}

impl InnerProduct for NpyWeights {
    fn dim(&self) -> usize {
        self.nodes * self.components
    }

    fn reach(&self) -> Reach {
        Reach::Rows(0)
    }

    fn diagonal(&self) -> io::Result<Vec<f64>> {
        let mut diagonal = Vec::with_capacity(self.dim());
        let read = self.visit(0..self.dim(), |_, weights| {
            diagonal.extend_from_slice(weights);
            Ok(())
        });
        read.map_err(io::Error::other)?;
        Ok(diagonal)
    }

    fn apply(&self, x: MatMut<'_, f64>) -> io::Result<()> {
        self.update(0..self.dim(), x, |w| w, |x, w| x * w)
    }

    fn factor(&self, rows: Range<usize>, x: MatMut<'_, f64>) -> io::Result<()> {
        self.update(rows, x, f64::sqrt, |x, root| x * root)
    }

    fn unfactor(&self, x: MatMut<'_, f64>) -> io::Result<()> {
        self.update(0..self.dim(), x, f64::sqrt, |x, root| x / root)
    }
}
