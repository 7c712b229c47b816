use super::MotionError;
use super::outline::Outline;
use lumley_fem::{NodePlace, PlanarMesh};

/// What a node does when the bodies move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Tie {
    /// It follows them in part.
    Free,
    /// It stays, on a boundary that does not move.
    Fixed,
    /// It moves with this body.
    Body(usize),
}

/// The ties of all nodes. The bodies are boundaries of the mesh, given by their numbers; the cells with a
/// node closer than `zone` to a body, in m, belong to it as a whole, so that the motion changes its slope only
/// at edges between cells.
pub(super) fn ties(
    mesh: &PlanarMesh,
    bodies: &[usize],
    outlines: &[Outline],
    zone: f64,
) -> Result<Vec<Tie>, MotionError> {
    let owners = owners(mesh, bodies)?;
    let tie = |owner: &Option<usize>| {
        owner.map_or(Tie::Free, |o| {
            bodies.iter().position(|&b| b == o).map_or(Tie::Fixed, Tie::Body)
        })
    };
    let mut ties: Vec<Tie> = owners.iter().map(tie).collect();
    if zone > 0.0 {
        let zones = Zones { reach: outlines.iter().map(|o| reach(mesh, o)).collect(), owners };
        zones.check(mesh, bodies, zone)?;
        for (body, reach) in zones.reach.iter().enumerate() {
            let inside = ties.iter_mut().zip(reach).filter(|(_, reach)| **reach < zone);
            inside.for_each(|(tie, _)| *tie = Tie::Body(body));
        }
    }
    Ok(ties)
}

/// The boundary that each node of the rim is on; corners of boundaries that stay are on the last of them.
fn owners(mesh: &PlanarMesh, bodies: &[usize]) -> Result<Vec<Option<usize>>, MotionError> {
    let (topology, mut owners) = (mesh.topology(), vec![None; mesh.nodes().len()]);
    for (number, boundary) in topology.boundaries().iter().enumerate() {
        for node in boundary.edges.iter().flat_map(|&edge| topology.edges()[edge].nodes) {
            let before: Option<usize> = owners[node].replace(number);
            let Some(other) = before.filter(|&other| other != number) else { continue };
            if bodies.contains(&number) || bodies.contains(&other) {
                let names = [other, number].map(|k| topology.boundaries()[k].name.clone());
                let node = NodePlace { node, place: mesh.nodes()[node] };
                return Err(MotionError::Touching { node, names });
            }
        }
    }
    Ok(owners)
}

/// For each node, the zone beyond which it moves with a body, in m.
fn reach(mesh: &PlanarMesh, outline: &Outline) -> Vec<f64> {
    let distances: Vec<f64> = mesh.nodes().iter().map(|&node| outline.distance(node)).collect();
    let mut reach = vec![f64::INFINITY; distances.len()];
    for cell in 0..mesh.topology().cells() {
        let nodes = mesh.topology().cell_nodes(cell);
        let nearest = nodes.iter().map(|&node| distances[node]).fold(f64::INFINITY, f64::min);
        for &node in nodes {
            reach[node] = nearest.min(reach[node]);
        }
    }
    reach
}

/// The zones of all bodies.
struct Zones {
    reach: Vec<Vec<f64>>,
    owners: Vec<Option<usize>>,
}

impl Zones {
    /// Whether no node belongs to two bodies, or to one and to a boundary that stays.
    fn check(&self, mesh: &PlanarMesh, bodies: &[usize], zone: f64) -> Result<(), MotionError> {
        let conflicts = self.conflicts(bodies);
        let worst = conflicts.min_by(|(a, _), (b, _)| a.total_cmp(b));
        match worst {
            Some((largest, pair)) if largest < zone => {
                let [boundary, other] = pair.map(|k| mesh.topology().boundaries()[k].name.clone());
                Err(MotionError::ZoneReaches { boundary, other, zone, largest })
            }
            _ => Ok(()),
        }
    }

    /// The zones from which on a node belongs to a body and to another boundary, and these two.
    fn conflicts<'a>(
        &'a self,
        bodies: &'a [usize],
    ) -> impl Iterator<Item = (f64, [usize; 2])> + 'a {
        let fixed = self.owners.iter().enumerate().filter_map(|(node, owner)| {
            owner.filter(|owner| !bodies.contains(owner)).map(|owner| (node, owner))
        });
        let with_fixed = fixed.flat_map(move |(node, owner)| {
            bodies.iter().zip(&self.reach).map(move |(&b, reach)| (reach[node], [b, owner]))
        });
        let pairs = (0..bodies.len()).flat_map(|b| (0..b).map(move |a| (a, b)));
        let with_each_other = pairs.flat_map(move |(a, b)| {
            let both = self.reach[a].iter().zip(&self.reach[b]);
            both.map(move |(x, y)| (x.max(*y), [bodies[a], bodies[b]]))
        });
        with_fixed.chain(with_each_other)
    }
}
