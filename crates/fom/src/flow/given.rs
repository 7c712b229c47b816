use super::loads::edge_dofs;
use super::places::DofPlaces;
use super::unknowns::{NodeUnknowns, Unknowns};
use super::{Condition, FlowError};
use lumley_fem::element::{Cell, P2};
use lumley_fem::geometry::{EdgePoint, Tabulated};
use lumley_fem::quadrature::rule;
use lumley_fem::space::NodalSpace;
use lumley_fem::{PlanarMesh, Point};

/// Share of `∮ |u|` along the boundaries that may be left over as flux where there is no outlet: what interpolation
/// of sound data on a coarse mesh leaves.
const LARGEST_SHARE: f64 = 0.02;

/// The velocities that boundaries give.
#[derive(Debug, Clone)]
pub(super) struct Given {
    /// Dofs and the boundaries that give their velocities.
    held: Vec<(usize, usize)>,
    /// Zero where nothing is given.
    pub velocity: Vec<Point>,
    /// Edges of the rim, where the flux counts.
    rim: Vec<RimEdge>,
    rule: Vec<Tabulated<3>>,
}

#[derive(Debug, Clone)]
struct RimEdge {
    edge: usize,
    dofs: [usize; 3],
    /// A boundary that moves as a body displaces nothing but round-off and the order of the time scheme.
    moves: bool,
}

impl Given {
    pub fn new(
        mesh: &PlanarMesh,
        space: &NodalSpace,
        unknowns: &Unknowns,
        moving: &[usize],
    ) -> Self {
        let held = unknowns.nodes.iter().enumerate().filter_map(|(dof, node)| match node {
            NodeUnknowns::Held(boundary) => Some((dof, *boundary)),
            _ => None,
        });
        let rim = mesh.topology().boundaries().iter().enumerate().flat_map(|(number, boundary)| {
            let moves = moving.contains(&number);
            let edge =
                move |&edge: &usize| RimEdge { edge, dofs: edge_dofs(mesh, space, edge), moves };
            boundary.edges.iter().map(edge)
        });
        Self {
            held: held.collect(),
            velocity: vec![[0.0; 2]; space.dofs().len()],
            rim: rim.collect(),
            rule: Tabulated::on(&P2, &rule(Cell::Interval, 5)),
        }
    }

    /// The velocities at `time`, in s; a boundary without slip has the velocity of the mesh.
    pub fn update(
        &mut self,
        mesh: &PlanarMesh,
        places: &DofPlaces,
        conditions: &[Condition],
        mesh_velocity: &[Point],
        time: f64,
    ) -> Result<(), FlowError> {
        for &(dof, boundary) in &self.held {
            self.velocity[dof] = match &conditions[boundary] {
                Condition::Velocity(field) => {
                    let place = mesh.nodes()[places.node(dof)];
                    let value = field.value(place, time);
                    if !value.iter().all(|v| v.is_finite()) {
                        let name = &mesh.topology().boundaries()[boundary].name;
                        let what = format!("the velocity given on boundary `{name}`");
                        return Err(FlowError::NotFinite { what, place, time, value });
                    }
                    value
                }
                _ => mesh_velocity[dof],
            };
        }
        Ok(())
    }

    /// The divergence that the given velocities enforce where all of the rim is held, per s: their flux out of the
    /// domain over its area.
    ///
    /// # Errors
    /// [`FlowError::Flux`] where it is more than interpolation makes.
    pub fn divergence(&self, mesh: &PlanarMesh, time: f64) -> Result<f64, FlowError> {
        let (mut flux, mut through, mut size, mut area) = (0.0, 0.0, 0.0, 0.0);
        for RimEdge { edge, dofs, moves } in &self.rim {
            let nodes = mesh.edge(*edge);
            let velocity = dofs.map(|dof| self.velocity[dof]);
            for at in &self.rule {
                let EdgePoint { point, normal, weight, .. } = EdgePoint::new(&nodes, at);
                let out = at.value(&velocity.map(|u| u[0] * normal[0] + u[1] * normal[1]));
                flux += weight * out;
                through += if *moves { 0.0 } else { weight * out };
                size += weight * at.value(&velocity.map(|u| u[0].hypot(u[1])));
                area += 0.5 * weight * (point[0] * normal[0] + point[1] * normal[1]);
            }
        }
        if through.abs() > LARGEST_SHARE * size {
            let share = 100.0 * through.abs() / size;
            return Err(FlowError::Flux { time, flux: through, share });
        }
        Ok(flux / area)
    }
}
