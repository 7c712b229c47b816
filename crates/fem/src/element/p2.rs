use super::{Cell, DofLayout, Element};
use crate::Point;

/// The quadratic interval, in barycentric `λ = (1 − x, x)`: `λ_i (2 λ_i − 1)` at end `i`, `4 λ₀ λ₁` at
/// the middle.
///
/// ```
/// use lumley_fem::element::{Element, P2};
/// let (mut phi, mut dphi) = ([0.0; 3], [[0.0; 2]; 3]);
/// P2.tabulate([0.5, 0.0], &mut phi, &mut dphi);
/// assert_eq!(phi, [0.0, 0.0, 1.0]);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct P2;

impl Element for P2 {
    fn degree(&self) -> usize {
        2
    }

    fn layout(&self) -> DofLayout {
        DofLayout { cell: Cell::Interval, vertex: 1, edge: 0, interior: 1 }
    }

    fn nodes(&self) -> &[Point] {
        &[[0.0, 0.0], [1.0, 0.0], [0.5, 0.0]]
    }

    fn tabulate(&self, [x, _]: Point, phi: &mut [f64], dphi: &mut [Point]) {
        let y = 1.0 - x;
        phi.copy_from_slice(&[y * (2.0 * y - 1.0), x * (2.0 * x - 1.0), 4.0 * x * y]);
        dphi.copy_from_slice(&[[1.0 - 4.0 * y, 0.0], [4.0 * x - 1.0, 0.0], [4.0 * (y - x), 0.0]]);
    }
}
