//! What a pivot must exceed to count as one.

use super::analysis::Analysis;
use crate::linear::Scalar;
use crate::linear::kernel::STRIP;
use crate::linear::simd::vectorised;

/// Sets the floors so that entry (i, j) is round-off below `rows[i] columns[j]`, both in the order of
/// elimination: `columns[j] = max_i |a_ij|` and `rows[i] = SINGULAR max_j |a_ij| / columns[j]` over
/// the entries of the cell matrices. A pivot that cancels leaves round-off of what was there at the
/// start, whatever the units of rows and columns are.
pub(super) fn floors<T: Scalar>(
    analysis: &Analysis,
    matrices: &[f64],
    rows: &mut [T],
    columns: &mut [T],
) {
    rows.fill(T::default());
    columns.fill(T::default());
    vectorised(
        #[inline(always)]
        || {
            for cell in 0..analysis.cells.cells() {
                let (places, matrix) = cell_of(analysis, matrices, cell);
                for (column, &j) in matrix.chunks_exact(places.len().max(1)).zip(places) {
                    raise(&mut columns[j as usize], T::from_f64(largest(column)));
                }
            }
            for cell in 0..analysis.cells.cells() {
                let (places, matrix) = cell_of(analysis, matrices, cell);
                raise_rows(places, matrix, columns, rows);
            }
        },
    );
}

/// Places of the unknowns of a cell, and its matrix.
#[inline(always)]
fn cell_of<'a>(analysis: &'a Analysis, matrices: &'a [f64], cell: usize) -> (&'a [u32], &'a [f64]) {
    let places = &analysis.cell_places[analysis.cells.of_range(cell)];
    (places, &matrices[analysis.cells.matrix(cell)])
}

/// Takes a cell's rows in: first over its columns, where they are neighbours, then where they belong.
#[inline(always)]
fn raise_rows<T: Scalar>(places: &[u32], matrix: &[f64], columns: &[T], rows: &mut [T]) {
    for (block, part) in places.chunks(STRIP).enumerate() {
        let mut most = [T::default(); STRIP];
        for (column, &j) in matrix.chunks_exact(places.len()).zip(places) {
            let scale = T::SINGULAR / columns[j as usize].to_f64();
            for (most, a) in most.iter_mut().zip(&column[block * STRIP..][..part.len()]) {
                raise(most, T::from_f64(scale * a.abs()));
            }
        }
        for (&i, &most) in part.iter().zip(&most) {
            raise(&mut rows[i as usize], most);
        }
    }
}

#[inline(always)]
fn raise<T: Scalar>(x: &mut T, to: T) {
    *x = if to > *x { to } else { *x };
}

/// The largest absolute value, over vectors of eight.
#[inline(always)]
fn largest(column: &[f64]) -> f64 {
    let mut lanes = [0.0; 8];
    let chunks = column.chunks_exact(8);
    let rest = chunks.remainder();
    for chunk in chunks {
        for (lane, a) in lanes.iter_mut().zip(chunk) {
            raise(lane, a.abs());
        }
    }
    rest.iter().chain(&lanes).fold(0.0, |m, a| if a.abs() > m { a.abs() } else { m })
}
