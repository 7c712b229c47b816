//! Nearly orthogonal columns from a sketch of the snapshots.

use super::svd::ENOUGH;
use crate::PodError;
use crate::contiguous::gather;
use crate::correlation::{Preconditioner, gram};
use crate::dense::{PivotedCholesky, are_independent, product};
use crate::kernel::{COPIES, Sketch, solve_right};
use crate::partial::Partial;
use crate::run::Run;
use faer::{Mat, MatRef};
use std::ops::Range;

/// Share of the square of a column under which the square of a remainder is round-off of sums over many
/// rows and eliminations over many columns, which adds up as noise does.
pub(super) fn squares_floor(m: usize) -> f64 {
    8.0 * f64::EPSILON * (m as f64).sqrt()
}

/// The same where the columns are nearly orthogonal.
pub(super) const ROUND_OFF: f64 = 4.0 * f64::EPSILON;

/// How the columns of F X become nearly orthogonal.
pub(super) struct Start {
    pub preconditioner: Preconditioner,
    /// Number of columns, the first, that are far from round-off.
    pub resolved: usize,
    /// Square of the norm of each column before, nearly.
    squares: Vec<f64>,
}

impl Start {
    /// Whether the Gram matrix of the columns that were made loses nothing: those that are resolved are
    /// independent, and what they leave of the others is so small that its square is round-off.
    pub fn is_sound(&self, gram: MatRef<'_, f64>) -> bool {
        let small = |k: usize| gram[(k, k)] <= f64::EPSILON * self.squares[k];
        are_independent(gram.get(..self.resolved, ..self.resolved), ENOUGH)
            && (self.resolved..gram.ncols()).all(small)
    }

    /// As one rank tells it to others.
    fn into_numbers(self) -> Vec<f64> {
        let Self { preconditioner: Preconditioner { order, unit }, resolved, squares } = self;
        let counts = order.into_iter().chain([resolved]).map(|k| f64::from_bits(k as u64));
        counts.chain(squares).chain(unit.col_iter().flat_map(|u| u.iter().copied())).collect()
    }

    /// * `numbers`: of m columns
    fn of_numbers(numbers: &[f64], m: usize) -> Self {
        let (counts, numbers) = numbers.split_at(m + 1);
        let (squares, unit) = numbers.split_at(m);
        let count = |k: &f64| usize::try_from(k.to_bits()).expect("the number of a column");
        let order = counts[..m].iter().map(count).collect();
        let unit = MatRef::from_column_major_slice(unit, m, m).to_owned();
        let preconditioner = Preconditioner { order, unit };
        Self { preconditioner, resolved: count(&counts[m]), squares: squares.to_vec() }
    }
}

/// One pass over the snapshots; nothing where the sketch cannot be factored.
pub(super) fn sketched(run: &Run<'_>) -> Result<Option<Start>, PodError> {
    let (_, m) = run.ensemble.shape();
    let sketch = sketch(run)?;
    let told =
        run.agreed(|| Ok(start(sketch.as_ref()).map(Start::into_numbers).unwrap_or_default()))?;
    Ok((!told.is_empty()).then(|| Start::of_numbers(&told, m)))
}

fn sketch(run: &Run<'_>) -> Result<Mat<f64>, PodError> {
    let (ensemble, (_, m)) = (run.ensemble, run.ensemble.shape());
    let sketch = Sketch::new(m);
    let part = |rows: Range<usize>| {
        let mut sum = Partial::zeros(sketch.rows() * m, 0);
        ensemble.for_tiles(rows.clone(), &mut |mut tile| {
            tile.for_blocks(ensemble, &ensemble.every, &mut |first, z| {
                sketch.add(sum.matrix_mut(sketch.rows(), m), z.as_ref(), first);
            })
        })?;
        let finite = sum.sums.iter().all(|x| x.is_finite());
        if finite { Ok(sum) } else { Err(ensemble.not_finite(rows)) }
    };
    let sum = run.over_snapshots("sketch", &part)?;
    Ok(sum.matrix(sketch.rows(), m).to_owned())
}

/// The factor of the sketch `S P = Q D U`, not squared: of its Gram matrix first, then of that of the nearly
/// orthogonal columns that come of that, which enter in the order that they have.
fn start(s: MatRef<'_, f64>) -> Option<Start> {
    let m = s.ncols();
    let squares = gram(s);
    let coarse = PivotedCholesky::new(squares.as_ref(), squares_floor(m));
    let mut y = Mat::zeros(s.nrows(), m);
    gather(s, &coarse.order, y.as_mut());
    solve_right(y.as_mut(), coarse.unit.as_ref());
    let g = gram(y.as_ref());
    // What is left of a column and not far above its own round-off is of no use.
    let noise = (64.0 * f64::EPSILON).powi(2) * m as f64;
    let floor =
        |k: usize| (ROUND_OFF * g[(k, k)]).max(noise * squares[(coarse.order[k], coarse.order[k])]);
    let floors: Vec<f64> = (0..m).map(floor).collect();
    let fine = PivotedCholesky::with_floors(g.as_ref(), &floors, coarse.resolved);
    if fine.resolved < coarse.resolved {
        return None;
    }
    // Only columns that the first could not tell apart change places: U stays triangular.
    let before = Mat::from_fn(m, m, |i, k| coarse.unit[(fine.order[i], fine.order[k])]);
    let unit = product(fine.unit.as_ref(), before.as_ref());
    let order: Vec<usize> = fine.order.iter().map(|&k| coarse.order[k]).collect();
    let squares = order.iter().map(|&j| squares[(j, j)] / COPIES as f64).collect();
    Some(Start { preconditioner: Preconditioner { order, unit }, resolved: fine.resolved, squares })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Identity, MemorySnapshots, Options, svd};

    const N: usize = 400;

    /// A combination of rows that every sketch of two columns overlooks.
    fn overlooked() -> Vec<f64> {
        let sketch = Sketch::new(2);
        let mut t = Mat::zeros(sketch.rows(), N);
        for k in 0..N {
            sketch.add(t.as_mut().subcols_mut(k, 1), Mat::from_fn(1, 1, |_, _| 1.0).as_ref(), k);
        }
        let svd = t.svd().expect("an SVD");
        svd.V().col(N - 1).iter().copied().collect()
    }

    #[test]
    fn what_the_sketch_misses_is_found_all_the_same() {
        let missed = overlooked();
        let seen = |i: usize| (0.3 * i as f64).sin();
        let difference = |i: usize| 1e-3 * missed[i];
        let x = Mat::from_fn(N, 2, |i, j| seen(i) + j as f64 * difference(i));
        let dot = |a: &dyn Fn(usize) -> f64, b: &dyn Fn(usize) -> f64| -> f64 {
            (0..N).map(|i| a(i) * b(i)).sum()
        };
        let x = MemorySnapshots::new(x, vec![0.0, 1.0]);
        let basis = svd(&x, &Identity::new(N), &Options::default()).expect("a decomposition");
        // The volume that both columns span.
        let square =
            dot(&seen, &seen) * dot(&difference, &difference) - dot(&seen, &difference).powi(2);
        let product: f64 = basis.spectrum.iter().map(|l| (2.0 * l).sqrt()).product();
        assert!((product / square.sqrt() - 1.0).abs() < 1e-11, "{product:e} {square:e}");
        assert!(basis.passes > 3, "the sketch was enough");
    }

    /// What the factor of a sketch makes of the sketch itself.
    #[test]
    fn columns_of_the_sketch_become_orthogonal() {
        let m = 30;
        let s = Mat::from_fn(90, m, |i, j| {
            let wave = |k: usize| ((i * i + 31 * k + 7 * i * k) as f64).sin();
            wave(0) + 10_f64.powf(-0.4 * j as f64) * wave(j)
        });
        let Start { preconditioner: Preconditioner { order, unit }, resolved, .. } =
            start(s.as_ref()).expect("a factor");
        assert_eq!(resolved, m);
        let mut y = Mat::zeros(90, m);
        gather(s.as_ref(), &order, y.as_mut());
        solve_right(y.as_mut(), unit.as_ref());
        let g = gram(y.as_ref());
        for i in 0..m {
            for j in 0..i {
                let cosine = g[(i, j)] / (g[(i, i)] * g[(j, j)]).sqrt();
                assert!(cosine.abs() < 1e-2, "({i}, {j}): {cosine:e}");
            }
        }
    }
}
