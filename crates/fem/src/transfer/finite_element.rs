use super::TransferError;
use crate::{MovingField, Point};

/// The velocity of the fluid at `point` by its own finite elements.
pub(super) fn interpolate(
    field: &dyn MovingField,
    point: Point,
    v: &mut [f64],
) -> Result<(), TransferError> {
    field.fluid_velocity(point, v).ok_or(TransferError::NotCovered(point))
}
