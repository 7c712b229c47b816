//! Columns as slices: what is done to them one number after the other goes at the rate of memory then.

use faer::{MatMut, MatRef};

/// The columns of a matrix whose columns are contiguous.
pub(crate) fn columns(x: MatRef<'_, f64>) -> impl Iterator<Item = &[f64]> {
    x.col_iter().map(|column| {
        let column = column.try_as_col_major();
        column.expect("the columns of a block are contiguous").as_slice()
    })
}

/// The columns of a matrix whose columns are contiguous.
pub(crate) fn columns_mut(x: MatMut<'_, f64>) -> impl Iterator<Item = &mut [f64]> {
    x.col_iter_mut().map(|column| {
        let column = column.try_as_col_major_mut();
        column.expect("the columns of a block are contiguous").as_slice_mut()
    })
}

/// `to <- from`, both of one shape.
pub(crate) fn copy(from: MatRef<'_, f64>, mut to: MatMut<'_, f64>) {
    if from.row_stride() == 1 && to.row_stride() == 1 {
        columns(from).zip(columns_mut(to)).for_each(|(from, to)| to.copy_from_slice(from));
    } else {
        to.copy_from(from);
    }
}
