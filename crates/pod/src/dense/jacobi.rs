//! Singular values to high relative accuracy by one-sided Jacobi rotations.
//!
//! Where columns differ by many orders of magnitude, `A = B D` with D diagonal and B well
//! conditioned, the data hold even the smallest singular value to about `eps cond(B)` of itself.
//! Reduction to bidiagonal form mixes the columns and leaves `eps sigma_1`. Here no step does:
//!
//! 1. `Pr A P = Q R` by Householder reflections, columns pivoted: each column keeps its own
//!    relative accuracy, and the rows of R come out in descending size. Rows that are sorted first
//!    keep theirs too (Cox and Higham 1998), so that `D B` does as well as `B D`.
//! 2. The columns of `X = Rᵀ` are rotated in pairs until all are orthogonal, `X J = W Sigma`. From
//!    `A = (Prᵀ Q J) Sigma (P W)ᵀ` the right singular vectors are `P W`: J is never formed, and
//!    that W is orthonormal is what the iteration stops on.
//!
//! Sources: Hestenes, J. SIAM 6 (1958) 51-90, rotations on one side; de Rijk, SIAM J. Sci. Stat.
//! Comput. 10 (1989) 359-371, the longer column first; Demmel and Veselić, SIAM J. Matrix Anal.
//! Appl. 13 (1992) 1204-1245, the accuracy; Drmač and Veselić, SIAM J. Matrix Anal. Appl. 29 (2008)
//! 1322-1362, the triangular factor and its transpose.

use crate::PodError;
use faer::linalg::householder::make_householder_in_place;
use faer::linalg::jacobi::JacobiRotation;
use faer::linalg::matmul::dot::inner_prod;
use faer::perm::swap_cols_idx;
use faer::{ColRef, Conj, Mat, MatMut, MatRef, unzip, zip};

#[cfg(test)]
mod tests;

/// Random matrices of order 1000, which are the slowest known, take 11.
const SWEEPS: usize = 40;

/// The largest entry is brought to between this, 2^490, and twice this: squares of singular values
/// stay in range up to order 10^6.
const CEILING: f64 = f64::from_bits((1023 + 490) << 52);

/// Columns shorter than this, 2^-440, count as zero: products of longer ones stay in range.
const FLOOR: f64 = f64::from_bits((1023 - 440) << 52);

/// Entries of the columns that are rotated among themselves before others: 256 KiB of the cache.
const TILE: usize = 1 << 15;

/// All singular values of a square matrix of finite entries, largest first, and right singular vectors in columns.
///
/// For `a = B D` or `a = D B`, D diagonal, each value has a relative error of about `eps cond(B)`,
/// however small it is, for any other matrix one of about `eps sigma_1 / sigma_k` at the worst.
/// Vectors are orthonormal to about `eps sqrt(m)`, also those that belong to zeros. Columns below
/// 1e-279 of the largest entry count as zero; values beyond the range of `f64` are infinite.
///
/// Takes 3 to 11 sweeps of 4 m³ flops, the fewer the more graded or the closer to orthogonal the
/// columns are. One thread: the same bits every time.
///
/// # Errors
/// [`PodError::NoConvergence`] where columns that are not orthogonal to round-off remain after 40 sweeps.
pub(crate) fn graded_svd(a: MatRef<'_, f64>) -> Result<(Vec<f64>, Mat<f64>), PodError> {
    let size = a.ncols();
    assert!(a.nrows() == size, "the matrix is {} x {size}, not square", a.nrows());
    let largest = a.norm_max();
    if largest == 0.0 {
        return Ok((vec![0.0; size], Mat::identity(size, size)));
    }
    // A power of two, so that scaling rounds nothing; log2 of `f64::MAX` rounds up to 1024.
    let unit = largest.log2().floor().min(1023.0).exp2();
    let mut r = sort_rows(a, |entry| entry / unit * CEILING);
    let (rank, pivots) = triangularise(r.as_mut());
    let mut x = Mat::from_fn(size, size, |i, j| if i >= j { r[(j, i)] } else { 0.0 });
    orthogonalise(x.as_mut())?;
    let (mut values, vectors) = normalise(x.as_ref(), &pivots);
    values[rank..].fill(0.0);
    for value in &mut values {
        *value = *value / CEILING * unit;
    }
    Ok((values, vectors))
}

/// `a` with every entry scaled, the row with the largest entry first.
fn sort_rows(a: MatRef<'_, f64>, scale: impl Fn(f64) -> f64) -> Mat<f64> {
    let order = descending(a.row_iter().map(|row| row.norm_max()));
    Mat::from_fn(a.nrows(), a.ncols(), |i, j| scale(a[(order[i], j)]))
}

/// Indices of `numbers` from the largest to the smallest.
fn descending(numbers: impl Iterator<Item = f64>) -> Vec<usize> {
    let numbers: Vec<f64> = numbers.collect();
    let mut order: Vec<usize> = (0..numbers.len()).collect();
    order.sort_by(|&i, &j| numbers[j].total_cmp(&numbers[i]));
    order
}

/// Leaves R of `A P = Q R` in the upper triangle. Returns the number of its rows that are not zero
/// and, for each column of R, the column of A that it comes from.
///
/// Rows that are zero become tiny multiples of unit vectors: these complete the orthonormal
/// directions of the others. What is left of the columns is measured anew in every step, not
/// downdated: a pivot taken for longer than it is could leave parallel rows.
fn triangularise(mut a: MatMut<'_, f64>) -> (usize, Vec<usize>) {
    let size = a.ncols();
    let mut pivots: Vec<usize> = (0..size).collect();
    let mut norms: Vec<f64> = a.as_ref().col_iter().map(norm).collect();
    for k in 0..size {
        let longest = (k..size).rev().max_by(|&i, &j| norms[i].total_cmp(&norms[j])).unwrap_or(k);
        if norms[longest] < FLOOR {
            let mut rest = a.submatrix_mut(k, k, size - k, size - k);
            rest.fill(0.0);
            rest.diagonal_mut().fill(FLOOR);
            return (k, pivots);
        }
        swap_cols_idx(a.as_mut(), k, longest);
        pivots.swap(k, longest);
        norms.swap(k, longest);
        reflect(a.as_mut().submatrix_mut(k, k, size - k, size - k), &mut norms[k + 1..]);
    }
    (size, pivots)
}

/// Reflects the first column onto its first entry and the others with it: `y - v (vᵀ y) / tau`,
/// `v = (1, ...)`. Measures the others below their first entry.
fn reflect(a: MatMut<'_, f64>, norms: &mut [f64]) {
    let (first, others) = a.split_at_col_mut(1);
    let (mut head, mut v) = first.col_mut(0).split_at_row_mut(1);
    let tau = make_householder_in_place(&mut head[0], v.as_mut()).tau;
    for (column, norm_left) in others.col_iter_mut().zip(norms) {
        let (mut head, mut y) = column.split_at_row_mut(1);
        let projection = (head[0] + dot(v.as_ref(), y.as_ref())) / tau;
        head[0] -= projection;
        zip!(y.as_mut(), v.as_ref()).for_each(|unzip!(y, v)| *y -= projection * v);
        *norm_left = norm(y.as_ref());
    }
}

/// Sweeps over all pairs of columns until every pair was found orthogonal to round-off,
/// `|xᵀ y| <= eps sqrt(m) |x| |y|`, in one sweep.
fn orthogonalise(mut x: MatMut<'_, f64>) -> Result<(), PodError> {
    let size = x.ncols();
    let tolerance = f64::EPSILON * (size as f64).sqrt();
    for _ in 0..SWEEPS {
        // Updated norms drift; the last sweep rotates nothing and measures with these.
        let mut norms: Vec<f64> = x.as_ref().col_iter().map(norm).collect();
        let mut rotated = false;
        for (p, q) in pairs(size) {
            rotated |= orthogonalise_pair(x.as_mut(), &mut norms, p, q, tolerance);
        }
        if !rotated {
            return Ok(());
        }
    }
    Err(PodError::NoConvergence { size })
}

/// Makes columns `p < q` orthogonal, the longer one first. Returns whether they were not so before.
///
/// With `g = xᵀ y` the tangent is the smaller root of `t² + 2 zeta t = 1`,
/// `zeta = (|y|² - |x|²) / (2 g)`; the longer column gains `|t g|` in its square, the other loses
/// it.
fn orthogonalise_pair(
    x: MatMut<'_, f64>,
    norms: &mut [f64],
    p: usize,
    q: usize,
    tolerance: f64,
) -> bool {
    let (x, y) = x.two_cols_mut(p, q);
    let (a, b) = (norms[p], norms[q]);
    let g = dot(x.as_ref(), y.as_ref());
    if g.abs() <= tolerance * a * b {
        return false;
    }
    let zeta = (b - a) * (b + a) / (2.0 * g);
    let t = 1.0_f64.copysign(zeta) / (zeta.abs() + zeta.hypot(1.0));
    let c = 1.0 / (1.0 + t * t).sqrt();
    // A quarter turn more exchanges the two.
    let (c, s) = if a >= b { (c, t * c) } else { (t * c, -c) };
    JacobiRotation { c, s: -s }.apply_on_the_right_in_place((x, y));
    let (long, short, gain) = (a.max(b), a.min(b), (t * g).abs());
    norms[p] = (long * long + gain).sqrt();
    norms[q] = (short * short - gain).max(0.0).sqrt();
    true
}

/// All `p < q < size`, tile by tile of columns that fit in the cache.
fn pairs(size: usize) -> impl Iterator<Item = (usize, usize)> {
    let width = (TILE / size).max(1);
    let tiles = move |from: usize| (from..size).step_by(width);
    tiles(0).flat_map(move |i| tiles(i).map(move |j| (i, j))).flat_map(move |(i, j)| {
        let (i_end, j_end) = ((i + width).min(size), (j + width).min(size));
        (i..i_end).flat_map(move |p| (j.max(p + 1)..j_end).map(move |q| (p, q)))
    })
}

/// Norms of the columns, largest first, and their directions with the pivoting undone.
fn normalise(x: MatRef<'_, f64>, pivots: &[usize]) -> (Vec<f64>, Mat<f64>) {
    let order = descending(x.col_iter().map(norm));
    let norms: Vec<f64> = order.iter().map(|&k| norm(x.col(k))).collect();
    let mut vectors = Mat::zeros(x.nrows(), x.ncols());
    for (mut vector, (&k, norm)) in vectors.col_iter_mut().zip(order.iter().zip(&norms)) {
        for (&row, entry) in pivots.iter().zip(x.col(k).iter()) {
            vector[row] = entry / norm;
        }
    }
    (norms, vectors)
}

fn norm(x: ColRef<'_, f64>) -> f64 {
    dot(x, x).sqrt()
}

fn dot(x: ColRef<'_, f64>, y: ColRef<'_, f64>) -> f64 {
    inner_prod(x.transpose(), Conj::No, y, Conj::No)
}
