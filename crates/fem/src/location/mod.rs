//! In which cell of a mesh a point lies, and where in it.

mod bounds;
mod box_tree;
mod cell_map;
mod edge_foot;
mod powers;

pub(crate) use bounds::Bounds;
pub(crate) use cell_map::CellMap;

use crate::{PlanarMesh, Point};
use box_tree::BoxTree;
use edge_foot::foot;

/// A place in a mesh: a cell, and a point of its reference cell.
///
/// ```
/// use lumley_fem::Location;
/// let at = Location { cell: 7, reference: [0.25, 0.5] };
/// assert_eq!(at.cell, 7);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Location {
    /// The cell; triangles count first.
    pub cell: usize,
    /// The point, in coordinates of the reference cell.
    pub reference: Point,
}

/// Finds the cell of a point of a planar mesh, and the point of the reference cell, by Newton's method on
/// the quadratic map.
///
/// The cells stand in a tree of boxes. When the nodes of the mesh have moved, [`update`](Self::update)
/// fits the boxes again without a search and without allocation; the tree stays good as long as neighbours
/// stay together, whatever the contrast of sizes. An edge belongs to the cells at both sides: a point counts
/// as inside up to `1e-9` of the size of the cell (more only where the round-off of its coordinates is more).
///
/// ```
/// use lumley_fem::{MeshDescription, PlanarMesh, PointLocator};
/// let mut mesh = PlanarMesh::new(MeshDescription::structured([4, 2], |[i, _]| i < 2, |p| p))?;
/// let mut locator = PointLocator::new(&mesh);
/// let found = locator.locate(&mesh, [0.8125, 0.25]).unwrap();
/// assert!((found.reference[0] - 0.25).abs() < 1e-14 && (found.reference[1] - 0.5).abs() < 1e-14);
/// assert_eq!(locator.locate(&mesh, [1.5, 0.25]), None);
///
/// mesh.nodes_mut().iter_mut().for_each(|node| node[0] += 1.0);
/// locator.update(&mesh);
/// assert!(locator.locate(&mesh, [1.5, 0.25]).is_some());
/// # Ok::<(), lumley_fem::MeshError>(())
/// ```
#[derive(Debug, Clone)]
pub struct PointLocator {
    boxes: Vec<Bounds>,
    tree: BoxTree,
}

impl PointLocator {
    /// A locator on the mesh as it stands.
    pub fn new(mesh: &PlanarMesh) -> Self {
        let boxes: Vec<Bounds> =
            (0..mesh.topology().cells()).map(|cell| Bounds::of_cell(mesh, cell)).collect();
        let tree = BoxTree::new(&boxes);
        Self { boxes, tree }
    }

    /// Follows the nodes of the mesh, which has the same cells as ever. Allocates nothing.
    ///
    /// # Panics
    /// If the mesh has another number of cells.
    pub fn update(&mut self, mesh: &PlanarMesh) {
        assert_eq!(self.boxes.len(), mesh.topology().cells(), "cells of the mesh");
        for (cell, bounds) in self.boxes.iter_mut().enumerate() {
            *bounds = Bounds::of_cell(mesh, cell);
        }
        self.tree.refit(&self.boxes);
    }

    /// The cell that contains a point, given in m, of the mesh as it was at the last update; `None` outside
    /// of all cells.
    pub fn locate(&self, mesh: &PlanarMesh, point: Point) -> Option<Location> {
        if !point.iter().all(|x| x.is_finite()) {
            return None;
        }
        let mut found = None;
        self.tree.visit(point, 0.0, |cell| {
            if found.is_none() && self.boxes[cell].contains(point) {
                let inverse = CellMap::new(mesh, cell).invert(point);
                found = inverse.map(|reference| Location { cell, reference });
            }
            if found.is_some() { f64::NEG_INFINITY } else { 0.0 }
        });
        found
    }

    /// As [`locate`](Self::locate), and for a point outside of all cells the nearest point of the mesh if that
    /// is not further away than `distance`, in m.
    ///
    /// Two meshes of one domain have different polygons of quadratic edges on a curved wall: a node of one
    /// may lie a little outside of the other.
    pub fn locate_near(&self, mesh: &PlanarMesh, point: Point, distance: f64) -> Option<Location> {
        self.locate(mesh, point).or_else(|| self.nearest(mesh, point, distance))
    }

    /// The nearest point of all edges of cells within `distance`.
    fn nearest(&self, mesh: &PlanarMesh, point: Point, distance: f64) -> Option<Location> {
        let mut limit = distance * distance;
        let mut found = None;
        self.tree.visit(point, limit, |cell| {
            for edge in 0..mesh.topology().kind(cell).edges() {
                let (square, s) = foot(&cell_edge(mesh, cell, edge), point);
                // A point that is not a number is near nothing.
                if square <= limit {
                    let reference = mesh.topology().kind(cell).on_edge(edge, s);
                    (limit, found) = (square, Some(Location { cell, reference }));
                }
            }
            limit
        });
        found
    }
}

/// Start, end and middle of an edge of a cell, in m.
fn cell_edge(mesh: &PlanarMesh, cell: usize, edge: usize) -> [Point; 3] {
    let (nodes, corners) =
        (mesh.topology().cell_nodes(cell), mesh.topology().kind(cell).vertices());
    [edge, (edge + 1) % corners, corners + edge].map(|k| mesh.nodes()[nodes[k]])
}
