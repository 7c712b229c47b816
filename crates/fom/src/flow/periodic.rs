use super::{Condition, FlowError};
use crate::disjoint_sets::DisjointSets;
use lumley_fem::space::NodalSpace;
use lumley_fem::{Boundary, PlanarMesh, Point};

/// How far from its twin a node may be, over the length of the boundary.
const TOLERANCE: f64 = 1e-8;

/// For every velocity dof the one that stands for it: itself, or the first of those that periodic boundaries make
/// the same.
pub(super) fn representatives(
    mesh: &PlanarMesh,
    space: &NodalSpace,
    conditions: &[Condition],
) -> Result<Vec<usize>, FlowError> {
    let boundaries = mesh.topology().boundaries();
    let points = space.points(mesh);
    let mut dofs = DisjointSets::new(space.dofs().len());
    for (one, condition) in boundaries.iter().zip(conditions) {
        let Condition::Periodic { with } = condition else { continue };
        let other = partner(boundaries, conditions, one, with)?;
        for (a, b) in twins(mesh, space, &points, one, other)? {
            dofs.join(a, b);
        }
    }
    Ok((0..space.dofs().len()).map(|dof| dofs.root(dof)).collect())
}

/// The cells on the two sides of periodic boundaries, which are neighbours.
pub(super) fn neighbours(
    mesh: &PlanarMesh,
    conditions: &[Condition],
    space: &NodalSpace,
    stands_for: &[usize],
) -> Vec<[usize; 2]> {
    let topology = mesh.topology();
    let sides = topology.boundaries().iter().zip(conditions);
    let sides = sides.filter(|(_, condition)| matches!(condition, Condition::Periodic { .. }));
    // The dof in the middle of an edge belongs to that edge alone.
    let mut edges: Vec<(usize, usize)> = sides
        .flat_map(|(boundary, _)| &boundary.edges)
        .map(|&edge| topology.edges()[edge].left)
        .filter_map(|side| Some((stands_for[space.dofs().on_edge(side).last()?], side.cell)))
        .collect();
    edges.sort_unstable();
    edges.windows(2).filter(|pair| pair[0].0 == pair[1].0).map(|p| [p[0].1, p[1].1]).collect()
}

fn partner<'a>(
    boundaries: &'a [Boundary],
    conditions: &[Condition],
    one: &Boundary,
    with: &str,
) -> Result<&'a Boundary, FlowError> {
    let fail = |why| FlowError::NotPeriodic { one: one.name.clone(), other: with.into(), why };
    let place = boundaries.iter().position(|boundary| boundary.name == with);
    let place = place.ok_or_else(|| fail("the mesh has no boundary of the second name"))?;
    if boundaries[place].name == one.name {
        return Err(fail("a boundary is not its own partner"));
    }
    match &conditions[place] {
        Condition::Periodic { with } if *with == one.name => Ok(&boundaries[place]),
        _ => Err(fail("the second must be periodic with the first, too")),
    }
}

/// Pairs of dofs that one translation takes from one boundary to the other.
fn twins(
    mesh: &PlanarMesh,
    space: &NodalSpace,
    points: &[Point],
    one: &Boundary,
    other: &Boundary,
) -> Result<Vec<(usize, usize)>, FlowError> {
    let fail =
        |why| FlowError::NotPeriodic { one: one.name.clone(), other: other.name.clone(), why };
    let [a, b] = [one, other].map(|boundary| space.dofs().on_boundary(mesh.topology(), boundary));
    if a.len() != b.len() {
        return Err(fail("they have different numbers of nodes"));
    }
    let centre = |dofs: &[usize]| -> Point {
        [0, 1].map(|d| dofs.iter().map(|&dof| points[dof][d]).sum::<f64>() / dofs.len() as f64)
    };
    let (from, to) = (centre(&a), centre(&b));
    let tolerance = TOLERANCE * mesh.boundary_length(one);
    let twin = |dof: usize| {
        let place: Point = [0, 1].map(|d| points[dof][d] - from[d] + to[d]);
        let distance =
            |&other: &usize| (points[other][0] - place[0]).hypot(points[other][1] - place[1]);
        let found = b.iter().copied().find(|other| distance(other) <= tolerance);
        found.map(|twin| (dof, twin))
    };
    let pairs: Option<Vec<_>> = a.iter().map(|&dof| twin(dof)).collect();
    pairs.ok_or_else(|| fail("moved as a whole, the nodes of one do not meet those of the other"))
}
