use super::{Cell, DofLayout, Element, P1, tensor};
use crate::Point;

/// The bilinear square: products of the linear functions of its sides.
///
/// ```
/// use lumley_fem::element::{Element, Q1};
/// let (mut phi, mut dphi) = ([0.0; 4], [[0.0; 2]; 4]);
/// Q1.tabulate([0.25, 0.5], &mut phi, &mut dphi);
/// assert_eq!(phi, [0.375, 0.125, 0.125, 0.375]);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Q1;

impl Element for Q1 {
    fn degree(&self) -> usize {
        1
    }

    fn layout(&self) -> DofLayout {
        DofLayout { cell: Cell::Quadrilateral, vertex: 1, edge: 0, interior: 0 }
    }

    fn nodes(&self) -> &[Point] {
        Cell::Quadrilateral.corners()
    }

    fn tabulate(&self, point: Point, phi: &mut [f64], dphi: &mut [Point]) {
        tensor::tabulate(&P1, &[[0, 0], [1, 0], [1, 1], [0, 1]], point, phi, dphi);
    }
}
