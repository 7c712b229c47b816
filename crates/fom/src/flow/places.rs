use lumley_fem::element::{P2Bubble, TriangleP2};
use lumley_fem::geometry::Tabulated;
use lumley_fem::space::NodalSpace;
use lumley_fem::{Point, Topology};

/// Which geometry node each velocity dof sits on; the dofs inside of triangles sit on none.
#[derive(Debug, Clone)]
pub(super) struct DofPlaces {
    nodes: Vec<usize>,
    /// Dofs inside of triangles, and the nodes of these.
    inside: Vec<(usize, [usize; 6])>,
    /// The functions of the geometry there.
    weights: [f64; 6],
}

impl DofPlaces {
    pub fn new(topology: &Topology, space: &NodalSpace) -> Self {
        let mut nodes = vec![0; space.dofs().len()];
        let mut inside = Vec::new();
        for cell in 0..topology.cells() {
            let (dofs, cell_nodes) = (space.dofs().cell(cell), topology.cell_nodes(cell));
            for (&dof, &node) in dofs.iter().zip(cell_nodes) {
                nodes[dof] = node;
            }
            if cell < topology.triangles().len() {
                inside.push((dofs[6], topology.triangles()[cell]));
            }
        }
        let weights = Tabulated::<6>::at_nodes(&TriangleP2, &P2Bubble)[6].phi;
        Self { nodes, inside, weights }
    }

    /// The node under a dof that cells share.
    pub fn node(&self, dof: usize) -> usize {
        self.nodes[dof]
    }

    /// Takes vectors at the geometry nodes to the dofs.
    pub fn spread(&self, at_nodes: &[Point], at_dofs: &mut [Point]) {
        for (value, &node) in at_dofs.iter_mut().zip(&self.nodes) {
            *value = at_nodes[node];
        }
        for (dof, nodes) in &self.inside {
            let sum =
                |d: usize| nodes.iter().zip(&self.weights).map(|(&n, w)| at_nodes[n][d] * w).sum();
            at_dofs[*dof] = [sum(0), sum(1)];
        }
    }
}
