use super::Tabulated;
use crate::Point;

/// A point of a curved cell: the map `x(ξ) = Σ x_i φ_i(ξ)` from the reference cell, and its Jacobian.
///
/// ```
/// use lumley_fem::{element::TriangleP1, geometry::{Mapped, Tabulated}};
/// let at = Tabulated::at(&TriangleP1, [0.25, 0.25], 0.5);
/// let mapped = Mapped::new(&[[1.0, 0.0], [3.0, 0.0], [1.0, 4.0]], &at);
/// assert_eq!((mapped.point, mapped.determinant), ([1.5, 1.0], 8.0));
/// assert_eq!(mapped.weight, 4.0, "the one weight of a one-point rule: the area");
/// assert_eq!(mapped.gradient([1.0, 1.0]), [0.5, 0.25]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mapped {
    /// The point, in m.
    pub point: Point,
    /// `∂x_i/∂ξ_j` in row i and column j, in m.
    pub jacobian: [[f64; 2]; 2],
    /// Determinant of the Jacobian, in m²; positive in a valid cell.
    pub determinant: f64,
    /// Weight of the quadrature times the determinant, in m².
    pub weight: f64,
}

impl Mapped {
    /// The image of a tabulated point in the cell with these `nodes`, in m.
    pub fn new<const N: usize>(nodes: &[Point; N], at: &Tabulated<N>) -> Self {
        let (mut point, mut jacobian) = ([0.0; 2], [[0.0; 2]; 2]);
        for ((node, phi), dphi) in nodes.iter().zip(&at.phi).zip(&at.dphi) {
            for i in 0..2 {
                point[i] += node[i] * phi;
                jacobian[i][0] += node[i] * dphi[0];
                jacobian[i][1] += node[i] * dphi[1];
            }
        }
        let determinant = jacobian[0][0] * jacobian[1][1] - jacobian[0][1] * jacobian[1][0];
        Self { point, jacobian, determinant, weight: at.weight * determinant }
    }

    /// The gradient in space, per m, of a function with this gradient in reference coordinates: `J^-T g`.
    pub fn gradient(&self, [g, h]: Point) -> Point {
        let ([[a, b], [c, d]], inverse) = (self.jacobian, 1.0 / self.determinant);
        [inverse * (d * g - c * h), inverse * (a * h - b * g)]
    }

    /// The gradients in space of all functions of an element.
    pub fn gradients<const N: usize>(&self, reference: &[Point; N]) -> [Point; N] {
        reference.map(|g| self.gradient(g))
    }
}
