//! Each way in which a mesh can be wrong has its error, with the place and the remedy.

use lumley_fem::{MeshDescription, MeshError, NamedBoundary, PlanarMesh};

/// Two by two cells on the square of 2 m, the cells of the first column cut: 4 triangles, 2 squares.
fn mesh() -> MeshDescription {
    MeshDescription::structured([2, 2], |[i, _]| i == 0, |[x, y]| [2.0 * x, 2.0 * y])
}

/// What the changed mesh is refused with.
fn refused(change: impl FnOnce(&mut MeshDescription)) -> String {
    let mut description = mesh();
    change(&mut description);
    PlanarMesh::new(description).expect_err("to be refused").to_string()
}

#[track_caller]
fn says(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "\"{message}\" does not say \"{part}\"");
    }
}

#[test]
fn unchanged_it_is_a_mesh() {
    PlanarMesh::new(mesh()).expect("valid");
}

#[test]
fn no_cells() {
    let message =
        refused(|m| *m = MeshDescription { points: vec![[0.0; 2]], ..Default::default() });
    says(&message, &["no cells", "at least one"]);
}

#[test]
fn coordinates_that_are_no_numbers() {
    for bad in [f64::NAN, f64::INFINITY, -1e300] {
        let message = refused(|m| m.points[3][1] = bad);
        says(&message, &["node 3", "finite"]);
    }
}

#[test]
fn nodes_that_are_not_there() {
    let message = refused(|m| m.triangles[1][4] = 25);
    says(&message, &["cell 1", "node 25", "25 nodes, numbered from 0"]);
    let message = refused(|m| m.quadrilaterals[1][8] = usize::MAX);
    says(&message, &["cell 5", "25 nodes"]);
    let message = refused(|m| m.boundaries[2].edges[0][1] = 99);
    says(&message, &["boundary \"top\"", "node 99", "25 nodes"]);
}

#[test]
fn a_node_twice_in_a_cell() {
    let message = refused(|m| m.quadrilaterals[0][8] = m.quadrilaterals[0][1]);
    says(&message, &["node 4 at (2, 0) m", "twice in cell 4"]);
}

#[test]
fn nodes_of_no_cell() {
    let message = refused(|m| m.points.extend([[0.3, 7.0], [0.4, 8.0]]));
    says(&message, &["node 25 at (0.3, 7) m", "one of 2", "remove"]);
}

#[test]
fn two_nodes_in_one_place() {
    let message = refused(|m| {
        m.points.push([2.0, 1.0 + 1e-12]);
        m.quadrilaterals[1][1] = 25;
        m.boundaries[1].edges[1][0] = 25;
    });
    says(&message, &["node 14 at (2, 1) m", "node 25", "merge"]);
}

#[test]
fn a_cell_twice() {
    let message = refused(|m| m.triangles.push(m.triangles[2]));
    says(&message, &["cell 2 near", "cell 4", "same corners", "remove"]);
}

#[test]
fn a_clockwise_cell() {
    let message = refused(|m| {
        let [a, b, c, ab, bc, ca] = m.triangles[0];
        m.triangles[0] = [a, c, b, ca, bc, ab];
    });
    says(&message, &["cell 0 near", "-1e0 m²", "counterclockwise"]);
}

#[test]
fn a_flat_cell() {
    let message = refused(|m| {
        let [a, b, c, ..] = m.triangles[0];
        m.points[c] = [0.7, 0.0];
        let middle = |p: [f64; 2], q: [f64; 2]| [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
        m.points[m.triangles[0][4]] = middle(m.points[b], m.points[c]);
        m.points[m.triangles[0][5]] = middle(m.points[a], m.points[c]);
    });
    says(&message, &["cell 0 near", "expected above 0"]);
}

#[test]
fn an_edge_bent_through_its_cell() {
    let message = refused(|m| m.points[m.quadrilaterals[0][4]] = [1.5, 0.8]);
    says(&message, &["cell 4 near", "straighten", "refine"]);
}

/// A third cell on an inner edge, on top of one of the two.
#[test]
fn three_cells_on_an_edge() {
    let message = refused(|m| {
        let [a, b, .., ab, _, _] = m.triangles[1];
        m.points.extend([[0.3, 1.5], [0.65, 1.25], [0.15, 0.75]]);
        m.triangles.push([a, b, 25, ab, 26, 27]);
    });
    says(&message, &["more than two cells", "[0, 1, 4]", "from node 12 to node 0", "(0.5, 0.5) m"]);
}

/// A cell laid over a cell at the rim.
#[test]
fn two_cells_on_the_same_side() {
    let message = refused(|m| {
        m.points.extend([[0.5, 0.3], [0.7, 0.1], [0.2, 0.2]]);
        m.triangles.push([0, 2, 25, 1, 26, 27]);
    });
    says(&message, &["cells 0 and 4", "same side", "overlap"]);
}

#[test]
fn middles_that_differ() {
    let message = refused(|m| {
        m.points.push([0.5, 0.52]);
        m.triangles[1][3] = 25;
    });
    says(&message, &["cells 0 and 1", "node 6 for one and node 25", "give both the same"]);
}

/// A small triangle whose corner is the middle of an edge of a large one.
#[test]
fn a_hanging_node() {
    let mut m = MeshDescription {
        points: vec![[0.0, 0.0], [2.0, 0.0], [0.0, 2.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
        triangles: vec![[0, 1, 2, 3, 4, 5], [4, 6, 7, 8, 9, 10]],
        ..MeshDescription::default()
    };
    m.points.extend([[2.0, 1.0], [1.5, 2.0], [1.5, 1.0], [1.75, 1.5], [1.25, 1.5]]);
    let message = PlanarMesh::new(m).expect_err("a hanging node").to_string();
    says(&message, &["node 4 at (1, 1) m", "a corner", "the middle of an edge", "hanging"]);
}

#[test]
fn names() {
    let message = refused(|m| m.boundaries[1].name = " ".into());
    says(&message, &["boundary number 1", "no name"]);
    let message = refused(|m| m.boundaries[1].name = "left".into());
    says(&message, &["two boundaries are called \"left\"", "rename"]);
    let wake = NamedBoundary { name: "wake".into(), edges: vec![] };
    says(&refused(|m| m.boundaries.push(wake)), &["\"wake\" has no edges"]);
}

#[test]
fn rim_edges_without_a_name() {
    let message = refused(|m| drop(m.boundaries.remove(2)));
    says(&message, &["from node 22 to node 20", "(0.5, 2) m", "one of 2", "name them"]);
    assert!(matches!(
        PlanarMesh::new(MeshDescription { boundaries: vec![], ..mesh() }),
        Err(MeshError::Unnamed { count: 8, .. })
    ));
}

#[test]
fn rim_edges_with_two_names() {
    let message = refused(|m| {
        let edge = m.boundaries[0].edges[1];
        m.boundaries[3].edges.push(edge);
    });
    says(&message, &["\"bottom\"", "\"left\"", "(1.5, 0) m", "exactly one"]);
}

#[test]
fn boundary_edges_inside() {
    let message = refused(|m| m.boundaries[0].edges.push([0, 12, 6]));
    says(&message, &["\"bottom\"", "inside", "cells 0 and 1", "from node 0 to node 12"]);
}

#[test]
fn boundary_edges_of_no_cell() {
    let message = refused(|m| m.boundaries[0].edges[0] = [0, 4, 2]);
    says(&message, &["\"bottom\"", "from node 0 to node 4", "no cell"]);
}

#[test]
fn boundary_edges_with_another_middle() {
    let message = refused(|m| m.boundaries[0].edges[0][2] = 6);
    says(&message, &["\"bottom\"", "middle node 6", "gives it 1"]);
}

/// The edges of a boundary may run either way.
#[test]
fn boundary_edges_may_run_backwards() {
    let mut m = mesh();
    m.boundaries[0].edges.iter_mut().for_each(|edge| edge.swap(0, 1));
    PlanarMesh::new(m).expect("valid");
}
