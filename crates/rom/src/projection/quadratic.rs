//! Contractions of tensors with few coefficients, laid out so that sums stay in registers.

use crate::basis::dot;

/// Rows of a tensor that are summed together.
const BLOCK: usize = 4;

/// How a tensor `T_nmp` is stored that is only ever contracted as `sum_mp T_nmp a_m a_p`: the indices
/// (n, m, p) of its entries in order.
///
/// Pairs with m <= p are kept, for `T_nmp + T_npm` where m < p. All pairs of four rows n come before
/// those of the next four; the last block is padded with rows n >= `width`, whose entries are zero.
pub(crate) fn entries(width: usize) -> impl Iterator<Item = (usize, usize, usize)> {
    let pairs = move || (0..width).flat_map(move |m| (m..width).map(move |p| (m, p)));
    let rows = |(first, (m, p))| (first..first + BLOCK).map(move |n| (n, m, p));
    (0..width).step_by(BLOCK).flat_map(move |n| pairs().map(move |pair| (n, pair))).flat_map(rows)
}

/// Number of [`entries`].
pub(crate) fn entry_count(width: usize) -> usize {
    width.next_multiple_of(BLOCK) * width * (width + 1) / 2
}

/// `out_n −= sum_mp T_nmp a_m a_p` for a `tensor` in the order of [`entries`].
pub(crate) fn subtract_contraction(tensor: &[f64], a: &[f64], out: &mut [f64]) {
    let (quads, _) = tensor.as_chunks::<BLOCK>();
    let pairs = a.len() * (a.len() + 1) / 2;
    for (block, out) in quads.chunks_exact(pairs).zip(out.chunks_mut(BLOCK)) {
        let mut sum = [0.0; BLOCK];
        let mut quads = block.iter();
        for (m, a_m) in a.iter().enumerate() {
            for (a_p, quad) in a[m..].iter().zip(&mut quads) {
                let product = a_m * a_p;
                for (s, t) in sum.iter_mut().zip(quad) {
                    *s += product * t;
                }
            }
        }
        for (o, s) in out.iter_mut().zip(sum) {
            *o -= s;
        }
    }
}

/// `out = matrix a` for a square matrix, row by row.
pub(crate) fn multiply(matrix: &[f64], a: &[f64], out: &mut [f64]) {
    for (o, row) in out.iter_mut().zip(matrix.chunks_exact(a.len())) {
        *o = dot(row, a);
    }
}
