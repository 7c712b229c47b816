use faer::MatMut;

/// The inner product `(u, v) = uᵀ W v` of the space in which the modes are orthonormal, paper eq. (6).
///
/// `W = Fᵀ F` is symmetric positive definite. All three operations work in place on a block of
/// columns of length [`dim`](Self::dim).
pub trait InnerProduct: Sync {
    /// Length n of a snapshot.
    fn dim(&self) -> usize;
    /// `x <- W x`.
    fn apply(&self, x: MatMut<'_, f64>);
    /// `x <- F x`: the exact routes need it.
    fn factor(&self, x: MatMut<'_, f64>);
    /// `x <- F⁻¹ x`.
    fn unfactor(&self, x: MatMut<'_, f64>);
}
