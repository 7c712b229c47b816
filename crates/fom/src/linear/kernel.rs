//! Loops over short columns. Inlined into a dispatch over the instruction sets of the processor,
//! where the compiler makes vectors of them; the order of the sums is the same on all of them.

use super::Scalar;

/// Numbers of a vector register, or of two.
const LANES: usize = 8;
/// Rows that are summed up in vector registers.
pub(super) const STRIP: usize = 4 * LANES;

/// `y[unknowns] ← y[unknowns] + a x[unknowns]`, a by columns.
///
/// * `a`: from the first entry of the cell's matrix on; what follows it may be read
#[inline(always)]
pub(super) fn add_cell_product<T: Scalar>(unknowns: &[u32], a: &[T], x: &[T], y: &mut [T]) {
    let size = unknowns.len();
    let mut gathered = [T::default(); STRIP];
    for (columns, chunk) in unknowns.chunks(STRIP).enumerate() {
        for (to, &unknown) in gathered.iter_mut().zip(chunk) {
            *to = x[unknown as usize];
        }
        for (rows, unknowns) in unknowns.chunks(STRIP).enumerate() {
            let mut product = [T::default(); STRIP];
            let product = &mut product[..unknowns.len()];
            let block = &a[rows * STRIP + columns * STRIP * size..];
            add_product(product, block, size, &gathered[..chunk.len()]);
            for (&unknown, &sum) in unknowns.iter().zip(product.iter()) {
                y[unknown as usize] += sum;
            }
        }
    }
}

/// `y ← y + s x`, both of the same length. Short vectors are vectors, too, but for their last seven numbers.
#[inline(always)]
pub(super) fn add_scaled<T: Scalar>(y: &mut [T], x: &[T], s: T) {
    let (ys, y) = y.as_chunks_mut::<LANES>();
    let (xs, x) = x.as_chunks::<LANES>();
    for (y, x) in ys.iter_mut().zip(xs) {
        for (y, &x) in y.iter_mut().zip(x) {
            *y += s * x;
        }
    }
    for (y, &x) in y.iter_mut().zip(x) {
        *y += s * x;
    }
}

/// `y ← y + A x` with A by columns, `stride` entries from one to the next.
///
/// * `a`: from the first entry on; what follows the last one may be read
#[inline(always)]
pub(super) fn add_product<T: Scalar>(y: &mut [T], a: &[T], stride: usize, x: &[T]) {
    for (s, y) in y.chunks_mut(STRIP).enumerate() {
        let a = &a[s * STRIP..];
        match y.len() {
            0..=8 => add_strip::<T, 8>(y, a, stride, x),
            9..=16 => add_strip::<T, 16>(y, a, stride, x),
            17..=24 => add_strip::<T, 24>(y, a, stride, x),
            _ => add_strip::<T, STRIP>(y, a, stride, x),
        }
    }
}

/// A strip of at most `ROWS` rows. That many are read of each column, and what is beyond dropped.
#[inline(always)]
fn add_strip<T: Scalar, const ROWS: usize>(y: &mut [T], a: &[T], stride: usize, x: &[T]) {
    let readable = a.len().checked_sub(ROWS).map_or(0, |rest| rest / stride + 1);
    let (within, beyond) = x.split_at(readable.min(x.len()));
    let mut sums = [T::default(); ROWS];
    for (j, &x) in within.iter().enumerate() {
        let column: &[T; ROWS] = a[j * stride..].first_chunk().expect("readable");
        for (sum, &a) in sums.iter_mut().zip(column) {
            *sum += a * x;
        }
    }
    for (y, &sum) in y.iter_mut().zip(&sums) {
        *y += sum;
    }
    for (j, &x) in beyond.iter().enumerate() {
        add_scaled(y, &a[(within.len() + j) * stride..][..y.len()], x);
    }
}
