use super::DofMap;
use crate::element::{Cell, Element, P2Bubble, Q2, TriangleP2};
use crate::geometry::{Mapped, Tabulated};
use crate::{PlanarMesh, Point, Topology};
use std::fmt;

/// A continuous space on a mixed mesh whose dofs are the values at points.
///
/// ```
/// use lumley_fem::{MeshDescription, PlanarMesh, space::NodalSpace};
/// let mesh = PlanarMesh::new(MeshDescription::structured([2, 1], |[i, _]| i == 1, |p| p))?;
/// let velocity = NodalSpace::velocity(mesh.topology());
/// let shear = velocity.interpolate(&mesh, |[_, y]| y);
/// let wall = velocity.dofs().on_boundary(mesh.topology(), &mesh.topology().boundaries()[0]);
/// assert!(wall.len() == 5 && wall.iter().all(|&dof| shear[dof] == 0.0));
/// # Ok::<(), lumley_fem::MeshError>(())
/// ```
#[derive(Clone)]
pub struct NodalSpace {
    elements: [&'static dyn Element; 2],
    dofs: DofMap,
}

impl NodalSpace {
    /// The space of these elements, which agree on the dofs of vertices and edges.
    ///
    /// # Panics
    /// As [`DofMap::new`] does.
    pub fn new(
        topology: &Topology,
        triangle: &'static dyn Element,
        quadrilateral: &'static dyn Element,
    ) -> Self {
        let dofs = DofMap::new(topology, triangle.layout(), quadrilateral.layout());
        Self { elements: [triangle, quadrilateral], dofs }
    }

    /// A component of the velocity of the paper's pairs: [`P2Bubble`] on triangles, [`Q2`] on
    /// quadrilaterals.
    pub fn velocity(topology: &Topology) -> Self {
        Self::new(topology, &P2Bubble, &Q2)
    }

    /// The dofs.
    pub fn dofs(&self) -> &DofMap {
        &self.dofs
    }

    /// The element of a kind of cell.
    ///
    /// # Panics
    /// If the cell is not planar.
    pub fn element(&self, kind: Cell) -> &'static dyn Element {
        match kind {
            Cell::Triangle => self.elements[0],
            Cell::Quadrilateral => self.elements[1],
            Cell::Interval => panic!("a planar mesh has no intervals"),
        }
    }

    /// Where the dofs are, in m.
    pub fn points(&self, mesh: &PlanarMesh) -> Vec<Point> {
        let mut points = vec![[0.0; 2]; self.dofs.len()];
        let at = Tabulated::at_nodes(&TriangleP2, self.elements[0]);
        let triangles = mesh.topology().triangles().len();
        for t in 0..triangles {
            place(&mesh.triangle(t), &at, self.dofs.cell(t), &mut points);
        }
        let at = Tabulated::at_nodes(&Q2, self.elements[1]);
        for q in 0..mesh.topology().quadrilaterals().len() {
            place(&mesh.quadrilateral(q), &at, self.dofs.cell(triangles + q), &mut points);
        }
        points
    }

    /// The dofs of the function that agrees with `f` at all their points.
    pub fn interpolate(&self, mesh: &PlanarMesh, f: impl FnMut(Point) -> f64) -> Vec<f64> {
        self.points(mesh).into_iter().map(f).collect()
    }
}

/// Puts the dofs of a cell with these geometry `nodes` where they are.
fn place<const N: usize>(
    nodes: &[Point; N],
    at: &[Tabulated<N>],
    dofs: &[usize],
    points: &mut [Point],
) {
    for (&dof, at) in dofs.iter().zip(at) {
        points[dof] = Mapped::new(nodes, at).point;
    }
}

impl fmt::Debug for NodalSpace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("NodalSpace").field("dofs", &self.dofs).finish_non_exhaustive()
    }
}
