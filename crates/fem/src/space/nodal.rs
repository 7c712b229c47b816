use super::DofMap;
use crate::element::{Cell, Element, MOST_NODES, P2Bubble, Q2, TriangleP2};
use crate::geometry::{Mapped, Tabulated};
use crate::{Location, PlanarMesh, Point, Topology};
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
        self.place(mesh, &mut points);
        points
    }

    /// Puts into `points` where the dofs are, in m. Allocates nothing.
    ///
    /// # Panics
    /// If there is not one point for each dof.
    pub fn place(&self, mesh: &PlanarMesh, points: &mut [Point]) {
        assert_eq!(points.len(), self.dofs.len(), "a point for each dof");
        let triangles = mesh.topology().triangles().len();
        for (k, &node) in self.elements[0].nodes().iter().enumerate() {
            let at = Tabulated::at(&TriangleP2, node, 0.0);
            for t in 0..triangles {
                points[self.dofs.cell(t)[k]] = Mapped::new(&mesh.triangle(t), &at).point;
            }
        }
        for (k, &node) in self.elements[1].nodes().iter().enumerate() {
            let at = Tabulated::at(&Q2, node, 0.0);
            for q in 0..mesh.topology().quadrilaterals().len() {
                let dof = self.dofs.cell(triangles + q)[k];
                points[dof] = Mapped::new(&mesh.quadrilateral(q), &at).point;
            }
        }
    }

    /// The vector field with these dofs, one vector for each, at a place in the mesh.
    ///
    /// ```
    /// use lumley_fem::{MeshDescription, PlanarMesh, PointLocator, space::NodalSpace};
    /// let mesh = PlanarMesh::new(MeshDescription::structured([2, 1], |[i, _]| i == 1, |p| p))?;
    /// let space = NodalSpace::velocity(mesh.topology());
    /// let shear: Vec<_> = space.points(&mesh).into_iter().map(|[x, y]| [y * y, x]).collect();
    /// let at = PointLocator::new(&mesh).locate(&mesh, [0.75, 0.5]).unwrap();
    /// let [u, v] = space.vector(&shear, &at);
    /// assert!((u - 0.25).abs() < 1e-15 && (v - 0.75).abs() < 1e-15);
    /// # Ok::<(), lumley_fem::MeshError>(())
    /// ```
    ///
    /// # Panics
    /// If the place is in no cell of the space, or there is not one vector for each dof.
    pub fn vector(&self, vectors: &[Point], at: &Location) -> Point {
        let dofs = self.dofs.cell(at.cell);
        let mut phi = [0.0; MOST_NODES];
        let phi = &mut phi[..dofs.len()];
        self.element(self.dofs.kind(at.cell)).values(at.reference, phi);
        let mut sum = [0.0; 2];
        for (&dof, phi) in dofs.iter().zip(phi) {
            sum = [sum[0] + *phi * vectors[dof][0], sum[1] + *phi * vectors[dof][1]];
        }
        sum
    }

    /// The dofs of the function that agrees with `f` at all their points.
    pub fn interpolate(&self, mesh: &PlanarMesh, f: impl FnMut(Point) -> f64) -> Vec<f64> {
        self.points(mesh).into_iter().map(f).collect()
    }
}

impl fmt::Debug for NodalSpace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("NodalSpace").field("dofs", &self.dofs).finish_non_exhaustive()
    }
}
