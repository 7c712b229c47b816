use crate::flow::{FlowError, boundary_number};
use lumley_body::{Displaced, RigidBody};
use lumley_fem::element::{Cell, P2};
use lumley_fem::geometry::{EdgePoint, Tabulated};
use lumley_fem::quadrature::rule;
use lumley_fem::transfer::Bodies;
use lumley_fem::{Boundary, PlanarMesh, Point};

/// Exact for the first moments of what a quadratic curve goes round.
const DEGREE: usize = 7;

/// A body with a boundary in the mesh.
#[derive(Debug, Clone)]
pub(super) struct Wet {
    /// Number of the body.
    pub body: usize,
    /// Number of the boundary.
    pub boundary: usize,
    /// Area within the boundary, in m², and its centroid, where the mesh was given, in m.
    pub area: f64,
    pub centroid: Point,
    /// Its farthest node from the centroid, in m.
    pub radius: f64,
}

impl Wet {
    /// The bodies with a boundary, which must be the outline of a hole in the mesh.
    pub fn all(bodies: &[RigidBody], mesh: &PlanarMesh) -> Result<Vec<Self>, FlowError> {
        let wet = bodies.iter().enumerate().filter_map(|(k, body)| {
            let name = body.boundary.as_deref()?;
            Some(Self::new(k, name, mesh))
        });
        let wet: Vec<Self> = wet.collect::<Result<_, _>>()?;
        if wet.is_empty() { Err(FlowError::DryBodies) } else { Ok(wet) }
    }

    fn new(body: usize, name: &str, mesh: &PlanarMesh) -> Result<Self, FlowError> {
        let number = boundary_number(mesh, name)?;
        Bodies::new(mesh, &[name])?;
        let boundary = &mesh.topology().boundaries()[number];
        let (area, centroid) = within(mesh, boundary);
        let distance = |[x, y]: Point| (x - centroid[0]).hypot(y - centroid[1]);
        let nodes = boundary.edges.iter().flat_map(|&edge| mesh.edge(edge));
        let radius = nodes.map(distance).fold(0.0, f64::max);
        Ok(Self { body, boundary: number, area, centroid, radius })
    }

    /// The fluid of this density that it displaces.
    pub fn displaced(&self, density: f64) -> Displaced {
        Displaced { mass: density * self.area, centre: self.centroid }
    }
}

/// Area and centroid of what a boundary goes round; the normal of the fluid points into it.
fn within(mesh: &PlanarMesh, boundary: &Boundary) -> (f64, Point) {
    let points = Tabulated::on(&P2, &rule(Cell::Interval, DEGREE));
    let (mut area, mut moment) = (0.0, [0.0; 2]);
    for &edge in &boundary.edges {
        let nodes = mesh.edge(edge);
        for at in &points {
            let EdgePoint { point, normal, weight, .. } = EdgePoint::new(&nodes, at);
            area -= 0.5 * weight * (point[0] * normal[0] + point[1] * normal[1]);
            moment = [0, 1].map(|d| moment[d] - 0.5 * weight * point[d] * point[d] * normal[d]);
        }
    }
    (area, moment.map(|m| m / area))
}
