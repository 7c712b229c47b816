use super::Tabulated;
use crate::Point;

/// A point of a curved edge, for integrals along boundaries.
///
/// Edges of a mesh run counterclockwise round the cell at their left: the normal points out of it.
///
/// ```
/// use lumley_fem::{element::{Cell, P2}, geometry::{EdgePoint, Tabulated}, quadrature::rule};
/// let nodes = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0]];
/// let points = Tabulated::on(&P2, &rule(Cell::Interval, 3));
/// let length: f64 = points.iter().map(|at| EdgePoint::new(&nodes, at).weight).sum();
/// assert!((length - 2.0).abs() < 1e-15);
/// assert_eq!(EdgePoint::new(&nodes, &points[0]).normal, [0.0, -1.0]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgePoint {
    /// The point, in m.
    pub point: Point,
    /// Unit vector along the edge.
    pub tangent: Point,
    /// Unit vector to the right of the tangent.
    pub normal: Point,
    /// Weight of the quadrature times the length element `|x'(s)|`, in m.
    pub weight: f64,
}

impl EdgePoint {
    /// The image of a tabulated point of the quadratic interval on the edge whose ends and middle are
    /// `nodes`, in m.
    pub fn new(nodes: &[Point; 3], at: &Tabulated<3>) -> Self {
        let sum = |d: usize, f: [f64; 3]| nodes.iter().zip(f).map(|(node, f)| node[d] * f).sum();
        let point = [0, 1].map(|d| sum(d, at.phi));
        let along: Point = [0, 1].map(|d| sum(d, at.dphi.map(|g| g[0])));
        let length = along[0].hypot(along[1]);
        let tangent = along.map(|t| t / length);
        let normal = [tangent[1], -tangent[0]];
        Self { point, tangent, normal, weight: at.weight * length }
    }
}
