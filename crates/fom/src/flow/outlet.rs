use super::Condition;
use super::cells::{self, NodalFields, Terms};
use lumley_fem::element::{Cell, P2};
use lumley_fem::geometry::{EdgePoint, Tabulated};
use lumley_fem::quadrature::rule;
use lumley_fem::space::NodalSpace;
use lumley_fem::{PlanarMesh, Point};

/// Exact for two quadratic functions, a quadratic wind and the length element of a curved edge.
const DEGREE: usize = 7;

/// The edges of free boundaries, where fluid that comes back in is held from feeding the flow: `−∫ ρ (u·n)₋ u·v / 2`
/// makes the energy that it carries in vanish.
#[derive(Debug, Clone)]
pub(super) struct Outlet {
    edges: Vec<OutletEdge>,
    rule: Vec<Tabulated<3>>,
}

#[derive(Debug, Clone)]
struct OutletEdge {
    cell: usize,
    /// Shared dofs of the cell.
    shared: usize,
    /// Where start, end and middle of the edge stand in the cell.
    places: [usize; 3],
    /// Their dofs.
    dofs: [usize; 3],
    /// Their nodes.
    nodes: [usize; 3],
}

impl Outlet {
    pub fn new(mesh: &PlanarMesh, space: &NodalSpace, conditions: &[Condition]) -> Self {
        let topology = mesh.topology();
        let free = topology.boundaries().iter().zip(conditions);
        let free = free.filter(|(_, condition)| matches!(condition, Condition::TractionFree));
        let edge = |&edge: &usize| {
            let edge = topology.edges()[edge];
            let corners = topology.kind(edge.left.cell).vertices();
            let k = edge.left.edge;
            let places = [k, (k + 1) % corners, corners + k];
            let dofs = space.dofs().cell(edge.left.cell);
            OutletEdge {
                cell: edge.left.cell,
                shared: dofs.len() - 1,
                places,
                dofs: places.map(|place| dofs[place]),
                nodes: edge.nodes,
            }
        };
        let mut edges: Vec<_> =
            free.flat_map(|(boundary, _)| boundary.edges.iter().map(edge)).collect();
        edges.sort_by_key(|edge| edge.cell);
        Self { edges, rule: Tabulated::on(&P2, &rule(Cell::Interval, DEGREE)) }
    }

    /// The cells that have such an edge.
    pub fn cells(&self) -> impl Iterator<Item = usize> + '_ {
        self.edges.iter().map(|edge| edge.cell)
    }

    /// Adds the term to the condensed matrix and the right-hand side of a cell.
    pub fn add(
        &self,
        cell: usize,
        terms: &Terms,
        fields: &NodalFields<'_>,
        (matrix, right): (&mut [f64], &mut [f64]),
    ) {
        let first = self.edges.partition_point(|edge| edge.cell < cell);
        for edge in self.edges[first..].iter().take_while(|edge| edge.cell == cell) {
            for at in &self.rule {
                edge.add(at, terms, fields, matrix, right);
            }
        }
    }
}

impl OutletEdge {
    /// At a point of the edge; where Newton's method linearises, `(u·n) u` changes with both factors.
    fn add(
        &self,
        at: &Tabulated<3>,
        terms: &Terms,
        fields: &NodalFields<'_>,
        matrix: &mut [f64],
        right: &mut [f64],
    ) {
        let nodes: [Point; 3] = self.nodes.map(|node| fields.nodes[node]);
        let EdgePoint { normal, weight, .. } = EdgePoint::new(&nodes, at);
        let value = |field: &[Point]| -> Point {
            [0, 1].map(|d| at.value(&self.dofs.map(|dof| field[dof][d])))
        };
        let across = |u: Point| u[0] * normal[0] + u[1] * normal[1];
        let out = across(value(fields.wind));
        if out >= 0.0 {
            return;
        }
        let base = if terms.newton { value(fields.base) } else { [0.0; 2] };
        let factor = -0.5 * terms.density * weight;
        let rim = cells::rim(self.shared + 1);
        for (&i, f) in self.places.iter().zip(at.phi) {
            for c in 0..2 {
                let row = c * self.shared + i;
                right[row] += factor * f * base[c] * across(base);
                for (&j, g) in self.places.iter().zip(at.phi) {
                    for d in 0..2 {
                        let carried = if c == d { out } else { 0.0 };
                        let turned = base[c] * normal[d];
                        matrix[(d * self.shared + j) * rim + row] +=
                            factor * f * g * (carried + turned);
                    }
                }
            }
        }
    }
}
