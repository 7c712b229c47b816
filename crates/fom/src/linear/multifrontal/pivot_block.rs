//! The square block of a front that is eliminated: inverted when small, factorised when not.

use super::SingularMatrix;
use crate::linear::Scalar;
use crate::linear::kernel::add_scaled;
use crate::linear::simd::vectorised;
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve as triangular;
use faer::prelude::{Reborrow, ReborrowMut};
use faer::{Accum, MatMut, MatRef, Par};

/// Pivots up to which the inverse is cheaper than solving with triangles.
pub(super) const SMALL: usize = 48;
/// Columns that are factorised without products of matrices.
const PANEL: usize = 16;

/// What a pivot must exceed: the round-off of its row times that of its column.
pub(super) struct Floors<'a, T> {
    /// One for each row of the block; it follows the exchanges of rows.
    pub rows: &'a mut [T],
    /// One for each column.
    pub columns: &'a [T],
}

impl<T: Scalar> Floors<'_, T> {
    fn check(&self, row: usize, column: usize, pivot: T) -> Result<(), Refused> {
        let least = self.rows[row] * self.columns[column];
        // Not finite is refused, too.
        if pivot.magnitude() > least && (T::from_f64(1.0) / pivot).magnitude() > T::default() {
            return Ok(());
        }
        Err(Refused { column, pivot: pivot.magnitude().to_f64(), least: least.to_f64() })
    }
}

/// The pivot of a column of the block is no larger than round-off.
pub(super) struct Refused {
    pub column: usize,
    pub pivot: f64,
    pub least: f64,
}

impl Refused {
    pub fn of(self, unknown: u32) -> SingularMatrix {
        SingularMatrix { unknown: unknown as usize, pivot: self.pivot, least: self.least }
    }
}

/// Replaces the leading square block of the columns by its inverse (Gauss and Jordan), with
/// exchanges of rows.
///
/// * `a`: columns of length `stride`, of which the first rows are the block
pub(super) fn invert<T: Scalar>(
    a: &mut [T],
    stride: usize,
    exchanges: &mut [u32],
    floors: &mut Floors<'_, T>,
) -> Result<(), Refused> {
    vectorised(
        #[inline(always)]
        || invert_inlined(a, stride, exchanges, floors),
    )
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "unknowns are numbered in 32 bits")]
fn invert_inlined<T: Scalar>(
    a: &mut [T],
    stride: usize,
    exchanges: &mut [u32],
    floors: &mut Floors<'_, T>,
) -> Result<(), Refused> {
    let size = exchanges.len();
    let mut column = [T::default(); SMALL];
    // Whole vectors: below the block zeros are subtracted.
    let wide = size.next_multiple_of(8).min(stride);
    for p in 0..size {
        let row = largest(&a[p * stride..][..size], p);
        exchange(a, stride, size, p, row);
        floors.rows.swap(p, row);
        exchanges[p] = row as u32;
        column[..size].copy_from_slice(&a[p * stride..][..size]);
        floors.check(p, p, column[p])?;
        let inverse = T::from_f64(1.0) / column[p];
        column[p] = T::default();
        for (j, other) in a.chunks_mut(stride).take(size).enumerate() {
            let other = &mut other[..wide];
            if j == p {
                for (x, &c) in other[..size].iter_mut().zip(&column) {
                    *x = -(c * inverse);
                }
                other[p] = inverse;
            } else {
                let scaled = other[p] * inverse;
                other[p] = scaled;
                add_scaled(other, &column[..wide], -scaled);
            }
        }
    }
    for p in (0..size).rev() {
        let q = exchanges[p] as usize;
        if q != p {
            let (low, high) = a.split_at_mut(q * stride);
            low[p * stride..][..size].swap_with_slice(&mut high[..size]);
        }
    }
    Ok(())
}

/// Replaces the leading square block by its factors L and U, with exchanges of rows: the left half of
/// the columns, then with products of matrices the right half (Toledo, 1997).
pub(super) fn factorise<T: Scalar>(
    a: &mut [T],
    stride: usize,
    exchanges: &mut [u32],
    floors: &mut Floors<'_, T>,
) -> Result<(), Refused> {
    let size = exchanges.len();
    factorise_columns(a, Shape { stride, size, top: 0 }, exchanges, floors)
}

/// Columns of a block from the one whose diagonal is in row `top` on.
#[derive(Clone, Copy)]
struct Shape {
    stride: usize,
    size: usize,
    top: usize,
}

impl Shape {
    /// Rows from `from` to `to` of the first `columns` of these columns.
    fn view<T>(self, a: &[T], from: usize, to: usize, columns: usize) -> MatRef<'_, T> {
        MatRef::from_column_major_slice_with_stride(&a[from..], to - from, columns, self.stride)
    }
}

fn factorise_columns<T: Scalar>(
    a: &mut [T],
    shape: Shape,
    exchanges: &mut [u32],
    floors: &mut Floors<'_, T>,
) -> Result<(), Refused> {
    let columns = exchanges.len();
    if columns <= PANEL {
        return vectorised(
            #[inline(always)]
            || factorise_panel(a, shape, exchanges, floors),
        );
    }
    let half = (columns / 2).next_multiple_of(8);
    let Shape { stride, size, top } = shape;
    let (left, right) = a.split_at_mut(half * stride);
    factorise_columns(left, shape, &mut exchanges[..half], floors)?;
    for (p, &q) in (top..).zip(&exchanges[..half]) {
        exchange(right, stride, columns - half, p, q as usize);
    }
    let bottom = MatMut::from_column_major_slice_with_stride_mut(
        &mut right[top..],
        size - top,
        columns - half,
        stride,
    );
    let (mut above, below) = bottom.split_at_row_mut(half);
    let triangle = shape.view(left, top, top + half, half);
    triangular::solve_unit_lower_triangular_in_place(triangle, above.rb_mut(), Par::Seq);
    let rest = shape.view(left, top + half, size, half);
    matmul(below, Accum::Add, rest, above.rb(), -T::from_f64(1.0), Par::Seq);
    let lower = Shape { top: top + half, ..shape };
    factorise_columns(right, lower, &mut exchanges[half..], floors)?;
    for (p, &q) in (top + half..).zip(&exchanges[half..]) {
        exchange(left, stride, half, p, q as usize);
    }
    Ok(())
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "unknowns are numbered in 32 bits")]
fn factorise_panel<T: Scalar>(
    a: &mut [T],
    shape: Shape,
    exchanges: &mut [u32],
    floors: &mut Floors<'_, T>,
) -> Result<(), Refused> {
    let Shape { stride, size, top } = shape;
    let columns = exchanges.len();
    for c in 0..columns {
        let p = top + c;
        let row = largest(&a[c * stride..][..size], p);
        exchange(a, stride, columns, p, row);
        floors.rows.swap(p, row);
        exchanges[c] = row as u32;
        let (done, rest) = a.split_at_mut((c + 1) * stride);
        let column = &mut done[c * stride..][..size];
        floors.check(p, p, column[p])?;
        let inverse = T::from_f64(1.0) / column[p];
        let below = &mut column[p + 1..];
        for x in below.iter_mut() {
            *x *= inverse;
        }
        for other in rest.chunks_mut(stride).take(columns - c - 1) {
            let (above, lower) = other[..size].split_at_mut(p + 1);
            add_scaled(lower, below, -above[p]);
        }
    }
    Ok(())
}

/// `w ← A₁₁⁻¹ w` for the block that [`factorise`] left in `a`.
pub(super) fn solve_matrix<T: Scalar>(a: &[T], stride: usize, exchanges: &[u32], w: &mut [T]) {
    let size = exchanges.len();
    let columns = w.len() / size;
    for (p, &q) in exchanges.iter().enumerate() {
        exchange(w, size, columns, p, q as usize);
    }
    let mut w = MatMut::from_column_major_slice_mut(w, size, columns);
    let block = Shape { stride, size, top: 0 }.view(a, 0, size, size);
    triangular::solve_unit_lower_triangular_in_place(block, w.rb_mut(), Par::Seq);
    triangular::solve_upper_triangular_in_place(block, w, Par::Seq);
}

/// `x ← A₁₁⁻¹ x` for one vector.
#[inline(always)]
pub(super) fn solve_vector<T: Scalar>(a: &[T], stride: usize, exchanges: &[u32], x: &mut [T]) {
    let size = exchanges.len();
    for (p, &q) in exchanges.iter().enumerate() {
        x.swap(p, q as usize);
    }
    for p in 0..size {
        let (above, below) = x.split_at_mut(p + 1);
        add_scaled(below, &a[p * stride + p + 1..][..size - p - 1], -above[p]);
    }
    for p in (0..size).rev() {
        let (above, below) = x.split_at_mut(p);
        below[0] /= a[p * stride + p];
        add_scaled(above, &a[p * stride..][..p], -below[0]);
    }
}

/// The row, from `from` on, with the largest entry.
#[inline(always)]
fn largest<T: Scalar>(column: &[T], from: usize) -> usize {
    let mut best = (from, column[from].magnitude());
    for (i, x) in column.iter().enumerate().skip(from + 1) {
        if x.magnitude() > best.1 {
            best = (i, x.magnitude());
        }
    }
    best.0
}

#[inline(always)]
fn exchange<T: Scalar>(a: &mut [T], stride: usize, columns: usize, p: usize, q: usize) {
    if p != q {
        for column in a.chunks_mut(stride).take(columns) {
            column.swap(p, q);
        }
    }
}
