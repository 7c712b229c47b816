//! `C <- C + Zᵀ Z` for a block of rows: the work that grows with n in every POD.

use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::{Accum, MatMut, MatRef, Par};

/// Columns of the smallest tile on the diagonal: the height of the widest register tile of `matmul`,
/// and a multiple of that of the others.
const TILE: usize = 48;

/// Depth to which `matmul` packs at once.
const DEPTH: usize = 512;

/// Rows of a block of m columns: a multiple of the depth of one packing and, up to 256 columns, at
/// most 1 MiB, so that the block is still in the second-level cache when its product is formed.
pub(crate) fn rows_per_block(m: usize) -> usize {
    const ENTRIES: usize = (1 << 20) / size_of::<f64>();
    DEPTH * (ENTRIES / (DEPTH * m.max(1))).clamp(1, 4)
}

/// `C <- C + Zᵀ Z`, the lower triangle alone: k m (m + 1) operations on one thread.
///
/// * `c`: m x m; what is above its diagonal is neither read nor written
/// * `z`: k x m, fastest with contiguous columns
///
/// The columns are halved and nearly all work is left to plain products. One triangular product
/// would fill whole register tiles along the diagonal: 23 % more entries than needed at m = 200 with
/// AVX-512, of which this leaves 11 %. The order of summation depends on the shape alone; the error
/// of an entry of the product is at most `k ε |z_i|ᵀ |z_j|`.
///
/// # Panics
/// If the shapes do not match.
pub(crate) fn add_gram(c: MatMut<'_, f64>, z: MatRef<'_, f64>) {
    let m = z.ncols();
    assert_eq!(c.shape(), (m, m), "shape of the Gram matrix of {m} columns");
    if m <= TILE {
        let (full, lower) = (BlockStructure::Rectangular, BlockStructure::TriangularLower);
        triangular::matmul(c, lower, Accum::Add, z.transpose(), full, z, full, 1.0, Par::Seq);
        return;
    }
    let left = m - (m / 2 / TILE).max(1) * TILE;
    let (a, b) = z.split_at_col(left);
    let (c_aa, _, c_ba, c_bb) = c.split_at_mut(left, left);
    add_gram(c_aa, a);
    matmul(c_ba, Accum::Add, b.transpose(), a, 1.0, Par::Seq);
    add_gram(c_bb, b);
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::Mat;

    /// Small integers: every sum is exact, whatever its order.
    fn integers(k: usize, m: usize) -> Mat<f64> {
        Mat::from_fn(k, m, |i, j| ((7 * i + 13 * j + i * j) % 17) as f64 - 8.0)
    }

    #[test]
    fn integer_products_are_exact_at_and_below_the_diagonal() {
        for m in [1, 5, 47, 48, 49, 96, 97, 143, 200] {
            for k in [1, 8, 530] {
                let z = integers(k, m);
                let start = |i: usize, j: usize| if i < j { f64::NAN } else { (i + 3 * j) as f64 };
                let mut c = Mat::from_fn(m, m, start);
                add_gram(c.as_mut(), z.as_ref());
                for j in 0..m {
                    assert!((0..j).all(|i| c[(i, j)].is_nan()), "written above the diagonal");
                    for i in j..m {
                        let dot: f64 = (0..k).map(|r| z[(r, i)] * z[(r, j)]).sum();
                        assert_eq!(c[(i, j)], start(i, j) + dot, "m = {m}, k = {k}, ({i}, {j})");
                    }
                }
            }
        }
    }

    #[test]
    fn part_of_a_larger_block_gives_the_bits_of_its_copy() {
        let z = Mat::from_fn(700, 120, |i, j| ((i * i + 31 * j) as f64).sin());
        let part = z.submatrix(3, 2, 513, 101);
        let (mut c, mut d) = (Mat::zeros(101, 101), Mat::zeros(101, 101));
        add_gram(c.as_mut(), part);
        add_gram(d.as_mut(), part.to_owned().as_ref());
        assert_eq!(c, d);
    }

    #[test]
    fn no_rows_and_no_columns_add_nothing() {
        let mut c = Mat::from_fn(60, 60, |i, j| (i * j) as f64);
        add_gram(c.as_mut(), Mat::zeros(0, 60).as_ref());
        assert_eq!(c, Mat::from_fn(60, 60, |i, j| (i * j) as f64));
        add_gram(Mat::zeros(0, 0).as_mut(), Mat::zeros(9, 0).as_ref());
    }

    #[test]
    fn blocks_stay_in_the_cache_until_they_are_wider_than_it() {
        let rows = [0, 1, 64, 65, 128, 129, 200, 256, 2000].map(rows_per_block);
        assert_eq!(rows, [2048, 2048, 2048, 1536, 1024, 512, 512, 512, 512]);
    }
}
