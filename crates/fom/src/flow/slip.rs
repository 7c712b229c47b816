use super::Condition;
use super::loads::edge_dofs;
use lumley_fem::element::{Cell, P2};
use lumley_fem::geometry::{EdgePoint, Tabulated};
use lumley_fem::quadrature::rule;
use lumley_fem::space::NodalSpace;
use lumley_fem::{PlanarMesh, Point};

/// Cosine of the angle between two edges above which their boundary has a kink.
const KINK: f64 = 0.9;

/// The dofs at which the fluid slips along a boundary.
///
/// The normal of a dof is that of the finite-element functions, `∫ φ_i n`, so that no fluid goes through the curved
/// boundary (Engelman, Sani and Gresho 1982, Int. J. Numer. Methods Fluids 2, 225-238).
#[derive(Debug, Clone)]
pub(super) struct Slides {
    /// Number of the slide by shared dof.
    of: Vec<Option<usize>>,
    count: usize,
    edges: Vec<SlipEdge>,
    rule: Vec<Tabulated<3>>,
}

#[derive(Debug, Clone)]
struct SlipEdge {
    edge: usize,
    slides: [Option<usize>; 3],
}

impl Slides {
    /// The dofs on slip boundaries, but for those at kinks.
    pub fn new(mesh: &PlanarMesh, space: &NodalSpace, conditions: &[Condition]) -> Self {
        let topology = mesh.topology();
        let slip = topology.boundaries().iter().zip(conditions);
        let slip = slip.filter(|(_, condition)| matches!(condition, Condition::Slip));
        let edges: Vec<usize> = slip.flat_map(|(boundary, _)| boundary.edges.clone()).collect();
        let dofs = |edge: usize| edge_dofs(mesh, space, edge);
        let mut normals: Vec<Option<Point>> = vec![None; space.dofs().shared()];
        let mut kinks = vec![false; normals.len()];
        let ends = Tabulated::at_nodes(&P2, &P2);
        for &edge in &edges {
            for (dof, at) in dofs(edge).into_iter().zip(&ends) {
                let EdgePoint { normal, .. } = EdgePoint::new(&mesh.edge(edge), at);
                let seen = *normals[dof].get_or_insert(normal);
                kinks[dof] |= seen[0] * normal[0] + seen[1] * normal[1] < KINK;
            }
        }
        let mut count = 0;
        let mut of = vec![None; normals.len()];
        for (dof, slide) in of.iter_mut().enumerate() {
            if normals[dof].is_some() && !kinks[dof] {
                *slide = Some(count);
                count += 1;
            }
        }
        let slides = |edge: usize| dofs(edge).map(|dof| of[dof]);
        let edges = edges.iter().map(|&edge| SlipEdge { edge, slides: slides(edge) }).collect();
        let rule = Tabulated::on(&P2, &rule(Cell::Interval, 5));
        Self { of, count, edges, rule }
    }

    /// Number of slides.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The slide of a dof.
    pub fn of(&self, dof: usize) -> Option<usize> {
        self.of[dof]
    }

    /// Computes the unit tangents, by slide, where the mesh is now.
    pub fn follow(&self, mesh: &PlanarMesh, tangents: &mut [Point]) {
        tangents.fill([0.0; 2]);
        for SlipEdge { edge, slides } in &self.edges {
            let nodes = mesh.edge(*edge);
            for at in &self.rule {
                let EdgePoint { tangent, weight, .. } = EdgePoint::new(&nodes, at);
                for (slide, phi) in slides.iter().zip(at.phi) {
                    if let Some(slide) = slide {
                        let sum = &mut tangents[*slide];
                        *sum = [0, 1].map(|d| sum[d] + phi * weight * tangent[d]);
                    }
                }
            }
        }
        for tangent in tangents {
            let length = tangent[0].hypot(tangent[1]);
            *tangent = tangent.map(|t| t / length);
        }
    }
}
