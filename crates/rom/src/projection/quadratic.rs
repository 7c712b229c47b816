/// The symmetric part of a tensor `T_nmp` that is only ever contracted as `sum_mp T_nmp a_m a_p`.
///
/// Pairs with m <= p are kept, `T_nmp + T_npm` where m < p; the entries of one pair lie together
/// over n, so that a contraction is a sum of scaled rows.
pub(crate) fn pairs(width: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..width).flat_map(move |m| (m..width).map(move |p| (m, p)))
}

/// `out_n −= sum_mp T_nmp a_m a_p` for `tensor` in the order of [`pairs`].
pub(crate) fn subtract_contraction(tensor: &[f64], a: &[f64], out: &mut [f64]) {
    let mut rows = tensor.chunks_exact(a.len());
    for (m, a_m) in a.iter().enumerate() {
        for (a_p, row) in a[m..].iter().zip(&mut rows) {
            let product = a_m * a_p;
            for (o, t) in out.iter_mut().zip(row) {
                *o -= product * t;
            }
        }
    }
}

/// `out = matrix a` for a symmetric matrix, by rows scaled.
pub(crate) fn multiply(matrix: &[f64], a: &[f64], out: &mut [f64]) {
    out.fill(0.0);
    for (a_m, row) in a.iter().zip(matrix.chunks_exact(a.len())) {
        for (o, t) in out.iter_mut().zip(row) {
            *o += a_m * t;
        }
    }
}
