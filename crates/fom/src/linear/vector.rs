//! Sums over long vectors. The order of the sums is the same on all processors.

use super::kernel;
use super::simd::vectorised;

/// Partial sums of a dot product.
const LANES: usize = 16;

/// `x·y`
pub(super) fn dot(x: &[f64], y: &[f64]) -> f64 {
    vectorised(
        #[inline(always)]
        || {
            let mut sums = [0.0; LANES];
            let (xs, ys) = (x.chunks_exact(LANES), y.chunks_exact(LANES));
            let rest = xs.remainder().iter().zip(ys.remainder()).map(|(x, y)| x * y).sum::<f64>();
            for (x, y) in xs.zip(ys) {
                for k in 0..LANES {
                    sums[k] += x[k] * y[k];
                }
            }
            sums.iter().sum::<f64>() + rest
        },
    )
}

/// `|x|`
pub(super) fn norm(x: &[f64]) -> f64 {
    dot(x, x).sqrt()
}

/// `y ← y + s x`
pub(super) fn add_scaled(y: &mut [f64], x: &[f64], s: f64) {
    vectorised(
        #[inline(always)]
        || kernel::add_scaled(y, x, s),
    );
}

/// `x ← s x`
pub(super) fn scale(x: &mut [f64], s: f64) {
    for x in x {
        *x *= s;
    }
}
