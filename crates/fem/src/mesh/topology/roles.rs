use super::super::MeshError;
use super::super::check::Draft;
use super::super::place::NodeRole;
use super::Edge;
use NodeRole::{Centre, Corner, Middle};

/// Whether every node is either a corner, or the middle of one edge, or the centre of one cell.
pub(super) fn check(draft: Draft<'_>, edges: &[Edge]) -> Result<(), MeshError> {
    let mut roles: Vec<Option<NodeRole>> = vec![None; draft.points.len()];
    for cell in 0..draft.cells.len() {
        for &node in draft.cells.corners(cell) {
            roles[node] = Some(Corner);
        }
    }
    let middles = edges.iter().map(|edge| (edge.nodes[2], Middle));
    let centres = draft.cells.quadrilaterals.iter().map(|nodes| (nodes[8], Centre));
    for (node, role) in middles.chain(centres) {
        if let Some(other) = roles[node].replace(role) {
            return Err(MeshError::TwoRoles { node: draft.node_place(node), roles: [other, role] });
        }
    }
    Ok(())
}
