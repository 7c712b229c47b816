use super::{Cell, DofLayout, Element};
use crate::Point;

/// The linear triangle: the barycentric coordinates `1 − x − y`, `x`, `y`.
///
/// ```
/// use lumley_fem::element::{Element, TriangleP1};
/// let (mut phi, mut dphi) = ([0.0; 3], [[0.0; 2]; 3]);
/// TriangleP1.tabulate([0.25, 0.5], &mut phi, &mut dphi);
/// assert_eq!(phi, [0.25, 0.25, 0.5]);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct TriangleP1;

/// Gradients of the barycentric coordinates.
pub(super) const SLOPES: [Point; 3] = [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]];

impl Element for TriangleP1 {
    fn degree(&self) -> usize {
        1
    }

    fn layout(&self) -> DofLayout {
        DofLayout { cell: Cell::Triangle, vertex: 1, edge: 0, interior: 0 }
    }

    fn nodes(&self) -> &[Point] {
        Cell::Triangle.corners()
    }

    fn tabulate(&self, [x, y]: Point, phi: &mut [f64], dphi: &mut [Point]) {
        phi.copy_from_slice(&[1.0 - x - y, x, y]);
        dphi.copy_from_slice(&SLOPES);
    }
}
