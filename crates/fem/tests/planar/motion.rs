//! Nodes that move under a topology that stays.

use crate::{bend, some};
use lumley_fem::{MeshDescription, MeshError, PlanarMesh};

fn mesh() -> PlanarMesh {
    PlanarMesh::new(MeshDescription::structured([5, 4], some, bend)).expect("valid")
}

#[test]
fn a_rigid_motion_changes_no_quality() {
    let (mut moved, still) = (mesh(), mesh());
    let (sin, cos) = 0.7_f64.sin_cos();
    for node in moved.nodes_mut() {
        *node = [3.0 + cos * node[0] - sin * node[1], -1.0 + sin * node[0] + cos * node[1]];
    }
    moved.check().expect("still valid");
    assert_eq!(moved.topology(), still.topology());
    for (a, b) in moved.cell_qualities().iter().zip(still.cell_qualities()) {
        assert!((a.area - b.area).abs() < 1e-14 && (a.aspect - b.aspect).abs() < 1e-11);
        assert!((a.scaled_jacobian - b.scaled_jacobian).abs() < 1e-12);
        assert!((a.longest_edge - b.longest_edge).abs() < 1e-14);
    }
}

/// The corner of a cell pushed through the opposite side: found in the cell and near the place.
#[test]
fn a_tangled_cell_is_named_with_its_place() {
    let mut mesh = mesh();
    let cell = mesh.topology().cells() - 1;
    let nodes = mesh.topology().cell_nodes(cell).to_vec();
    let (corner, opposite) = (nodes[2], mesh.nodes()[nodes[0]]);
    mesh.nodes_mut()[corner] = [opposite[0] - 0.05, opposite[1] - 0.05];
    let error = mesh.check().expect_err("tangled");
    let MeshError::Inverted { cell: found, determinant } = &error else { panic!("{error}") };
    assert!(found.cell <= cell && *determinant <= 0.0);
    let distance = (found.place[0] - opposite[0]).hypot(found.place[1] - opposite[1]);
    assert!(distance < 0.7, "{error}");
}

#[test]
fn a_node_that_is_lost_is_named() {
    let mut mesh = mesh();
    mesh.nodes_mut()[7][1] = f64::NAN;
    assert!(matches!(mesh.check(), Err(MeshError::NotFinite(place)) if place.node == 7));
}
