//! The numbers of the fronts: adding up, elimination, contributions.

use super::SingularMatrix;
use super::analysis::{Analysis, Front, Run};
use super::pivot_block::{self, Floors, SMALL};
use crate::linear::Scalar;
use crate::linear::simd::vectorised;
use faer::linalg::matmul::matmul;
use faer::prelude::Reborrow;
use faer::{Accum, MatMut, MatRef, Par};

/// What the elimination of a subtree writes: every part is one range for the whole subtree, its
/// halves first.
pub(super) struct Memory<'a, T> {
    /// Factors.
    pub factors: &'a mut [T],
    /// Exchanges of rows, one for each pivot.
    pub exchanges: &'a mut [u32],
    /// Round-off of the rows, one for each pivot.
    pub floors: &'a mut [T],
    /// Working memory; the contribution is left at its start.
    pub work: &'a mut [T],
}

/// A matrix on its way through the tree.
pub(super) struct Elimination<'a, T> {
    pub analysis: &'a Analysis,
    pub matrices: &'a [f64],
    /// Round-off of the columns, in the order of elimination.
    pub columns: &'a [T],
    /// Halves of the upper levels go to two threads.
    pub parallel: bool,
}

impl<T: Scalar> Elimination<'_, T> {
    /// Eliminates the unknowns of a subtree.
    pub fn subtree(&self, root: usize, memory: Memory<'_, T>) -> Result<(), SingularMatrix> {
        let front = &self.analysis.fronts[root];
        let Memory { factors, exchanges, floors, work } = memory;
        let own = factors.len() - front.own_entries();
        let (below, factors) = factors.split_at_mut(own);
        let own = exchanges.len() - front.pivots();
        let (exchanges_below, exchanges) = exchanges.split_at_mut(own);
        let (floors_below, floors) = floors.split_at_mut(own);
        let kept = match front.halves {
            None => 0,
            Some(halves) => {
                let (factors, exchanges, floors) = (below, exchanges_below, floors_below);
                self.halves(front, halves, Memory { factors, exchanges, floors, work })?
            }
        };
        let (contributions, right) = work.split_at_mut(kept);
        let right = &mut right[..front.size() * front.left.len()];
        let (left, across) = factors.split_at_mut(front.size() * front.pivots());
        self.add_up(front, contributions, &mut Columns { left, right, front });
        let columns = &self.columns[front.eliminated.clone()];
        let floors = &mut Floors { rows: floors, columns };
        eliminate(front, left, across, right, exchanges, floors).map_err(|refused| {
            let unknown = self.analysis.order[front.eliminated.start + refused.column];
            refused.of(unknown)
        })?;
        compact(front, work, kept);
        Ok(())
    }

    /// Eliminates both halves; returns the working memory up to the end of their contributions.
    fn halves(
        &self,
        whole: &Front,
        halves: [usize; 2],
        memory: Memory<'_, T>,
    ) -> Result<usize, SingularMatrix> {
        let [a, b] = halves.map(|half| &self.analysis.fronts[half]);
        let Memory { factors, exchanges, floors, work } = memory;
        let (factors, factors_b) = factors.split_at_mut(a.entries);
        let (exchanges, exchanges_b) = exchanges.split_at_mut(a.eliminated.end - a.first);
        let (floors, floors_b) = floors.split_at_mut(exchanges.len());
        let (one, other) = halves.into();
        if !whole.forked {
            self.subtree(one, Memory { factors, exchanges, floors, work: &mut *work })?;
            let (factors, exchanges, floors) = (factors_b, exchanges_b, floors_b);
            let work = &mut work[a.contribution()..];
            self.subtree(other, Memory { factors, exchanges, floors, work })?;
            return Ok(a.contribution() + b.contribution());
        }
        let (work, rest) = work.split_at_mut(a.work);
        let first = Memory { factors, exchanges, floors, work };
        let (factors, exchanges, floors) = (factors_b, exchanges_b, floors_b);
        let second = Memory { factors, exchanges, floors, work: &mut rest[..b.work] };
        let (first, second) = if self.parallel {
            rayon::join(|| self.subtree(one, first), || self.subtree(other, second))
        } else {
            (self.subtree(one, first), self.subtree(other, second))
        };
        first.and(second)?;
        Ok(a.work + b.work)
    }

    fn add_up(&self, front: &Front, contributions: &[T], columns: &mut Columns<'_, T>) {
        vectorised(
            #[inline(always)]
            || {
                columns.left.fill(T::default());
                columns.right.fill(T::default());
                for &cell in &front.cells {
                    let rows = &self.analysis.cell_rows[self.analysis.cells.of_range(cell)];
                    columns.add_cell(rows, &self.matrices[self.analysis.cells.matrix(cell)]);
                }
                let mut start = 0;
                for half in front.halves.into_iter().flatten() {
                    let half = &self.analysis.fronts[half];
                    let contribution = &contributions[start..][..half.contribution()];
                    let runs = &self.analysis.runs[half.runs.clone()];
                    columns.add_contribution(runs, contribution, half.left.len());
                    start += if front.forked { half.work } else { half.contribution() };
                }
            },
        );
    }
}

/// The columns of a front: those of its pivots lie among the factors, the others in working memory.
struct Columns<'a, T> {
    left: &'a mut [T],
    right: &'a mut [T],
    front: &'a Front,
}

impl<T: Scalar> Columns<'_, T> {
    #[inline(always)]
    fn column(&mut self, j: usize) -> &mut [T] {
        let (size, pivots) = (self.front.size(), self.front.pivots());
        if j < pivots {
            &mut self.left[j * size..][..size]
        } else {
            &mut self.right[(j - pivots) * size..][..size]
        }
    }

    #[inline(always)]
    fn add_cell(&mut self, rows: &[u32], matrix: &[f64]) {
        for (entries, &j) in matrix.chunks_exact(rows.len().max(1)).zip(rows) {
            let column = self.column(j as usize);
            for (&i, &a) in rows.iter().zip(entries) {
                column[i as usize] += T::from_f64(a);
            }
        }
    }

    #[inline(always)]
    fn add_contribution(&mut self, runs: &[Run], contribution: &[T], size: usize) {
        for across in runs {
            for j in 0..across.len {
                let column = self.column((across.to + j) as usize);
                let entries = &contribution[(across.from + j) as usize * size..][..size];
                for down in runs {
                    let len = down.len as usize;
                    let entries = &entries[down.from as usize..][..len];
                    for (x, &a) in column[down.to as usize..][..len].iter_mut().zip(entries) {
                        *x += a;
                    }
                }
            }
        }
    }
}

/// Eliminates the pivots of a front: `W = A₁₁⁻¹ A₁₂` into `across`, `A₂₂ − A₂₁ W` into `right`.
fn eliminate<T: Scalar>(
    front: &Front,
    left: &mut [T],
    across: &mut [T],
    right: &mut [T],
    exchanges: &mut [u32],
    floors: &mut Floors<'_, T>,
) -> Result<(), pivot_block::Refused> {
    let (size, pivots, rest) = (front.size(), front.pivots(), front.left.len());
    if pivots == 0 {
        return Ok(());
    }
    if pivots <= SMALL {
        pivot_block::invert(left, size, exchanges, floors)?;
    } else {
        pivot_block::factorise(left, size, exchanges, floors)?;
    }
    if rest == 0 {
        return Ok(());
    }
    let right = MatMut::from_column_major_slice_mut(right, size, rest);
    let (top, bottom) = right.split_at_row_mut(pivots);
    let (block, below) = MatRef::from_column_major_slice(left, size, pivots).split_at_row(pivots);
    if pivots <= SMALL {
        let across = MatMut::from_column_major_slice_mut(across, pivots, rest);
        matmul(across, Accum::Replace, block, top, T::from_f64(1.0), Par::Seq);
    } else {
        for (to, from) in across.chunks_exact_mut(pivots).zip(top.rb().col_iter()) {
            to.copy_from_slice(from.try_as_col_major().expect("by columns").as_slice());
        }
        pivot_block::solve_matrix(left, size, exchanges, across);
    }
    let across = MatRef::from_column_major_slice(across, pivots, rest);
    matmul(bottom, Accum::Add, below, across, -T::from_f64(1.0), Par::Seq);
    Ok(())
}

/// Moves the contribution from the working memory behind `kept` to its start.
fn compact<T: Copy>(front: &Front, work: &mut [T], kept: usize) {
    let (size, pivots, rest) = (front.size(), front.pivots(), front.left.len());
    for j in 0..rest {
        let from = kept + j * size + pivots;
        work.copy_within(from..from + rest, j * rest);
    }
}
