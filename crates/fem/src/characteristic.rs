use crate::{MovingField, UniformGrid};

/// The characteristic function `χ_F` of the fluid on a grid, paper eq. (27): 1 in the fluid and on
/// its boundary, 0 in a solid.
///
/// ```
/// use lumley_fem::{MovingField, Point, UniformGrid, characteristic};
/// # struct Tube;
/// # impl MovingField for Tube {
/// #     fn components(&self) -> usize { 1 }
/// #     fn nodes(&self) -> usize { 0 }
/// #     fn position(&self, _: usize) -> Point { unreachable!("it has no nodes") }
/// #     fn nodal_velocity(&self, _: usize, _: &mut [f64]) {}
/// #     fn is_fluid(&self, x: Point) -> bool { x[0] <= 0.5 }
/// #     fn fluid_velocity(&self, _: Point, v: &mut [f64]) -> Option<()> { v[0] = 0.0; Some(()) }
/// #     fn solid_velocity(&self, _: Point, v: &mut [f64]) { v[0] = 0.0; }
/// # }
/// let tube = Tube; // fluid up to x = 0.5 m
/// let mut chi = [0.0; 4];
/// characteristic(&tube, &UniformGrid::line(0.0, 0.75, 4), &mut chi);
/// assert_eq!(chi, [1.0, 1.0, 1.0, 0.0]);
/// ```
///
/// # Panics
/// If `chi` has not one entry for each node of the grid.
pub fn characteristic(field: &dyn MovingField, grid: &UniformGrid, chi: &mut [f64]) {
    assert_eq!(chi.len(), grid.len(), "one value for each node of the grid");
    for (k, chi) in chi.iter_mut().enumerate() {
        *chi = f64::from(u8::from(field.is_fluid(grid.point(k))));
    }
}
