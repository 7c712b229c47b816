//! Solving with the factors.

use super::analysis::{Analysis, Front};
use super::pivot_block::{SMALL, solve_vector};
use crate::linear::Scalar;
use crate::linear::kernel::add_product;
use crate::linear::simd::vectorised;
use std::ops::Range;

/// Solves for right-hand sides in the order of elimination, one after the other in `x`.
///
/// * `factors`: of all fronts, and the exchanges of rows
/// * `gathered`: room for the unknowns that a front leaves
pub(super) fn substitute<T: Scalar>(
    analysis: &Analysis,
    factors: (&[T], &[u32]),
    x: &mut [T],
    gathered: &mut [T],
) {
    vectorised(
        #[inline(always)]
        || {
            for x in x.chunks_exact_mut(analysis.order.len()) {
                substitute_inlined(analysis, factors, x, gathered);
            }
        },
    );
}

#[inline(always)]
fn substitute_inlined<T: Scalar>(
    analysis: &Analysis,
    (factors, exchanges): (&[T], &[u32]),
    x: &mut [T],
    gathered: &mut [T],
) {
    let mut at = 0;
    for front in &analysis.fronts {
        Step::new(analysis, front, &factors[at..], exchanges).forward(x, gathered);
        at += front.own_entries();
    }
    for front in analysis.fronts.iter().rev() {
        at -= front.own_entries();
        Step::new(analysis, front, &factors[at..], exchanges).backward(x, gathered);
    }
}

/// One front of a substitution.
struct Step<'a, T> {
    pivots: Range<usize>,
    /// Places of the unknowns that are left.
    left: &'a [u32],
    /// The columns of the pivots, and what follows.
    columns: &'a [T],
    /// The rows of the pivots, `A₁₁⁻¹ A₁₂`, and what follows.
    across: &'a [T],
    exchanges: &'a [u32],
}

impl<'a, T: Scalar> Step<'a, T> {
    /// * `factors`: from the first entry of the front's own on
    #[inline(always)]
    fn new(analysis: &'a Analysis, front: &Front, factors: &'a [T], exchanges: &'a [u32]) -> Self {
        Self {
            pivots: front.eliminated.clone(),
            left: &analysis.left[front.left.clone()],
            columns: factors,
            across: &factors[front.pivots() * front.size()..],
            exchanges: &exchanges[front.eliminated.clone()],
        }
    }

    /// `x₁ ← A₁₁⁻¹ x₁`, `x₂ ← x₂ − A₂₁ x₁`
    #[inline(always)]
    fn forward(&self, x: &mut [T], gathered: &mut [T]) {
        let (pivots, size) = (self.pivots.len(), self.pivots.len() + self.left.len());
        if pivots == 0 {
            return;
        }
        let solved = &mut x[self.pivots.clone()];
        if pivots <= SMALL {
            let mut product = [T::default(); SMALL];
            let product = &mut product[..pivots];
            add_product(product, self.columns, size, solved);
            solved.copy_from_slice(product);
        } else {
            solve_vector(self.columns, size, self.exchanges, solved);
        }
        if self.left.is_empty() {
            return;
        }
        let gathered = &mut gathered[..self.left.len()];
        gathered.fill(T::default());
        add_product(gathered, &self.columns[pivots..], size, solved);
        for (&place, &sum) in self.left.iter().zip(gathered.iter()) {
            x[place as usize] -= sum;
        }
    }

    /// `x₁ ← x₁ − A₁₁⁻¹ A₁₂ x₂`
    #[inline(always)]
    fn backward(&self, x: &mut [T], gathered: &mut [T]) {
        let pivots = self.pivots.len();
        if pivots == 0 || self.left.is_empty() {
            return;
        }
        let gathered = &mut gathered[..self.left.len()];
        for (to, &place) in gathered.iter_mut().zip(self.left) {
            *to = -x[place as usize];
        }
        add_product(&mut x[self.pivots.clone()], self.across, pivots, gathered);
    }
}
