mod boundaries;
mod edges;
mod roles;

use super::cells::{Cells, entries};
use super::check::Draft;
use super::{MeshError, NamedBoundary};
use crate::element::Cell;
use std::ops::Range;

/// Which cells, edges and boundaries a planar mesh has, apart from where its nodes are.
///
/// Cells are numbered triangles first, then quadrilaterals; edges by the nodes at their ends.
///
/// ```
/// use lumley_fem::{MeshDescription, PlanarMesh, element::Cell};
/// let mesh = PlanarMesh::new(MeshDescription::structured([2, 1], |[i, _]| i == 1, |p| p))?;
/// let topology = mesh.topology();
/// assert_eq!((topology.cells(), topology.edges().len()), (3, 8));
/// assert_eq!(topology.kind(2), Cell::Quadrilateral);
/// // The right edge of the quadrilateral is the last of the second triangle.
/// let neighbour = topology.neighbour(2, 1).unwrap();
/// assert_eq!((neighbour.cell, neighbour.edge), (1, 2));
/// # Ok::<(), lumley_fem::MeshError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Topology {
    nodes: usize,
    cells: Cells,
    edges: Vec<Edge>,
    cell_edges: Vec<usize>,
    boundaries: Vec<Boundary>,
}

/// An edge of a cell, by the cell.
///
/// ```
/// use lumley_fem::Side;
/// let side = Side { cell: 3, edge: 0 };
/// assert_eq!(side.cell, 3);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Side {
    /// The cell.
    pub cell: usize,
    /// Number of the edge in the cell: it goes from this corner to the next.
    pub edge: usize,
}

/// An edge with the cells at its sides.
///
/// ```
/// use lumley_fem::{MeshDescription, PlanarMesh};
/// let mesh = PlanarMesh::new(MeshDescription::structured([1, 1], |_| false, |p| p))?;
/// let edge = mesh.topology().edges()[0];
/// assert_eq!((edge.nodes, edge.left.cell, edge.right), ([0, 2, 1], 0, None));
/// # Ok::<(), lumley_fem::MeshError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Edge {
    /// Start, end and middle; it runs counterclockwise round the cell at its left.
    pub nodes: [usize; 3],
    /// The cell at its left: the normal of the edge points out of it.
    pub left: Side,
    /// The cell at its right; none on the rim of the domain.
    pub right: Option<Side>,
}

/// A named part of the rim.
///
/// ```
/// use lumley_fem::{MeshDescription, PlanarMesh};
/// let mesh = PlanarMesh::new(MeshDescription::structured([3, 2], |_| false, |p| p))?;
/// let top = mesh.topology().boundary("top").unwrap();
/// assert_eq!(top.edges.len(), 3);
/// assert!(top.edges.iter().all(|&edge| mesh.topology().edges()[edge].left.edge == 2));
/// # Ok::<(), lumley_fem::MeshError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Boundary {
    /// Its name.
    pub name: String,
    /// Numbers of its edges, in the order in which they were given.
    pub edges: Vec<usize>,
}

impl Topology {
    /// The edges and boundaries of a draft that has been checked.
    pub(super) fn new(draft: Draft<'_>, named: &[NamedBoundary]) -> Result<Self, MeshError> {
        let edges = edges::join(draft)?;
        roles::check(draft, &edges)?;
        let boundaries = boundaries::attach(draft, &edges, named)?;
        let cells = draft.cells.clone();
        let mut cell_edges = vec![0; 3 * cells.triangles.len() + 4 * cells.quadrilaterals.len()];
        for (number, edge) in edges.iter().enumerate() {
            for side in std::iter::once(edge.left).chain(edge.right) {
                cell_edges[edges_of(&cells, side.cell)][side.edge] = number;
            }
        }
        Ok(Self { nodes: draft.points.len(), cells, edges, cell_edges, boundaries })
    }

    /// Number of geometry nodes.
    pub fn nodes(&self) -> usize {
        self.nodes
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.cells.len()
    }

    /// Nodes of the triangles, the first cells.
    pub fn triangles(&self) -> &[[usize; 6]] {
        &self.cells.triangles
    }

    /// Nodes of the quadrilaterals, the cells after the triangles.
    pub fn quadrilaterals(&self) -> &[[usize; 9]] {
        &self.cells.quadrilaterals
    }

    /// Shape of a cell.
    pub fn kind(&self, cell: usize) -> Cell {
        self.cells.kind(cell)
    }

    /// Nodes of a cell: corners, middles of the edges, centre.
    pub fn cell_nodes(&self, cell: usize) -> &[usize] {
        self.cells.nodes(cell)
    }

    /// All edges.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// Numbers of the edges of a cell.
    pub fn cell_edges(&self, cell: usize) -> &[usize] {
        &self.cell_edges[edges_of(&self.cells, cell)]
    }

    /// What lies beyond an edge of a cell; `None` on the rim.
    pub fn neighbour(&self, cell: usize, edge: usize) -> Option<Side> {
        let Edge { left, right, .. } = self.edges[self.cell_edges(cell)[edge]];
        if left.cell == cell { right } else { Some(left) }
    }

    /// The named parts of the rim.
    pub fn boundaries(&self) -> &[Boundary] {
        &self.boundaries
    }

    /// The boundary of that name.
    pub fn boundary(&self, name: &str) -> Option<&Boundary> {
        self.boundaries.iter().find(|boundary| boundary.name == name)
    }

    pub(super) fn all_cells(&self) -> &Cells {
        &self.cells
    }
}

fn edges_of(cells: &Cells, cell: usize) -> Range<usize> {
    entries(cells.triangles.len(), [Cell::Triangle.edges(), Cell::Quadrilateral.edges()], cell)
}
