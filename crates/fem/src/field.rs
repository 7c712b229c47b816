use crate::Point;

/// A fluid velocity on a moving mesh at one instant, with the solids that move in it: what the
/// transfer to a fixed grid needs to know, paper §3.7.
///
/// Vectors have [`components`](Self::components) entries, in m/s; points are in m. Fluid and solids
/// together fill the fixed domain, and agree on the interface.
///
/// ```
/// use lumley_fem::{LineMesh, MovingField, Point, element::P1};
/// /// Fluid stretched by a piston at `x`, which moves with `v`.
/// struct Stretched { mesh: LineMesh, x: f64, v: f64 }
/// impl MovingField for Stretched {
///     fn components(&self) -> usize { 1 }
///     fn nodes(&self) -> usize { self.mesh.nodes() }
///     fn position(&self, node: usize) -> Point { [self.mesh.uniform(0.0, self.x)[node], 0.0] }
///     fn nodal_velocity(&self, node: usize, v: &mut [f64]) {
///         v[0] = self.v * self.position(node)[0] / self.x;
///     }
///     fn is_fluid(&self, point: Point) -> bool { point[0] <= self.x }
///     fn fluid_velocity(&self, point: Point, v: &mut [f64]) -> Option<()> {
///         v[0] = self.is_fluid(point).then_some(self.v * point[0] / self.x)?;
///         Some(())
///     }
///     fn solid_velocity(&self, _: Point, v: &mut [f64]) { v[0] = self.v; }
/// }
/// let field = Stretched { mesh: LineMesh::new(2, &P1), x: 0.8, v: 0.5 };
/// let mut v = [0.0];
/// field.nodal_velocity(1, &mut v);
/// assert_eq!((field.position(1), v), ([0.4, 0.0], [0.25]));
/// assert_eq!(field.fluid_velocity([0.9, 0.0], &mut v), None);
/// ```
pub trait MovingField {
    /// Components of the velocity.
    fn components(&self) -> usize;
    /// Number of mesh nodes.
    fn nodes(&self) -> usize;
    /// Where a mesh node is now.
    fn position(&self, node: usize) -> Point;
    /// The velocity at a mesh node.
    fn nodal_velocity(&self, node: usize, v: &mut [f64]);
    /// Whether the point is in the fluid, its boundary included: `χ_F = 1`, paper eq. (27).
    fn is_fluid(&self, point: Point) -> bool;
    /// The velocity `v_f` of the fluid at a point, by the finite elements of the mesh; `None`, and
    /// `v` as it was, where no cell is.
    #[must_use]
    fn fluid_velocity(&self, point: Point, v: &mut [f64]) -> Option<()>;
    /// The velocity `v_s` at a point of a solid.
    fn solid_velocity(&self, point: Point, v: &mut [f64]);
}
