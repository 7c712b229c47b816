use super::cells::Cells;
use super::check::{Draft, mean};
use super::{Boundary, MeshDescription, MeshError, Topology, jacobian};
use crate::Point;
use crate::element::{Cell, P2};
use crate::geometry::{EdgePoint, Tabulated};
use crate::quadrature::rule;

/// Gauss points for the length of a curved edge, whose integrand is the root of a quadratic.
const LENGTH_DEGREE: usize = 9;

/// A planar mesh of curved triangles and quadrilaterals: a topology that stays, and nodes that may move.
///
/// ```
/// use lumley_fem::{MeshDescription, PlanarMesh};
/// // A quarter of a ring between the radii 1 m and 2 m.
/// let ring = |[x, y]: [f64; 2]| {
///     let (sin, cos) = (y * std::f64::consts::FRAC_PI_2).sin_cos();
///     [(1.0 + x) * cos, (1.0 + x) * sin]
/// };
/// let mut mesh = PlanarMesh::new(MeshDescription::structured([4, 8], |_| false, ring))?;
/// let rim = mesh.boundary_length(mesh.topology().boundary("right").unwrap());
/// assert!((rim - std::f64::consts::PI).abs() < 1e-5);
/// mesh.nodes_mut().iter_mut().for_each(|node| node[0] *= 2.0);
/// mesh.check()?;
/// # Ok::<(), lumley_fem::MeshError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct PlanarMesh {
    topology: Topology,
    nodes: Vec<Point>,
}

impl PlanarMesh {
    /// The mesh that is described, if it is one: every node, cell, edge and boundary is checked, and every
    /// cell proven to be positive all over.
    ///
    /// # Errors
    /// Every variant of [`MeshError`].
    pub fn new(description: MeshDescription) -> Result<Self, MeshError> {
        let MeshDescription { points, triangles, quadrilaterals, boundaries } = description;
        let cells = Cells { triangles, quadrilaterals };
        let draft = Draft { points: &points, cells: &cells };
        draft.check(&boundaries)?;
        jacobian::check(&points, &cells)?;
        let topology = Topology::new(draft, &boundaries)?;
        Ok(Self { topology, nodes: points })
    }

    /// What does not move.
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// Where the nodes are, in m.
    pub fn nodes(&self) -> &[Point] {
        &self.nodes
    }

    /// Where the nodes are, in m, to be moved; [`check`](Self::check) says whether the cells survived it.
    pub fn nodes_mut(&mut self) -> &mut [Point] {
        &mut self.nodes
    }

    /// Whether all nodes are finite and all cells still positive all over.
    ///
    /// # Errors
    /// [`MeshError::NotFinite`] and [`MeshError::Inverted`].
    pub fn check(&self) -> Result<(), MeshError> {
        Draft { points: &self.nodes, cells: self.topology.all_cells() }.finite()?;
        jacobian::check(&self.nodes, self.topology.all_cells())
    }

    /// Nodes of triangle `t`, in m.
    pub fn triangle(&self, t: usize) -> [Point; 6] {
        self.topology.triangles()[t].map(|node| self.nodes[node])
    }

    /// Nodes of quadrilateral `q`, which is the cell after all triangles and q quadrilaterals, in m.
    pub fn quadrilateral(&self, q: usize) -> [Point; 9] {
        self.topology.quadrilaterals()[q].map(|node| self.nodes[node])
    }

    /// Start, end and middle of an edge, in m.
    pub fn edge(&self, edge: usize) -> [Point; 3] {
        self.topology.edges()[edge].nodes.map(|node| self.nodes[node])
    }

    /// The mean of the corners of a cell, in m.
    pub fn centre(&self, cell: usize) -> Point {
        mean(&self.nodes, self.topology.all_cells().corners(cell))
    }

    /// Length of a boundary, in m.
    pub fn boundary_length(&self, boundary: &Boundary) -> f64 {
        boundary.edges.iter().map(|&edge| length(&self.edge(edge), &length_rule())).sum()
    }
}

/// The quadrature by which lengths of edges are measured.
pub(super) fn length_rule() -> Vec<Tabulated<3>> {
    Tabulated::on(&P2, &rule(Cell::Interval, LENGTH_DEGREE))
}

/// Length of a curved edge, in m.
pub(super) fn length(nodes: &[Point; 3], rule: &[Tabulated<3>]) -> f64 {
    rule.iter().map(|at| EdgePoint::new(nodes, at).weight).sum()
}
