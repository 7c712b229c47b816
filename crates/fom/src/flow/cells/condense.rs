//! Elimination of what lives in one cell alone: the velocity inside and the two slopes of the pressure.

use super::integrals::{Integrals, Terms};
use super::lanes::{Lanes, WIDTH};

/// Unknowns that are eliminated in a cell.
pub const INTERIOR: usize = 4;

/// Unknowns that a cell with N velocities has in common with others, and its mean pressure: the x components of
/// the N − 1 velocities on its rim, their y components, the mean pressure.
pub const fn rim(nodes: usize) -> usize {
    2 * nodes - 1
}

/// Numbers that recover the interior unknowns of a cell with `rim` others: for each of the four a factor for all
/// before it, and a constant.
pub const fn recovery(rim: usize) -> usize {
    INTERIOR * rim + INTERIOR * (INTERIOR - 1) / 2 + INTERIOR
}

/// The system of a cell with M = 2 N + 3 unknowns: first those of the [`rim`], then slope y and slope x of the
/// pressure, y and x component of the velocity inside.
pub struct Dense<const M: usize> {
    matrix: [[Lanes; M]; M],
    right: [Lanes; M],
}

/// Where component c of velocity i stands.
#[inline(always)]
fn place<const N: usize, const M: usize>(c: usize, i: usize) -> usize {
    if i + 1 < N { c * (N - 1) + i } else { M - 1 - c }
}

impl<const M: usize> Dense<M> {
    #[inline(always)]
    pub fn new<const N: usize, const C: usize>(sums: &Integrals<N, C>, terms: &Terms) -> Self {
        let pressures = [2 * N - 2, M - 3, M - 4];
        let mut this = Self { matrix: [[Lanes::default(); M]; M], right: [Lanes::default(); M] };
        for c in 0..2 {
            for i in 0..N {
                let row = place::<N, M>(c, i);
                this.right[row] = sums.momentum[c][i];
                for j in 0..N {
                    this.matrix[row][place::<N, M>(c, j)] = sums.common[i][j];
                }
                for (k, pressure) in pressures.into_iter().enumerate() {
                    this.matrix[row][pressure] = sums.divergence[k][c][i];
                    this.matrix[pressure][row] = sums.divergence[k][c][i];
                }
            }
            for d in 0..2 {
                for i in 0..C {
                    for j in 0..N {
                        this.matrix[place::<N, M>(c, i)][place::<N, M>(d, j)] +=
                            sums.coupled[c][d][i][j];
                    }
                }
            }
        }
        this.right[pressures[0]] = sums.area * -terms.divergence;
        this
    }

    /// Eliminates the interior unknowns, the velocities first: their pivots are not zero.
    #[inline(always)]
    pub fn condense(&mut self) {
        for k in (M - INTERIOR..M).rev() {
            let inverse = self.matrix[k][k].recip();
            for j in 0..k {
                self.matrix[k][j] = self.matrix[k][j] * inverse;
            }
            self.right[k] = self.right[k] * inverse;
            let (others, row) = self.matrix.split_at_mut(k);
            for (i, other) in others.iter_mut().enumerate() {
                let factor = other[k];
                for j in 0..k {
                    other[j] -= factor * row[0][j];
                }
                let shift = factor * self.right[k];
                self.right[i] -= shift;
            }
        }
    }

    /// Writes what was found for the first cells: their matrices by columns, right-hand sides and recoveries.
    #[inline(always)]
    pub fn store(&self, matrices: &mut [f64], right: &mut [f64], recoveries: &mut [f64]) {
        let rim = M - INTERIOR;
        let lanes = matrices.chunks_exact_mut(rim * rim).zip(right.chunks_exact_mut(rim));
        let lanes = lanes.zip(recoveries.chunks_exact_mut(recovery(rim)));
        for (lane, ((matrix, right), recovery)) in lanes.enumerate().take(WIDTH) {
            for (j, column) in matrix.chunks_exact_mut(rim).enumerate() {
                for (i, entry) in column.iter_mut().enumerate() {
                    *entry = self.matrix[i][j].0[lane];
                }
            }
            for (i, entry) in right.iter_mut().enumerate() {
                *entry = self.right[i].0[lane];
            }
            let mut rest = recovery;
            for k in rim..M {
                let (row, after) = rest.split_at_mut(k + 1);
                for (j, entry) in row[..k].iter_mut().enumerate() {
                    *entry = self.matrix[k][j].0[lane];
                }
                row[k] = self.right[k].0[lane];
                rest = after;
            }
        }
    }
}

/// Computes the interior unknowns of a cell at the end of `local` from those of its rim, which stand before them.
pub fn recover(recovery: &[f64], local: &mut [f64]) {
    let mut rest = recovery;
    for k in local.len() - INTERIOR..local.len() {
        let (row, after) = rest.split_at(k + 1);
        let known: f64 = row[..k].iter().zip(&local[..k]).map(|(a, x)| a * x).sum();
        local[k] = row[k] - known;
        rest = after;
    }
}
