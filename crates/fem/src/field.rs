use crate::Point;

/// A fluid velocity on a moving mesh at one instant, with the solids that move in it: what the
/// transfer to a fixed grid needs to know, paper §3.7.
///
/// Vectors have [`components`](Self::components) entries, in m/s; points are in m. Fluid and solids
/// together fill the fixed domain, and agree on the interface.
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
