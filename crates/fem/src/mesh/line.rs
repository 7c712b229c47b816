use crate::element::{Cell, Element};
use crate::quadrature::gauss_legendre;
use std::fmt;

/// Most nodes that a cell of a line may have.
const CELL_NODES: usize = 3;

/// Cells side by side on a line: their number and their nodes, without coordinates.
///
/// Nodes are numbered vertices first, from left to right, then the interior nodes cell by cell.
/// Coordinates and nodal values are slices in that order, so that a moving mesh moves its
/// coordinates and nothing else. Cells are affine.
///
/// ```
/// use lumley_fem::{LineMesh, element::P2};
/// let mesh = LineMesh::new(4, &P2);
/// let x = mesh.uniform(0.0, 1.0);
/// let squares: Vec<f64> = x.iter().map(|x| x * x).collect();
/// assert!((mesh.evaluate(&x, &squares, 0.3).unwrap() - 0.09).abs() < 1e-15);
/// assert_eq!(mesh.evaluate(&x, &squares, 1.5), None);
/// ```
#[derive(Clone, Copy)]
pub struct LineMesh {
    cells: usize,
    element: &'static dyn Element,
}

impl LineMesh {
    /// A line of `cells` cells with the nodes of `element`.
    ///
    /// # Panics
    /// If there is no cell, or the element is not one with a node at each end of an interval.
    pub fn new(cells: usize, element: &'static dyn Element) -> Self {
        let layout = element.layout();
        assert!(cells > 0, "a mesh needs a cell");
        assert!(layout.cell == Cell::Interval && layout.vertex == 1, "not an element of a line");
        assert!(layout.nodes() <= CELL_NODES, "at most {CELL_NODES} nodes in a cell of a line");
        Self { cells, element }
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.cells
    }

    /// The element of every cell.
    pub fn element(&self) -> &'static dyn Element {
        self.element
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.cells + 1 + self.cells * self.element.layout().interior
    }

    /// Nodes of a cell, in the order of the reference element.
    pub fn cell_nodes(&self, cell: usize) -> impl Iterator<Item = usize> + use<> {
        [cell, cell + 1].into_iter().chain(self.interior(cell))
    }

    /// All nodes, from left to right.
    pub fn left_to_right(&self) -> impl Iterator<Item = usize> + '_ {
        let of_cell = |cell| std::iter::once(cell).chain(self.interior(cell));
        (0..self.cells).flat_map(of_cell).chain(std::iter::once(self.cells))
    }

    fn interior(&self, cell: usize) -> std::ops::Range<usize> {
        let inside = self.element.layout().interior;
        let first = self.cells + 1 + cell * inside;
        first..first + inside
    }

    /// Coordinates of the nodes, in m, when all cells from `a` to `b` have the same length.
    pub fn uniform(&self, a: f64, b: f64) -> Vec<f64> {
        let at = |s: f64| {
            let t = s / self.cells as f64;
            a * (1.0 - t) + b * t
        };
        let inside = &self.element.nodes()[2..];
        let vertices = (0..=self.cells).map(|v| at(v as f64));
        let interior = (0..self.cells)
            .flat_map(|cell| inside.iter().map(move |node| cell as f64 + node[0]))
            .map(at);
        vertices.chain(interior).collect()
    }

    /// The cell that holds `x`, in m, and where in it, from 0 to 1; `None` outside of the mesh.
    ///
    /// `coordinates` of the nodes increase from left to right. A vertex belongs to the cell at its
    /// right, the last one to the last cell.
    pub fn locate(&self, coordinates: &[f64], x: f64) -> Option<(usize, f64)> {
        let vertices = &coordinates[..=self.cells];
        if !(vertices[0] <= x && x <= vertices[self.cells]) {
            return None;
        }
        let cell = vertices.partition_point(|&v| v <= x).clamp(1, self.cells) - 1;
        Some((cell, (x - vertices[cell]) / (vertices[cell + 1] - vertices[cell])))
    }

    /// The finite-element function with these nodal `values` at `x`, in m; `None` outside of the
    /// mesh.
    pub fn evaluate(&self, coordinates: &[f64], values: &[f64], x: f64) -> Option<f64> {
        let (cell, s) = self.locate(coordinates, x)?;
        let nodes = self.element.layout().nodes();
        let (mut phi, mut dphi) = ([0.0; CELL_NODES], [[0.0; 2]; CELL_NODES]);
        self.element.tabulate([s, 0.0], &mut phi[..nodes], &mut dphi[..nodes]);
        Some(self.cell_nodes(cell).zip(phi).map(|(node, phi)| values[node] * phi).sum())
    }

    /// The consistent mass matrix `∫ φ_i φ_j`: entries `(i, j, value)` in m, cell after cell. Entries of
    /// a vertex that two cells share stand there twice and add up.
    ///
    /// ```
    /// use lumley_fem::{LineMesh, element::P2};
    /// let mesh = LineMesh::new(3, &P2);
    /// let mass = mesh.mass_matrix(&mesh.uniform(0.0, 2.0));
    /// let length: f64 = mass.iter().map(|(_, _, value)| value).sum();
    /// assert!((length - 2.0).abs() < 1e-15);
    /// ```
    pub fn mass_matrix(&self, coordinates: &[f64]) -> Vec<(usize, usize, f64)> {
        let layout = self.element.layout();
        let mut entries = Vec::with_capacity(self.cells * layout.nodes() * layout.nodes());
        let (mut phi, mut dphi) = ([0.0; CELL_NODES], [[0.0; 2]; CELL_NODES]);
        let mut reference = [[0.0; CELL_NODES]; CELL_NODES];
        for (s, weight) in gauss_legendre(self.element.degree() + 1) {
            self.element.tabulate(
                [s, 0.0],
                &mut phi[..layout.nodes()],
                &mut dphi[..layout.nodes()],
            );
            for (row, phi_i) in reference.iter_mut().zip(phi) {
                row.iter_mut().zip(phi).for_each(|(entry, phi_j)| *entry += weight * phi_i * phi_j);
            }
        }
        for cell in 0..self.cells {
            let length = coordinates[cell + 1] - coordinates[cell];
            for (i, row) in self.cell_nodes(cell).zip(&reference) {
                entries.extend(self.cell_nodes(cell).zip(row).map(|(j, m)| (i, j, m * length)));
            }
        }
        entries
    }
}

impl fmt::Debug for LineMesh {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let layout = self.element.layout();
        f.debug_struct("LineMesh").field("cells", &self.cells).field("layout", &layout).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::element::ELEMENTS;

    fn meshes(cells: usize) -> impl Iterator<Item = LineMesh> {
        ELEMENTS
            .iter()
            .filter(|(_, e)| e.layout().cell == Cell::Interval)
            .map(move |(_, e)| LineMesh::new(cells, *e))
    }

    #[test]
    fn left_to_right_visits_every_node_once_in_order() {
        for mesh in meshes(5) {
            let x = mesh.uniform(-1.0, 2.0);
            let order: Vec<usize> = mesh.left_to_right().collect();
            assert_eq!((x.len(), order.len()), (mesh.nodes(), mesh.nodes()));
            assert!(order.windows(2).all(|w| x[w[0]] < x[w[1]]), "{mesh:?}");
        }
    }

    #[test]
    fn cell_nodes_sit_where_the_element_says() {
        for mesh in meshes(4) {
            let x = mesh.uniform(0.0, 2.0);
            for cell in 0..mesh.cells() {
                for (node, reference) in mesh.cell_nodes(cell).zip(mesh.element().nodes()) {
                    let expected = 0.5 * (cell as f64 + reference[0]);
                    assert!((x[node] - expected).abs() < 1e-15, "{mesh:?}, cell {cell}");
                }
            }
        }
    }

    #[test]
    fn every_point_of_the_mesh_is_found_and_no_other() {
        let mesh = LineMesh::new(3, &crate::element::P1);
        let x = [0.0, 0.1, 0.7, 1.0];
        assert_eq!(mesh.locate(&x, 0.0), Some((0, 0.0)));
        assert_eq!(mesh.locate(&x, 0.1), Some((1, 0.0)));
        assert_eq!(mesh.locate(&x, 1.0), Some((2, 1.0)));
        let (cell, s) = mesh.locate(&x, 0.4).expect("inside");
        assert!(cell == 1 && (s - 0.5).abs() < 1e-15);
        for outside in [-1e-9, 1.0 + 1e-9, f64::NAN, f64::INFINITY] {
            assert_eq!(mesh.locate(&x, outside), None, "{outside}");
        }
    }

    /// A polynomial of the element's degree is evaluated exactly on a mesh that has moved.
    #[test]
    fn evaluation_reproduces_polynomials() {
        for mesh in meshes(6) {
            let x: Vec<f64> = mesh.uniform(0.0, 1.0).iter().map(|x| 0.3 + 1.7 * x).collect();
            let power = i32::try_from(mesh.element().degree()).expect("small");
            let values: Vec<f64> = x.iter().map(|x| x.powi(power)).collect();
            for p in [0.3, 0.5123, 1.0, 1.9999, 2.0] {
                let value = mesh.evaluate(&x, &values, p).expect("inside");
                assert!((value - p.powi(power)).abs() < 1e-14, "{mesh:?} at {p}: {value}");
            }
        }
    }
}
