//! `Z <- Z U⁻¹` for a block of rows: change to the basis whose coordinates a Cholesky factor gives.

use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::solve_unit_lower_triangular_in_place;
use faer::{Accum, MatMut, MatRef, Par};

/// Columns that are substituted without plain products.
const PANEL: usize = 16;

/// `Z <- Z U⁻¹` by blocked substitution: k m² operations on one thread, nearly all in plain products.
///
/// * `z`: k x m, fastest with contiguous columns
/// * `u`: m x m, unit upper triangular; its diagonal and what is below are not read
///
/// With `U = [U₁₁ U₁₂; 0 U₂₂]`: `Z₁ <- Z₁ U₁₁⁻¹`, `Z₂ <- (Z₂ - Z₁ U₁₂) U₂₂⁻¹`. No inverse is formed, so
/// every row is backward stable: `|Ẑ U - Z| ≤ m ε |Ẑ| |U|` entry by entry (Higham, Accuracy and
/// Stability of Numerical Algorithms, 2002, theorem 8.5).
///
/// # Panics
/// If the shapes do not match.
pub(crate) fn solve_right(z: MatMut<'_, f64>, u: MatRef<'_, f64>) {
    let m = z.ncols();
    assert_eq!(u.shape(), (m, m), "shape of the factor of {m} columns");
    if m <= PANEL {
        solve_unit_lower_triangular_in_place(u.transpose(), z.transpose_mut(), Par::Seq);
        return;
    }
    let left = (m / 2).next_multiple_of(PANEL);
    let (u_11, u_12, _, u_22) = u.split_at(left, left);
    let (mut z_1, mut z_2) = z.split_at_col_mut(left);
    solve_right(z_1.as_mut(), u_11);
    matmul(z_2.as_mut(), Accum::Add, z_1.as_ref(), u_12, -1.0, Par::Seq);
    solve_right(z_2, u_22);
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::Mat;

    /// `w U` summed in order, U's diagonal 1 and its lower part 0 whatever is stored there.
    fn times_unit_upper(w: &Mat<f64>, u: &Mat<f64>) -> Mat<f64> {
        Mat::from_fn(w.nrows(), w.ncols(), |r, j| {
            w[(r, j)] + (0..j).map(|i| w[(r, i)] * u[(i, j)]).sum::<f64>()
        })
    }

    #[test]
    fn integers_come_back_exactly() {
        for m in [0, 1, 15, 16, 17, 33, 100, 200] {
            let w = Mat::from_fn(37, m, |i, j| ((7 * i + 13 * j + i * j) % 17) as f64 - 8.0);
            let sparse = |i: usize, j: usize| ((i * i + 5 * j) % 7) as f64 - 3.0;
            let u = Mat::from_fn(m, m, |i, j| if i < j { sparse(i, j) } else { f64::NAN });
            let mut z = times_unit_upper(&w, &u);
            solve_right(z.as_mut(), u.as_ref());
            assert_eq!(z, w, "m = {m}");
        }
    }

    /// The bound of the documentation, on rows and columns of very different size.
    #[test]
    fn residual_is_componentwise_small() {
        let (k, m) = (61, 150);
        let wave = |i: usize, j: usize| ((i * i + 31 * j + 7 * i * j) as f64).sin();
        let u = Mat::from_fn(m, m, |i, j| if i < j { 10.0 * wave(i, j) / m as f64 } else { 0.0 });
        let start =
            Mat::from_fn(k, m, |i, j| wave(j, i) * 10f64.powf(j as f64 / 10.0 - i as f64 / 5.0));
        let mut z = start.clone();
        solve_right(z.as_mut(), u.as_ref());
        let back = times_unit_upper(&z, &u);
        let abs = |a: &Mat<f64>| Mat::from_fn(a.nrows(), a.ncols(), |i, j| a[(i, j)].abs());
        let size = times_unit_upper(&abs(&z), &abs(&u));
        for j in 0..m {
            for i in 0..k {
                let residual = (back[(i, j)] - start[(i, j)]).abs();
                let bound = m as f64 * f64::EPSILON * size[(i, j)];
                assert!(residual <= bound, "({i}, {j}): {residual:e} > {bound:e}");
            }
        }
    }
}
