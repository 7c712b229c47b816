//! `S <- S + T Z` for a block of rows: few random combinations of many rows.

use crate::contiguous::{columns, columns_mut};
use crate::random::random_bits;
use faer::{MatMut, MatRef};
use std::ops::Range;

/// Rows of S that each row of Z enters.
pub(crate) const COPIES: usize = 4;

/// The matrix T of a sketch `S = T Z`, with a few times as many rows as Z has columns: four entries in each
/// column, at random places, all 1 or all -1.
///
/// With high probability `|S v|² / 4` is between 0.09 and 2.9 times `|Z v|²` for every v (limits for twice as
/// many rows as columns): a factor of S makes of Z nearly orthogonal columns. Such sparse embeddings go
/// back to Clarkson and Woodruff (2013) and Nelson and Nguyen (2013).
///
/// Neighbouring rows enter neighbouring rows of S, for the sake of speed: rows are cut into pieces as
/// long as S, each of which is turned by a random number of places. T depends on the number of a row and
/// on nothing else.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sketch {
    rows: usize,
}

/// Neighbouring rows of Z that enter neighbouring rows of S.
struct Run {
    from: Range<usize>,
    to: usize,
}

impl Sketch {
    /// For matrices with m columns.
    pub fn new(m: usize) -> Self {
        Self { rows: 2 * m + 64 }
    }

    /// Rows of S.
    pub fn rows(self) -> usize {
        self.rows
    }

    /// Adds a block of rows to S: 8 k m operations.
    ///
    /// * `first`: number of the first row of the block in Z
    pub fn add(self, s: MatMut<'_, f64>, z: MatRef<'_, f64>, first: usize) {
        let rows = first..first + z.nrows();
        let runs: Vec<Run> = (0..COPIES).flat_map(|copy| self.runs(copy, &rows)).collect();
        let signs: Vec<f64> = rows.map(sign).collect();
        let mut signed = vec![0.0; signs.len()];
        for (s, z) in columns_mut(s).zip(columns(z)) {
            for ((signed, z), sign) in signed.iter_mut().zip(z).zip(&signs) {
                *signed = sign * z;
            }
            for Run { from, to } in &runs {
                let part = &signed[from.clone()];
                s[*to..].iter_mut().zip(part).for_each(|(s, z)| *s += z);
            }
        }
    }

    fn runs(self, copy: usize, rows: &Range<usize>) -> Vec<Run> {
        let (mut runs, mut next) = (Vec::new(), rows.start);
        while next < rows.end {
            let (piece, place) = (next / self.rows, next % self.rows);
            let number = (1 << 63) | (COPIES * piece + copy) as u64; // none of those of the signs
            let turn = random_bits(number) % self.rows as u64;
            let turn = usize::try_from(turn).expect("less than the number of rows");
            let to = (place + turn) % self.rows;
            // To the end of the piece, of S, or of the block.
            let length = (self.rows - place).min(self.rows - to).min(rows.end - next);
            let from = next - rows.start;
            runs.push(Run { from: from..from + length, to });
            next += length;
        }
        runs
    }
}

fn sign(row: usize) -> f64 {
    let bits = random_bits((row / 64) as u64);
    if bits >> (row % 64) & 1 == 0 { 1.0 } else { -1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::correlation::gram;
    use faer::Mat;

    fn sketch(z: &Mat<f64>, blocks: usize) -> Mat<f64> {
        let of = Sketch::new(z.ncols());
        let mut s = Mat::zeros(of.rows(), z.ncols());
        let size = z.nrows().div_ceil(blocks);
        for first in (0..z.nrows()).step_by(size) {
            let z = z.subrows(first, size.min(z.nrows() - first));
            of.add(s.as_mut(), z, first);
        }
        s
    }

    /// Each row of T has a length of its own; a column has four entries, or fewer where they meet.
    #[test]
    fn every_row_enters_four_times() {
        let (rows, of) = (300, Sketch::new(20));
        let mut t = Mat::<f64>::zeros(of.rows(), rows);
        for k in 0..rows {
            let unit = Mat::from_fn(1, 1, |_, _| 1.0);
            of.add(t.as_mut().subcols_mut(k, 1), unit.as_ref(), k);
        }
        let entries = |k: usize| t.col(k).iter().map(|t| t.abs()).sum::<f64>();
        assert!((0..rows).all(|k| [0.0, 2.0, 4.0].contains(&entries(k))));
        assert!((0..rows).filter(|&k| entries(k) == 4.0).count() > rows * 9 / 10);
        let z = Mat::from_fn(rows, 20, |i, j| ((i * i + 7 * j) % 19) as f64 - 9.0);
        for blocks in [1, 2, 7, 300] {
            assert_eq!(sketch(&z, blocks), &t * &z, "{blocks} blocks");
        }
    }

    /// The limits of the documentation, a little wider as these are those of long rows of numbers, for rows of equal weight and for few that hold everything.
    #[test]
    fn lengths_are_kept_for_every_combination_of_columns() {
        let m = 40;
        let spread = Mat::from_fn(20_000, m, |i, j| ((i * i + 31 * j + 7 * i * j) as f64).sin());
        let few = Mat::from_fn(20_000, m, |i, j| if i % 317 == 3 { spread[(i, j)] } else { 0.0 });
        for z in [spread, few] {
            let r = crate::dense::cholesky_upper(gram(z.as_ref()).as_ref())
                .expect("independent columns");
            let inverse = crate::dense::upper_inverse(r.as_ref()).expect("independent columns");
            let change = gram((sketch(&z, 9) * inverse * faer::Scale(0.5)).as_ref());
            let (values, _) = crate::dense::eigen_descending(change.as_ref()).expect("values");
            assert!(values[m - 1] > 0.05 && values[0] < 3.5, "{} to {}", values[m - 1], values[0]);
        }
    }
}
