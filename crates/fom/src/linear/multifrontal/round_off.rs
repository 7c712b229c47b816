//! What a pivot must exceed to count as one.

use super::analysis::Analysis;
use crate::linear::Scalar;

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
    pulp::Arch::new().dispatch(
        #[inline(always)]
        || {
            for_each_column(analysis, matrices, |_, j, column| {
                raise(&mut columns[j], T::from_f64(largest(column)));
            });
            for_each_column(analysis, matrices, |places, j, column| {
                let scale = T::SINGULAR / columns[j].to_f64();
                for (a, &i) in column.iter().zip(places) {
                    raise(&mut rows[i as usize], T::from_f64(scale * a.abs()));
                }
            });
        },
    );
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

/// Calls `f` with the places of the unknowns of a cell, the place of a column and its entries.
#[inline(always)]
fn for_each_column(
    analysis: &Analysis,
    matrices: &[f64],
    mut f: impl FnMut(&[u32], usize, &[f64]),
) {
    for cell in 0..analysis.cells.cells() {
        let places = &analysis.cell_places[analysis.cells.of_range(cell)];
        let matrix = &matrices[analysis.cells.matrix(cell)];
        for (column, &j) in matrix.chunks_exact(places.len().max(1)).zip(places) {
            f(places, j as usize, column);
        }
    }
}
