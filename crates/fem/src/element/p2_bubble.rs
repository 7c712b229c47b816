use super::triangle_p1::SLOPES;
use super::{Cell, DofLayout, Element, TriangleP2};
use crate::Point;

/// The quadratic triangle with the cubic bubble: the velocity of the conforming Crouzeix-Raviart
/// pair P2⁺/P1-discontinuous (Crouzeix and Raviart 1973, RAIRO 7, 33-76).
///
/// Nodal, so that every unknown is a velocity at a place: with the bubble `b = 27 λ₀ λ₁ λ₂`, which
/// is one at the centroid, the functions of [`TriangleP2`] lose their value there times b: `+ b/9` at
/// the corners, `− 4b/9` at the middles.
///
/// ```
/// use lumley_fem::element::{Element, P2Bubble};
/// let (mut phi, mut dphi) = ([0.0; 7], [[0.0; 2]; 7]);
/// P2Bubble.tabulate([1.0 / 3.0, 1.0 / 3.0], &mut phi, &mut dphi);
/// assert!((phi[6] - 1.0).abs() < 1e-15 && phi[0].abs() < 1e-15);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct P2Bubble;

impl Element for P2Bubble {
    fn degree(&self) -> usize {
        2
    }

    fn layout(&self) -> DofLayout {
        DofLayout { cell: Cell::Triangle, vertex: 1, edge: 1, interior: 1 }
    }

    fn nodes(&self) -> &[Point] {
        const THIRD: f64 = 1.0 / 3.0;
        &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5], [THIRD, THIRD]]
    }

    fn tabulate(&self, point: Point, phi: &mut [f64], dphi: &mut [Point]) {
        TriangleP2.tabulate(point, &mut phi[..6], &mut dphi[..6]);
        let (b, db) = bubble(point);
        for i in 0..6 {
            let share = if i < 3 { 1.0 / 9.0 } else { -4.0 / 9.0 };
            phi[i] += share * b;
            dphi[i] = [0, 1].map(|d| dphi[i][d] + share * db[d]);
        }
        (phi[6], dphi[6]) = (b, db);
    }

    fn values(&self, [x, y]: Point, phi: &mut [f64]) {
        let l = [1.0 - x - y, x, y];
        let b = 27.0 * l[0] * l[1] * l[2];
        for i in 0..3 {
            phi[i] = l[i] * (2.0 * l[i] - 1.0) + b / 9.0;
            phi[3 + i] = 4.0 * (l[i] * l[(i + 1) % 3] - b / 9.0);
        }
        phi[6] = b;
    }
}

/// `27 λ₀ λ₁ λ₂` and its gradient.
fn bubble([x, y]: Point) -> (f64, Point) {
    let l = [1.0 - x - y, x, y];
    let slope = |d: usize| {
        27.0 * (SLOPES[0][d] * l[1] * l[2]
            + SLOPES[1][d] * l[2] * l[0]
            + SLOPES[2][d] * l[0] * l[1])
    };
    (27.0 * l[0] * l[1] * l[2], [slope(0), slope(1)])
}
