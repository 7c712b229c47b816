use super::super::MeshError;
use super::super::check::Draft;
use super::{Edge, Side};

/// An edge as one of its cells has it.
#[derive(Clone, Copy)]
struct HalfEdge {
    nodes: [usize; 3],
    side: Side,
}

/// What both cells of an edge agree on: its ends, the smaller number first.
pub(super) fn key([a, b, _]: [usize; 3]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

/// The edges of all cells, each once, sorted by their [`key`].
pub(super) fn join(draft: Draft<'_>) -> Result<Vec<Edge>, MeshError> {
    let half =
        |(cell, edge)| HalfEdge { nodes: draft.cells.edge(cell, edge), side: Side { cell, edge } };
    let mut halves: Vec<HalfEdge> = draft.cells.edges().map(half).collect();
    halves.sort_by_key(|half| (key(half.nodes), half.side.cell));
    halves
        .chunk_by(|a, b| key(a.nodes) == key(b.nodes))
        .map(|group| join_halves(draft, group))
        .collect()
}

fn join_halves(draft: Draft<'_>, group: &[HalfEdge]) -> Result<Edge, MeshError> {
    let nodes = group[0].nodes;
    let edge = draft.edge_place([nodes[0], nodes[1]]);
    let right = match *group {
        [_] => None,
        [a, b] => {
            let cells = [a.side.cell, b.side.cell];
            if a.nodes[2] != b.nodes[2] {
                let middles = [a.nodes[2], b.nodes[2]];
                return Err(MeshError::Middles { edge, cells, middles });
            }
            if a.nodes[0] == b.nodes[0] {
                return Err(MeshError::Overlap { edge, cells });
            }
            Some(b.side)
        }
        _ => {
            let cells = [0, 1, 2].map(|k| group[k].side.cell);
            return Err(MeshError::CrowdedEdge { edge, cells });
        }
    };
    Ok(Edge { nodes, left: group[0].side, right })
}
