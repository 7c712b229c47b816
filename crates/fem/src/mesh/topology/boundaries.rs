use super::super::check::Draft;
use super::super::{MeshError, NamedBoundary};
use super::edges::key;
use super::{Boundary, Edge};

/// The boundaries with the numbers of their edges; every edge of the rim in exactly one.
pub(super) fn attach(
    draft: Draft<'_>,
    edges: &[Edge],
    named: &[NamedBoundary],
) -> Result<Vec<Boundary>, MeshError> {
    check_names(named)?;
    let mut owner: Vec<Option<usize>> = vec![None; edges.len()];
    let mut boundaries = Vec::with_capacity(named.len());
    for (number, NamedBoundary { name, edges: given }) in named.iter().enumerate() {
        let mut found = Vec::with_capacity(given.len());
        for &nodes in given {
            let edge = find(draft, edges, name, nodes)?;
            if let Some(other) = owner[edge].replace(number) {
                let names = [named[other].name.clone(), name.clone()];
                let edge = draft.edge_place([nodes[0], nodes[1]]);
                return Err(MeshError::NamedTwice { edge, names });
            }
            found.push(edge);
        }
        boundaries.push(Boundary { name: name.clone(), edges: found });
    }
    check_rim(draft, edges, &owner)?;
    Ok(boundaries)
}

fn check_names(named: &[NamedBoundary]) -> Result<(), MeshError> {
    for (number, NamedBoundary { name, edges }) in named.iter().enumerate() {
        if name.trim().is_empty() {
            return Err(MeshError::BlankName(number));
        }
        if named[..number].iter().any(|other| other.name == *name) {
            return Err(MeshError::NameTwice(name.clone()));
        }
        if edges.is_empty() {
            return Err(MeshError::EmptyBoundary(name.clone()));
        }
    }
    Ok(())
}

/// The number of the rim edge with these nodes.
fn find(
    draft: Draft<'_>,
    edges: &[Edge],
    name: &str,
    nodes: [usize; 3],
) -> Result<usize, MeshError> {
    let (name, edge) = (name.to_owned(), draft.edge_place([nodes[0], nodes[1]]));
    let Ok(number) = edges.binary_search_by_key(&key(nodes), |edge| key(edge.nodes)) else {
        return Err(MeshError::NoSuchEdge { name, edge });
    };
    let Edge { nodes: [_, _, expected], left, right } = edges[number];
    if let Some(right) = right {
        return Err(MeshError::BoundaryInside { name, edge, cells: [left.cell, right.cell] });
    }
    if nodes[2] != expected {
        return Err(MeshError::BoundaryMiddle { name, edge, given: nodes[2], expected });
    }
    Ok(number)
}

fn check_rim(draft: Draft<'_>, edges: &[Edge], owner: &[Option<usize>]) -> Result<(), MeshError> {
    let mut unnamed =
        edges.iter().zip(owner).filter(|(edge, owner)| edge.right.is_none() && owner.is_none());
    let Some((Edge { nodes: [a, b, _], .. }, _)) = unnamed.next() else {
        return Ok(());
    };
    Err(MeshError::Unnamed { first: draft.edge_place([*a, *b]), count: 1 + unnamed.count() })
}
