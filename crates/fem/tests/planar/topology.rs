//! Edges and neighbours of mixed meshes.

use crate::{bend, some};
use lumley_fem::{MeshDescription, PlanarMesh, Side};
use std::collections::HashSet;

fn mesh() -> PlanarMesh {
    PlanarMesh::new(MeshDescription::structured([6, 5], some, bend)).expect("valid")
}

/// Euler's formula for a domain without holes: vertices − edges + cells = 1.
#[test]
fn numbers_obey_euler() {
    let mesh = mesh();
    let topology = mesh.topology();
    let vertices: HashSet<usize> =
        topology.edges().iter().flat_map(|edge| [edge.nodes[0], edge.nodes[1]]).collect();
    assert_eq!(vertices.len() + topology.cells(), topology.edges().len() + 1);
    assert_eq!(
        vertices.len() + topology.edges().len() + topology.quadrilaterals().len(),
        topology.nodes()
    );
}

#[test]
fn neighbours_are_mutual() {
    let mesh = mesh();
    let topology = mesh.topology();
    let mut on_the_rim = 0;
    for cell in 0..topology.cells() {
        for edge in 0..topology.kind(cell).edges() {
            let number = topology.cell_edges(cell)[edge];
            match topology.neighbour(cell, edge) {
                None => on_the_rim += 1,
                Some(Side { cell: other, edge: its }) => {
                    assert_ne!(cell, other);
                    assert_eq!(topology.cell_edges(other)[its], number);
                    assert_eq!(topology.neighbour(other, its), Some(Side { cell, edge }));
                }
            }
        }
    }
    let named: usize = topology.boundaries().iter().map(|boundary| boundary.edges.len()).sum();
    assert_eq!((on_the_rim, named), (22, 22));
}

/// Edges run as their left cell has them, with its nodes.
#[test]
fn edges_run_round_their_left_cell() {
    let mesh = mesh();
    for edge in mesh.topology().edges() {
        let Side { cell, edge: k } = edge.left;
        let (nodes, n) = (mesh.topology().cell_nodes(cell), mesh.topology().kind(cell).vertices());
        assert_eq!(edge.nodes, [nodes[k], nodes[(k + 1) % n], nodes[n + k]]);
    }
}

#[test]
fn boundaries_keep_name_and_order() {
    let mesh = mesh();
    let names: Vec<&str> = mesh.topology().boundaries().iter().map(|b| b.name.as_str()).collect();
    assert_eq!(names, ["bottom", "right", "top", "left"]);
    assert!(mesh.topology().boundary("inlet").is_none());
}
