//! Columns as slices: what is done to them one number after the other goes at the rate of memory then.

use faer::{MatMut, MatRef};

/// A column of a matrix whose columns are contiguous.
pub(crate) fn column(x: MatRef<'_, f64>, k: usize) -> &[f64] {
    let column = x.col(k).try_as_col_major();
    column.expect("the columns of a block are contiguous").as_slice()
}

/// The columns of a matrix whose columns are contiguous.
pub(crate) fn columns(x: MatRef<'_, f64>) -> impl Iterator<Item = &[f64]> {
    (0..x.ncols()).map(move |k| column(x, k))
}

/// The columns of a matrix whose columns are contiguous.
pub(crate) fn columns_mut(x: MatMut<'_, f64>) -> impl Iterator<Item = &mut [f64]> {
    x.col_iter_mut().map(|column| {
        let column = column.try_as_col_major_mut();
        column.expect("the columns of a block are contiguous").as_slice_mut()
    })
}

/// Column k of `to` becomes column `columns[k]` of `from`; both have contiguous columns.
pub(crate) fn gather(from: MatRef<'_, f64>, columns: &[usize], to: MatMut<'_, f64>) {
    for (&k, to) in columns.iter().zip(columns_mut(to)) {
        to.copy_from_slice(column(from, k));
    }
}

/// `to <- from`, both of one shape.
pub(crate) fn copy(from: MatRef<'_, f64>, mut to: MatMut<'_, f64>) {
    if from.row_stride() == 1 && to.row_stride() == 1 {
        columns(from).zip(columns_mut(to)).for_each(|(from, to)| to.copy_from_slice(from));
    } else {
        to.copy_from(from);
    }
}
