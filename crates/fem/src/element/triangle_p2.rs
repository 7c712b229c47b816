use super::triangle_p1::SLOPES;
use super::{Cell, DofLayout, Element};
use crate::Point;

/// The quadratic triangle, in barycentric λ: `λ_i (2 λ_i − 1)` at corner i, `4 λ_i λ_j` at the middle of
/// the edge from i to j. It is also the geometry of a curved triangle.
///
/// ```
/// use lumley_fem::element::{Element, TriangleP2};
/// let (mut phi, mut dphi) = ([0.0; 6], [[0.0; 2]; 6]);
/// TriangleP2.tabulate([0.5, 0.5], &mut phi, &mut dphi);
/// assert_eq!(phi, [0.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct TriangleP2;

impl Element for TriangleP2 {
    fn degree(&self) -> usize {
        2
    }

    fn layout(&self) -> DofLayout {
        DofLayout { cell: Cell::Triangle, vertex: 1, edge: 1, interior: 0 }
    }

    fn nodes(&self) -> &[Point] {
        &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]]
    }

    fn tabulate(&self, [x, y]: Point, phi: &mut [f64], dphi: &mut [Point]) {
        let l = [1.0 - x - y, x, y];
        for i in 0..3 {
            let j = (i + 1) % 3;
            phi[i] = l[i] * (2.0 * l[i] - 1.0);
            phi[3 + i] = 4.0 * l[i] * l[j];
            dphi[i] = SLOPES[i].map(|slope| (4.0 * l[i] - 1.0) * slope);
            dphi[3 + i] = [0, 1].map(|d| 4.0 * (SLOPES[i][d] * l[j] + l[i] * SLOPES[j][d]));
        }
    }
}
