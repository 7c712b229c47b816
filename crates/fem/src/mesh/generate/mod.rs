//! Meshes of channels with bodies: rows of quadrilaterals and triangles round the bodies, rectangles beyond.
//!
//! The same input gives the same mesh, bit for bit.

mod channel;
mod curve;
mod divide;
mod error;
mod lattice;
mod layers;
mod outline;
mod placed;
mod plane;
mod shape;
mod size;
mod smooth;
mod triangles;
mod validity;

pub use channel::{Body, Channel, Layers, Rectangle};
pub use error::GenerateError;
pub use shape::{Disc, Ellipse, Polygon, Shape};

use crate::{MeshDescription, NamedBoundary, Point};
use lattice::Lattice;
use layers::Rows;
use placed::{Placed, place, rectangle};
use plane::between;
use size::{SizeField, Source};
use std::collections::HashMap;
use triangles::{Region, fill};

impl Channel {
    /// The mesh: boundaries `left`, `right`, `bottom`, `top`, then the bodies.
    ///
    /// The nodes on discs and ellipses lie on them, the middles of edges too: areas and lengths are right to
    /// the fourth order of the size.
    ///
    /// # Errors
    /// Every variant of [`GenerateError`].
    pub fn mesh(&self) -> Result<MeshDescription, GenerateError> {
        self.check()?;
        let placed = place(self)?;
        let rectangle = rectangle(self, &placed)?;
        let mut sources = Vec::new();
        if let Some(within) = rectangle {
            for body in &placed {
                sources.extend(body.sources(&placed, within, self.growth)?);
            }
        }
        let field = SizeField::new(self.size, self.growth, &sources);

        let mut points = Vec::new();
        let mut lattice = Lattice::new(self, rectangle, &field)?;
        lattice.number(&mut points);
        let mut mesh = MeshDescription {
            points,
            triangles: vec![],
            quadrilaterals: lattice.quadrilaterals(),
            boundaries: lattice.sides(),
        };
        let mut rim = lattice.rim_of_hole();
        sources.extend(rim.iter().map(|edge| Source::of_edge(edge.map(|node| mesh.points[node]))));
        self.add_layers(&placed, &field, &mut mesh, &mut rim)?;
        let field = SizeField::new(self.size, self.growth, &sources);
        add_triangles(&rim, &field, &mut mesh, self.limit)?;
        if mesh.triangles.len() + mesh.quadrilaterals.len() > self.limit {
            return Err(GenerateError::TooManyCells { limit: self.limit });
        }
        validity::check(&mesh)?;
        Ok(mesh)
    }

    /// Appends the rows of cells along the bodies, and their outer edges to the rim of the triangles.
    fn add_layers(
        &self,
        placed: &[Placed<'_>],
        field: &SizeField,
        mesh: &mut MeshDescription,
        rim: &mut Vec<[usize; 3]>,
    ) -> Result<(), GenerateError> {
        for body in placed {
            let rows = Rows::new(body, field, &mut mesh.points, self.limit)?;
            rim.extend(rows.rim);
            mesh.quadrilaterals.extend(rows.quadrilaterals);
            let name = body.body.name.clone();
            mesh.boundaries.push(NamedBoundary { name, edges: rows.body });
            if mesh.quadrilaterals.len() > self.limit {
                return Err(GenerateError::TooManyCells { limit: self.limit });
            }
        }
        Ok(())
    }
}

/// Fills what is within these edges with triangles. The first edge has them on its left.
fn add_triangles(
    rim: &[[usize; 3]],
    field: &SizeField,
    mesh: &mut MeshDescription,
    limit: usize,
) -> Result<(), GenerateError> {
    if rim.is_empty() {
        return Ok(());
    }
    let mut nodes: Vec<usize> = rim.iter().map(|edge| edge[0]).collect();
    let local: HashMap<usize, usize> = (0..).zip(&nodes).map(|(k, &node)| (node, k)).collect();
    let region = Region {
        corners: nodes.iter().map(|&node| mesh.points[node]).collect(),
        edges: rim.iter().map(|edge| [local[&edge[0]], local[&edge[1]]]).collect(),
    };
    let (points, triangles) = fill(&region, field, limit)?;
    let new = &points[nodes.len()..];
    nodes.extend(mesh.points.len()..mesh.points.len() + new.len());
    mesh.points.extend(new);
    let mut middles = Middles::new(rim);
    mesh.triangles = triangles
        .iter()
        .map(|corners| {
            let [a, b, c] = corners.map(|corner| nodes[corner]);
            let [d, e, f] = [[a, b], [b, c], [c, a]].map(|edge| middles.of(edge, &mut mesh.points));
            [a, b, c, d, e, f]
        })
        .collect();
    Ok(())
}

/// The middle nodes of edges.
struct Middles(HashMap<[usize; 2], usize>);

impl Middles {
    fn new(edges: &[[usize; 3]]) -> Self {
        Self(edges.iter().map(|&[a, b, middle]| ([a.min(b), a.max(b)], middle)).collect())
    }

    fn of(&mut self, [a, b]: [usize; 2], points: &mut Vec<Point>) -> usize {
        *self.0.entry([a.min(b), a.max(b)]).or_insert_with(|| {
            points.push(between(points[a], points[b], 0.5));
            points.len() - 1
        })
    }
}
