//! The rim of a mesh as closed curves: which of them are bodies in the flow.

use lumley_fem::{PlanarMesh, Point};
use std::collections::BTreeMap;

/// A closed part of the rim, which runs with the fluid at its left.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Ring {
    /// Start, end and middle of its edges, in m.
    pub edges: Vec<[Point; 3]>,
    /// The boundaries that its edges belong to, by their numbers, each once.
    pub boundaries: Vec<usize>,
}

impl Ring {
    /// The area it encloses, in m², negative where the fluid is outside: that is a body.
    pub(super) fn area(&self) -> f64 {
        self.triangles().map(|(area, _)| area).sum()
    }

    /// The centre of that area, in m.
    pub(super) fn centroid(&self) -> Point {
        let moment =
            |d: usize| self.triangles().map(|(area, centre)| area * centre[d]).sum::<f64>();
        [0, 1].map(|d| moment(d) / self.area())
    }

    /// Area and centre of the triangles from the origin to the chords of the halves of its edges.
    fn triangles(&self) -> impl Iterator<Item = (f64, Point)> {
        let chords = self.edges.iter().flat_map(|&[a, b, middle]| [(a, middle), (middle, b)]);
        chords
            .map(|(a, b)| (0.5 * (a[0] * b[1] - a[1] * b[0]), [0, 1].map(|d| (a[d] + b[d]) / 3.0)))
    }

    pub(super) fn is_body(&self) -> bool {
        self.area() < 0.0
    }

    /// The smallest rectangle with its nodes in it.
    pub(super) fn bounds(&self) -> (Point, Point) {
        bounds(self.edges.iter().flatten())
    }
}

/// The smallest rectangle with these points in it; empty without any.
pub(super) fn bounds<'a>(points: impl Iterator<Item = &'a Point>) -> (Point, Point) {
    let nothing = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    points.fold(nothing, |(lower, upper), p| {
        ([0, 1].map(|d| lower[d].min(p[d])), [0, 1].map(|d| upper[d].max(p[d])))
    })
}

/// The closed curves of the rim.
pub(super) fn rings(mesh: &PlanarMesh) -> Vec<Ring> {
    let topology = mesh.topology();
    let mut after: BTreeMap<usize, Vec<(usize, usize)>> = BTreeMap::new();
    for (boundary, part) in topology.boundaries().iter().enumerate() {
        for &edge in &part.edges {
            after.entry(topology.edges()[edge].nodes[0]).or_default().push((edge, boundary));
        }
    }
    let mut rings = Vec::new();
    while let Some((&first, _)) = after.first_key_value() {
        let mut ring = Ring { edges: Vec::new(), boundaries: Vec::new() };
        let mut node = first;
        while let Some((edge, boundary)) = take(&mut after, node) {
            ring.edges.push(mesh.edge(edge));
            if !ring.boundaries.contains(&boundary) {
                ring.boundaries.push(boundary);
            }
            node = topology.edges()[edge].nodes[1];
        }
        rings.push(ring);
    }
    rings
}

/// Takes an edge that begins at `node`.
fn take(after: &mut BTreeMap<usize, Vec<(usize, usize)>>, node: usize) -> Option<(usize, usize)> {
    let edges = after.get_mut(&node)?;
    let edge = edges.pop();
    if edges.is_empty() {
        after.remove(&node);
    }
    edge
}

/// Whether the boundary of this number lies on bodies only.
pub(super) fn is_of_bodies(rings: &[Ring], boundary: usize) -> bool {
    let mut of_it = rings.iter().filter(|ring| ring.boundaries.contains(&boundary)).peekable();
    of_it.peek().is_some() && of_it.all(Ring::is_body)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumley_fem::generate::Channel;

    #[test]
    fn a_disc_in_a_channel_is_a_body_and_the_sides_are_not()
    -> Result<(), Box<dyn std::error::Error>> {
        let channel: Channel = toml::from_str(
            "x = [0, 2]\ny = [0, 1]\nsize = 0.2\n[[bodies]]\nname = 'disc'\nsize = 0.1\n\
             shape = { kind = 'disc', centre = [0.5, 0.5], radius = 0.2 }",
        )?;
        let mesh = PlanarMesh::new(channel.mesh()?)?;
        let rings = rings(&mesh);
        assert_eq!(rings.len(), 2);
        let of_bodies: Vec<bool> = (0..5).map(|k| is_of_bodies(&rings, k)).collect();
        assert_eq!(of_bodies, [false, false, false, false, true]);
        let disc = rings.iter().find(|ring| ring.is_body()).ok_or("no disc")?;
        let area = std::f64::consts::PI * 0.04;
        assert!((disc.area() / area + 1.0).abs() < 0.01, "{}", disc.area());
        assert!(disc.centroid().iter().all(|c| (c - 0.5).abs() < 1e-6), "{:?}", disc.centroid());
        let (lower, upper) = disc.bounds();
        assert!((lower[0] - 0.3).abs() < 1e-3 && (upper[1] - 0.7).abs() < 1e-3);
        Ok(())
    }
}
