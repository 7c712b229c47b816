//! TEMP
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::solve_unit_lower_triangular_in_place;
use faer::{Accum, Mat, MatMut, MatRef, Par};

pub(crate) fn rows_per_block(m: usize) -> usize {
    ((1 << 17) / m.max(1)).clamp(256, 8192)
}
pub(crate) fn add_gram(c: MatMut<'_, f64>, z: MatRef<'_, f64>) {
    let (full, lower) = (BlockStructure::Rectangular, BlockStructure::TriangularLower);
    triangular::matmul(c, lower, Accum::Add, z.transpose(), full, z, full, 1.0, Par::Seq);
}
pub(crate) struct Substitution(Mat<f64>);
impl Substitution {
    pub fn new(u: MatRef<'_, f64>) -> Self {
        Self(u.to_owned())
    }
    pub fn apply(&self, z: MatMut<'_, f64>) {
        solve_unit_lower_triangular_in_place(self.0.transpose(), z.transpose_mut(), Par::Seq);
    }
}
