use crate::{MovingField, UniformGrid};

/// The characteristic function `χ_F` of the fluid on a grid, paper eq. (27): 1 in the fluid and on
/// its boundary, 0 in a solid.
///
/// # Panics
/// If `chi` has not one entry for each node of the grid.
pub fn characteristic(field: &dyn MovingField, grid: &UniformGrid, chi: &mut [f64]) {
    assert_eq!(chi.len(), grid.len(), "one value for each node of the grid");
    for (k, chi) in chi.iter_mut().enumerate() {
        *chi = f64::from(u8::from(field.is_fluid(grid.point(k))));
    }
}
