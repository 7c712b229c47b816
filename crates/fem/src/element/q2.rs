use super::{Cell, DofLayout, Element, P2, tensor};
use crate::Point;

/// The biquadratic square with nine nodes: products of the quadratic functions of its sides. It is also
/// the geometry of a curved quadrilateral.
///
/// ```
/// use lumley_fem::element::{Element, Q2};
/// let (mut phi, mut dphi) = ([0.0; 9], [[0.0; 2]; 9]);
/// Q2.tabulate([0.5, 0.5], &mut phi, &mut dphi);
/// assert_eq!(phi[8], 1.0);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Q2;

/// Where the nodes stand along x and along y: left end, right end, middle.
const PAIRS: [[usize; 2]; 9] =
    [[0, 0], [1, 0], [1, 1], [0, 1], [2, 0], [1, 2], [2, 1], [0, 2], [2, 2]];

impl Element for Q2 {
    fn degree(&self) -> usize {
        2
    }

    fn layout(&self) -> DofLayout {
        DofLayout { cell: Cell::Quadrilateral, vertex: 1, edge: 1, interior: 1 }
    }

    fn nodes(&self) -> &[Point] {
        &[
            [0.0, 0.0],
            [1.0, 0.0],
            [1.0, 1.0],
            [0.0, 1.0],
            [0.5, 0.0],
            [1.0, 0.5],
            [0.5, 1.0],
            [0.0, 0.5],
            [0.5, 0.5],
        ]
    }

    fn tabulate(&self, point: Point, phi: &mut [f64], dphi: &mut [Point]) {
        tensor::tabulate(&P2, &PAIRS, point, phi, dphi);
    }

    fn values(&self, [x, y]: Point, phi: &mut [f64]) {
        let along = |s: f64| {
            let t = 1.0 - s;
            [t * (2.0 * t - 1.0), s * (2.0 * s - 1.0), 4.0 * s * t]
        };
        let (fx, fy) = (along(x), along(y));
        for (phi, [i, j]) in phi.iter_mut().zip(PAIRS) {
            *phi = fx[i] * fy[j];
        }
    }
}
