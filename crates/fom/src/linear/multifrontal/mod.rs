//! A direct solver for matrices that are sums of dense cell matrices.

mod analysis;
mod bisection;
mod build;
mod components;
mod dissection;
mod elimination;
mod error;
mod pivot_block;
mod round_off;
mod substitution;

pub use analysis::{Analysis, DelayedUnknowns};
pub use error::SingularMatrix;

use super::Scalar;
use elimination::{Elimination, Memory};
use faer::Par;
use std::sync::Arc;

/// Multifrontal LU factorisation (Duff and Reid, 1983) of a matrix given by cells.
///
/// There is no matrix of the whole: the cell matrices are added up in dense fronts along the tree of
/// the [`Analysis`]. A front with the pivots 1 and the rest 2 keeps `A₁₁⁻¹`, `A₂₁` and `W = A₁₁⁻¹ A₁₂`
/// and adds `A₂₂ − A₂₁ W` to the front above. Rows are exchanged within `A₁₁` only: the largest entry of the
/// column is the pivot. Blocks of up to 48 pivots are inverted; larger ones are kept as L and U. All memory is
/// taken at the start but for the right-hand sides, whose room grows with their number.
///
/// Accuracy: an inverse loses as many digits as its block is ill-conditioned, so the residual may be a
/// few orders above round-off where velocities and pressures are scaled far apart.
///
/// `T` is [`f64`], or [`f32`] for a preconditioner.
///
/// ```
/// use faer::Par;
/// use lumley_fom::linear::{Analysis, CellUnknowns, DelayedUnknowns, Multifrontal};
/// // −u'' = 1 on (0, 1) in 8 cells, u = 0 at both ends: u = x (1 − x)/2.
/// let cells: Vec<Vec<usize>> =
///     (0..8).map(|c| (0..7).filter(|u| [c, c + 1].contains(&(u + 1))).collect()).collect();
/// let matrices: Vec<f64> = cells
///     .iter()
///     .flat_map(|u| if u.len() == 1 { vec![8.0] } else { vec![8.0, -8.0, -8.0, 8.0] })
///     .collect();
/// let centroids: Vec<_> = (0..8).map(|c| [f64::from(c), 0.0]).collect();
/// let line = CellUnknowns::new(7, &cells)?;
/// let analysis = Analysis::new(line, &centroids, &DelayedUnknowns::default());
/// let mut lu = Multifrontal::<f64>::new(analysis, Par::Seq);
/// lu.factorise(&matrices)?;
/// let mut u = [1.0 / 8.0; 7];
/// lu.solve(&mut u);
/// assert!((u[3] - 0.125).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Multifrontal<T> {
    analysis: Arc<Analysis>,
    parallel: bool,
    factorised: bool,
    factors: Vec<T>,
    exchanges: Vec<u32>,
    row_floors: Vec<T>,
    column_floors: Vec<T>,
    work: Vec<T>,
    vector: Vec<T>,
}

impl<T: Scalar> Multifrontal<T> {
    /// Room for the factors of a matrix with this pattern.
    ///
    /// * `par`: more than one thread takes the halves of the upper levels of the tree apart; the
    ///   bits are the same
    pub fn new(analysis: Arc<Analysis>, par: Par) -> Self {
        let (count, work) = (analysis.cells.count(), analysis.work());
        let zeros = |len| vec![T::default(); len];
        Self {
            parallel: matches!(par, Par::Rayon(threads) if threads.get() > 1),
            factorised: false,
            factors: zeros(analysis.entries()),
            exchanges: vec![0; count],
            row_floors: zeros(count),
            column_floors: zeros(count),
            work: zeros(work),
            vector: Vec::new(),
            analysis,
        }
    }

    /// The order of elimination.
    pub fn analysis(&self) -> &Arc<Analysis> {
        &self.analysis
    }

    /// Factorises the sum of these cell matrices, which lie as
    /// [`CellUnknowns`](super::CellUnknowns) says.
    ///
    /// # Errors
    /// If a pivot is no larger than the round-off of its row and column, or not a number. There is no
    /// factorisation then.
    ///
    /// # Panics
    /// If the number of entries is wrong.
    pub fn factorise(&mut self, matrices: &[f64]) -> Result<(), SingularMatrix> {
        let analysis = &*self.analysis;
        assert_eq!(matrices.len(), analysis.cells.matrix_len(), "the matrices of all cells");
        self.factorised = false;
        round_off::floors(analysis, matrices, &mut self.row_floors, &mut self.column_floors);
        let elimination = Elimination {
            analysis,
            matrices,
            columns: &self.column_floors,
            parallel: self.parallel,
        };
        let memory = Memory {
            factors: &mut self.factors,
            exchanges: &mut self.exchanges,
            floors: &mut self.row_floors,
            work: &mut self.work,
        };
        elimination.subtree(analysis.fronts.len() - 1, memory)?;
        self.factorised = true;
        Ok(())
    }

    /// Replaces right-hand sides, one after the other in `x`, by the solutions.
    ///
    /// # Panics
    /// If there is no factorisation, or `x` does not hold whole vectors.
    pub fn solve(&mut self, x: &mut [f64]) {
        assert!(self.factorised, "solve follows a successful factorisation");
        let count = self.analysis.cells.count();
        assert!(x.len().is_multiple_of(count), "one entry for each unknown");
        self.vector.resize(x.len() + self.analysis.left_at_most(), T::default());
        let (permuted, gathered) = self.vector.split_at_mut(x.len());
        for (x, permuted) in x.chunks_exact(count).zip(permuted.chunks_exact_mut(count)) {
            for (to, &unknown) in permuted.iter_mut().zip(&self.analysis.order) {
                *to = T::from_f64(x[unknown as usize]);
            }
        }
        let factors = (self.factors.as_slice(), self.exchanges.as_slice());
        substitution::substitute(&self.analysis, factors, permuted, gathered);
        for (x, permuted) in x.chunks_exact_mut(count).zip(permuted.chunks_exact(count)) {
            for (&from, &unknown) in permuted.iter().zip(&self.analysis.order) {
                x[unknown as usize] = from.to_f64();
            }
        }
    }
}
