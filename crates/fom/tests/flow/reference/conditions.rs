//! What holds at the velocity dofs.

use super::plain::{Instant, Plain};
use lumley_fem::element::{Cell, P2};
use lumley_fem::geometry::{EdgePoint, Tabulated};
use lumley_fem::quadrature::rule;
use lumley_fem::{Boundary, PlanarMesh, Point};
use lumley_fom::flow::Condition;

/// Exact for two quadratic functions, a quadratic wind and the length element of a curved edge.
const DEGREE: usize = 7;

/// What holds at a dof.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hold {
    Free,
    /// The velocity along this normal is zero.
    Slip(Point),
    Velocity(Point),
}

/// The points of the edges of a boundary, with the values of the functions of its three dofs.
pub fn along(mesh: &PlanarMesh, boundary: &Boundary) -> Vec<(usize, EdgePoint, [f64; 3])> {
    let points = Tabulated::on(&P2, &rule(Cell::Interval, DEGREE));
    let of_edge = |&edge: &usize| {
        let nodes = mesh.edge(edge);
        points.iter().map(|at| (edge, EdgePoint::new(&nodes, at), at.phi)).collect::<Vec<_>>()
    };
    boundary.edges.iter().flat_map(of_edge).collect()
}

impl Plain {
    /// What holds at each dof at the end of the step.
    pub fn holds(&self, now: &Instant, mesh_velocity: &[Point]) -> Vec<Hold> {
        let points = self.space.points(&now.mesh);
        let mut holds = vec![Hold::Free; points.len()];
        let boundaries = now.mesh.topology().boundaries();
        // What counts more comes later.
        for wanted in ["slip", "velocity", "no-slip"] {
            for (boundary, condition) in boundaries.iter().zip(&self.conditions) {
                if condition.name() != wanted {
                    continue;
                }
                let normals = self.normals(&now.mesh, boundary);
                for dof in self.space.dofs().on_boundary(now.mesh.topology(), boundary) {
                    holds[dof] = match condition {
                        Condition::Slip => Hold::Slip(normals[dof]),
                        Condition::Velocity(u) => Hold::Velocity(u.value(points[dof], now.time)),
                        _ => Hold::Velocity(mesh_velocity[dof]),
                    };
                }
            }
        }
        holds
    }

    /// `∫ φ_i n` over a boundary, of unit length where it is not zero.
    fn normals(&self, mesh: &PlanarMesh, boundary: &Boundary) -> Vec<Point> {
        let mut normals = vec![[0.0; 2]; self.space.dofs().len()];
        for (edge, at, phi) in along(mesh, boundary) {
            for (dof, phi) in self.space.dofs().on_edge(mesh.topology().edges()[edge].left).zip(phi)
            {
                normals[dof] = [0, 1].map(|d| normals[dof][d] + phi * at.weight * at.normal[d]);
            }
        }
        for normal in &mut normals {
            let length = normal[0].hypot(normal[1]);
            if length > 0.0 {
                *normal = normal.map(|n| n / length);
            }
        }
        normals
    }
}
