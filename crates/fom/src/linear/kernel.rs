//! Loops over short columns. Inlined into a dispatch over the instruction sets of the processor,
//! where the compiler makes vectors of them; the order of the sums is the same on all of them.

use super::Scalar;

/// Rows that are summed before they are stored.
const ROWS: usize = 32;

/// `y[unknowns] ← y[unknowns] + a x[unknowns]`, a by columns.
#[inline(always)]
pub(super) fn add_cell_product<T: Scalar>(unknowns: &[u32], a: &[T], x: &[T], y: &mut [T]) {
    let size = unknowns.len();
    for (block, rows) in unknowns.chunks(ROWS).enumerate() {
        let mut sums = [T::default(); ROWS];
        let sums = &mut sums[..rows.len()];
        for (column, &unknown) in a.chunks_exact(size).zip(unknowns) {
            add_scaled(sums, &column[block * ROWS..][..rows.len()], x[unknown as usize]);
        }
        for (&unknown, &sum) in rows.iter().zip(sums.iter()) {
            y[unknown as usize] += sum;
        }
    }
}

/// `y ← y + s x`
#[inline(always)]
pub(super) fn add_scaled<T: Scalar>(y: &mut [T], x: &[T], s: T) {
    for (y, &x) in y.iter_mut().zip(x) {
        *y += s * x;
    }
}

/// `y ← y + A x` with A by columns, `stride` entries from one to the next.
#[inline(always)]
pub(super) fn add_product<T: Scalar>(y: &mut [T], a: &[T], stride: usize, x: &[T]) {
    let rows = y.len();
    let column = |j: usize| &a[j * stride..][..rows];
    let quads = x.chunks_exact(4);
    let rest = quads.remainder();
    let done = x.len() - rest.len();
    for (q, x) in quads.enumerate() {
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| column(4 * q + k));
        for i in 0..rows {
            y[i] += (a[i] * x[0] + b[i] * x[1]) + (c[i] * x[2] + d[i] * x[3]);
        }
    }
    for (j, &x) in rest.iter().enumerate() {
        add_scaled(y, column(done + j), x);
    }
}
