use super::{Cell, DofLayout, Element};
use crate::Point;

/// The linear interval: `1 − x` at the left end, `x` at the right one.
///
/// ```
/// use lumley_fem::element::{Element, P1};
/// let (mut phi, mut dphi) = ([0.0; 2], [[0.0; 2]; 2]);
/// P1.tabulate([0.25, 0.0], &mut phi, &mut dphi);
/// assert_eq!(phi, [0.75, 0.25]);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct P1;

impl Element for P1 {
    fn degree(&self) -> usize {
        1
    }

    fn layout(&self) -> DofLayout {
        DofLayout { cell: Cell::Interval, vertex: 1, edge: 0, interior: 0 }
    }

    fn nodes(&self) -> &[Point] {
        &[[0.0, 0.0], [1.0, 0.0]]
    }

    fn tabulate(&self, [x, _]: Point, phi: &mut [f64], dphi: &mut [Point]) {
        phi.copy_from_slice(&[1.0 - x, x]);
        dphi.copy_from_slice(&[[-1.0, 0.0], [1.0, 0.0]]);
    }
}
