use crate::element::{Cell, DofLayout};
use crate::mesh::entries;
use crate::{Boundary, Side, Topology};

/// Which degrees of freedom (dofs) each cell of a mixed mesh has, of one scalar field.
///
/// Dofs are numbered vertices first, in the order of the geometry nodes, then edges, then the interiors
/// cell by cell: those from [`shared`](Self::shared) on belong to one cell each and can be condensed.
///
/// ```
/// use lumley_fem::element::{Element, P2Bubble, Q2};
/// use lumley_fem::{MeshDescription, PlanarMesh, space::DofMap};
/// let mesh = PlanarMesh::new(MeshDescription::structured([2, 1], |[i, _]| i == 1, |p| p))?;
/// let velocity = DofMap::new(mesh.topology(), P2Bubble.layout(), Q2.layout());
/// // 6 vertices and 8 edges, then the interiors of 3 cells.
/// assert_eq!((velocity.shared(), velocity.len()), (14, 17));
/// assert_eq!(velocity.cell(2).last(), Some(&16));
/// let pressure = DofMap::discontinuous(mesh.topology(), 3);
/// assert_eq!(pressure.cell(1), [3, 4, 5]);
/// # Ok::<(), lumley_fem::MeshError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct DofMap {
    layouts: [DofLayout; 2],
    triangles: usize,
    dofs: Vec<usize>,
    shared: usize,
    len: usize,
}

impl DofMap {
    /// The dofs of a continuous field.
    ///
    /// # Panics
    /// If the layouts are not of a triangle and a quadrilateral, do not agree on what they share, or
    /// have more than one dof on a vertex or an edge.
    pub fn new(topology: &Topology, triangle: DofLayout, quadrilateral: DofLayout) -> Self {
        let layouts = [triangle, quadrilateral];
        assert_eq!(layouts.map(|l| l.cell), [Cell::Triangle, Cell::Quadrilateral], "the kinds");
        let of = layouts.map(|layout| [layout.vertex, layout.edge]);
        assert!(of[0] == of[1], "neighbours share the dofs of their vertices and edges: {of:?}");
        assert!(triangle.vertex <= 1 && triangle.edge <= 1, "one dof on a vertex and on an edge");
        let (vertex_dofs, vertices) = number_vertices(topology);
        let first_edge = vertices * triangle.vertex;
        let shared = first_edge + topology.edges().len() * triangle.edge;
        let (mut dofs, mut len) = (Vec::new(), shared);
        for cell in 0..topology.cells() {
            let layout = layouts[usize::from(topology.kind(cell) == Cell::Quadrilateral)];
            let corners = &topology.cell_nodes(cell)[..layout.cell.vertices() * layout.vertex];
            dofs.extend(corners.iter().map(|&node| vertex_dofs[node]));
            let edges = &topology.cell_edges(cell)[..layout.cell.edges() * layout.edge];
            dofs.extend(edges.iter().map(|&edge| first_edge + edge));
            dofs.extend(len..len + layout.interior);
            len += layout.interior;
        }
        Self { layouts, triangles: topology.triangles().len(), dofs, shared, len }
    }

    /// The dofs of a field that each cell has `per_cell` of for itself, such as the pressure.
    pub fn discontinuous(topology: &Topology, per_cell: usize) -> Self {
        let layout = |cell| DofLayout { cell, vertex: 0, edge: 0, interior: per_cell };
        Self::new(topology, layout(Cell::Triangle), layout(Cell::Quadrilateral))
    }

    /// Number of dofs.
    #[expect(clippy::len_without_is_empty, reason = "a mesh has a cell")]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Number of dofs on vertices and edges; the numbers from here on are interior.
    pub fn shared(&self) -> usize {
        self.shared
    }

    /// Shape of a cell.
    pub fn kind(&self, cell: usize) -> Cell {
        self.layout(cell).cell
    }

    fn layout(&self, cell: usize) -> DofLayout {
        self.layouts[usize::from(cell >= self.triangles)]
    }

    /// Dofs of a cell, in the order of its element: the interior ones last.
    pub fn cell(&self, cell: usize) -> &[usize] {
        &self.dofs[entries(self.triangles, self.layouts.map(DofLayout::nodes), cell)]
    }

    /// Dofs of all triangles, those of each as an array.
    ///
    /// # Panics
    /// If a triangle has not N dofs.
    pub fn triangles<const N: usize>(&self) -> &[[usize; N]] {
        self.arrays(0, &self.dofs[..self.triangles * self.layouts[0].nodes()])
    }

    /// Dofs of all quadrilaterals, those of each as an array.
    ///
    /// # Panics
    /// If a quadrilateral has not N dofs.
    pub fn quadrilaterals<const N: usize>(&self) -> &[[usize; N]] {
        self.arrays(1, &self.dofs[self.triangles * self.layouts[0].nodes()..])
    }

    fn arrays<'a, const N: usize>(&self, kind: usize, dofs: &'a [usize]) -> &'a [[usize; N]] {
        assert_eq!(self.layouts[kind].nodes(), N, "dofs of each {:?}", self.layouts[kind].cell);
        dofs.as_chunks().0
    }

    /// Dofs on an edge of a cell: at its start, at its end, between them.
    pub fn on_edge(&self, Side { cell, edge }: Side) -> impl Iterator<Item = usize> {
        let (layout, dofs) = (self.layout(cell), self.cell(cell));
        layout.on_edge(edge).map(|k| dofs[k])
    }

    /// Dofs on a boundary, each once, increasing.
    pub fn on_boundary(&self, topology: &Topology, boundary: &Boundary) -> Vec<usize> {
        let sides = boundary.edges.iter().map(|&edge| topology.edges()[edge].left);
        let mut dofs: Vec<usize> = sides.flat_map(|side| self.on_edge(side)).collect();
        dofs.sort_unstable();
        dofs.dedup();
        dofs
    }
}

/// The number of each node among the vertices, and how many vertices there are.
fn number_vertices(topology: &Topology) -> (Vec<usize>, usize) {
    let mut is_vertex = vec![false; topology.nodes()];
    for cell in 0..topology.cells() {
        let corners = &topology.cell_nodes(cell)[..topology.kind(cell).vertices()];
        for &node in corners {
            is_vertex[node] = true;
        }
    }
    let mut count = 0;
    let number = |is_vertex: bool| {
        count += usize::from(is_vertex);
        count - usize::from(is_vertex)
    };
    let numbers = is_vertex.into_iter().map(number).collect();
    (numbers, count)
}
