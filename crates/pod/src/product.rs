//! Products that sum over rows or run along them, read by blocks: the work that grows with n.

use crate::householder::triangular_factor;
use crate::reduction::{Blocks, join};
use crate::{InnerProduct, PodError};
use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::{Accum, Mat, MatMut, MatRef, Par};
use std::ops::Range;

/// A matrix of tall columns that is read by blocks and need not be in memory.
pub(crate) trait Columns: Sync {
    /// Rows and columns.
    fn shape(&self) -> (usize, usize);
    /// Reads `[rows, cols]` into `out`, which has that shape.
    fn read(
        &self,
        rows: Range<usize>,
        cols: Range<usize>,
        out: MatMut<'_, f64>,
    ) -> Result<(), PodError>;
}

impl Columns for MatRef<'_, f64> {
    fn shape(&self) -> (usize, usize) {
        (self.nrows(), self.ncols())
    }

    fn read(
        &self,
        rows: Range<usize>,
        cols: Range<usize>,
        mut out: MatMut<'_, f64>,
    ) -> Result<(), PodError> {
        out.copy_from(self.submatrix(rows.start, cols.start, rows.len(), cols.len()));
        Ok(())
    }
}

/// A copy of `x[rows, cols]`.
pub(crate) fn block(
    x: &dyn Columns,
    rows: Range<usize>,
    cols: Range<usize>,
) -> Result<Mat<f64>, PodError> {
    let mut out = Mat::zeros(rows.len(), cols.len());
    x.read(rows, cols, out.as_mut())?;
    Ok(out)
}

/// `C <- C + A Aᵀ`, the lower triangle alone: half the work.
pub(crate) fn add_symmetric(c: MatMut<'_, f64>, a: MatRef<'_, f64>) {
    let (full, lower) = (BlockStructure::Rectangular, BlockStructure::TriangularLower);
    triangular::matmul(c, lower, Accum::Add, a, full, a.transpose(), full, 1.0, Par::Seq);
}

/// Completes a symmetric matrix from its lower triangle.
pub(crate) fn mirror(c: &mut Mat<f64>) {
    for j in 0..c.ncols() {
        for i in 0..j {
            c[(i, j)] = c[(j, i)];
        }
    }
}

/// The Gram matrix `Xᵀ W X`, one pass over X; over its columns M/64 passes where W couples rows.
pub(crate) fn gram(x: &dyn Columns, w: &dyn InnerProduct, par: Par) -> Result<Mat<f64>, PodError> {
    let mut g = if w.couples_rows() { coupled_gram(x, w, par)? } else { local_gram(x, w, par)? };
    mirror(&mut g);
    Ok(g)
}

fn local_gram(x: &dyn Columns, w: &dyn InnerProduct, par: Par) -> Result<Mat<f64>, PodError> {
    let (n, m) = x.shape();
    let part = |rows: Range<usize>| {
        let mut z = block(x, rows.clone(), 0..m)?;
        w.factor(rows.start, z.as_mut());
        let mut g = Mat::zeros(m, m);
        add_symmetric(g.as_mut(), z.transpose());
        Ok(g)
    };
    Blocks::for_products(n, m).reduce(par, &part, &|a, b| a + b)
}

/// W needs whole columns: `W X` is formed for a few of them at a time.
fn coupled_gram(x: &dyn Columns, w: &dyn InnerProduct, par: Par) -> Result<Mat<f64>, PodError> {
    let (n, m) = x.shape();
    let mut g = Mat::zeros(m, m);
    for cols in panels(m) {
        let mut weighted = block(x, 0..n, cols.clone())?;
        w.apply(0, weighted.as_mut());
        let part = |rows: Range<usize>| {
            let z = block(x, rows.clone(), cols.start..m)?;
            let weighted = weighted.subrows(rows.start, rows.len());
            Ok::<_, PodError>(transposed_product(z.as_ref(), weighted))
        };
        let below = Blocks::for_products(n, m).reduce(par, &part, &|a, b| a + b)?;
        g.submatrix_mut(cols.start, cols.start, m - cols.start, cols.len()).copy_from(below);
    }
    Ok(g)
}

/// Columns in groups of at most 64, for what needs whole columns.
pub(crate) fn panels(columns: usize) -> impl Iterator<Item = Range<usize>> {
    (0..columns).step_by(64).map(move |j| j..(j + 64).min(columns))
}

/// `Aᵀ B`.
pub(crate) fn transposed_product(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    product(a.transpose(), b)
}

/// `A B` on one thread.
pub(crate) fn product(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    let mut c = Mat::zeros(a.nrows(), b.ncols());
    matmul(c.as_mut(), Accum::Replace, a, b, 1.0, Par::Seq);
    c
}

/// The factor R of `F X = Q R` by Householder reflections of blocks of rows, whose factors are
/// merged over the tree (TSQR; Demmel et al., 2012): `Rᵀ R = Xᵀ W X` without squaring.
pub(crate) fn factor_of_weighted(
    x: &dyn Columns,
    w: &dyn InnerProduct,
    par: Par,
) -> Result<Mat<f64>, PodError> {
    let (n, m) = x.shape();
    let blocks = Blocks::for_factors(n, m);
    let merge = |top: Mat<f64>, bottom: Mat<f64>| {
        let mut both = Mat::zeros(top.nrows() + bottom.nrows(), m);
        both.subrows_mut(0, top.nrows()).copy_from(&top);
        both.subrows_mut(top.nrows(), bottom.nrows()).copy_from(&bottom);
        triangular_factor(both)
    };
    if w.couples_rows() {
        let mut z = block(x, 0..n, 0..m)?;
        w.factor(0, z.as_mut());
        let part = |r: Range<usize>| Ok(triangular_factor(z.subrows(r.start, r.len()).to_owned()));
        return blocks.reduce(par, &part, &merge);
    }
    let part = |rows: Range<usize>| {
        let mut z = block(x, rows.clone(), 0..m)?;
        w.factor(rows.start, z.as_mut());
        Ok(triangular_factor(z))
    };
    blocks.reduce(par, &part, &merge)
}

/// Bytes that [`factor_of_weighted`] holds at once on one thread.
pub(crate) fn factor_bytes(n: usize, m: usize, couples_rows: bool) -> u128 {
    let held = Blocks::for_factors(n, m).rows(0).len() + 4 * n.min(m);
    let whole = if couples_rows { n } else { 0 };
    8 * m as u128 * (held + whole) as u128
}

/// The linear combinations `X C`, one pass over X.
pub(crate) fn combine(x: &dyn Columns, c: MatRef<'_, f64>, par: Par) -> Result<Mat<f64>, PodError> {
    let (n, m) = x.shape();
    let mut out = Mat::zeros(n, c.ncols());
    let blocks = Blocks::for_products(n, m);
    combine_blocks(x, c, blocks, 0..blocks.count(), out.as_mut(), par)?;
    Ok(out)
}

fn combine_blocks(
    x: &dyn Columns,
    c: MatRef<'_, f64>,
    blocks: Blocks,
    range: Range<usize>,
    out: MatMut<'_, f64>,
    par: Par,
) -> Result<(), PodError> {
    if range.len() == 1 {
        let z = block(x, blocks.rows(range.start), 0..c.nrows())?;
        matmul(out, Accum::Replace, &z, c, 1.0, Par::Seq);
        return Ok(());
    }
    let middle = range.start + range.len() / 2;
    let at = blocks.rows(middle).start - blocks.rows(range.start).start;
    let (top, bottom) = out.split_at_row_mut(at);
    let (a, b) = join(
        par,
        |par| combine_blocks(x, c, blocks, range.start..middle, top, par),
        |par| combine_blocks(x, c, blocks, middle..range.end, bottom, par),
    );
    a.and(b)
}
