//! Integrals over cells against integrals over their edges.

use crate::{bend, integrate, some};
use lumley_fem::element::{Cell, P2};
use lumley_fem::geometry::{EdgePoint, Tabulated};
use lumley_fem::quadrature::rule;
use lumley_fem::{Edge, MeshDescription, PlanarMesh, Point};

/// `F = (x² y − y², x y² + x³)`: of degree three, so that 8 for the triangle and 9 for the square are exact.
fn field([x, y]: Point) -> Point {
    [x * x * y - y * y, x * y * y + x * x * x]
}

fn divergence([x, y]: Point) -> f64 {
    4.0 * x * y
}

const DEGREE: usize = 9;

/// `∫ F·n` along each edge, out of the cell at its left.
fn fluxes(mesh: &PlanarMesh) -> Vec<f64> {
    let table = Tabulated::on(&P2, &rule(Cell::Interval, DEGREE));
    let flux = |e: usize| {
        let nodes = mesh.edge(e);
        let at = |at: &Tabulated<3>| {
            let EdgePoint { point, normal, weight, .. } = EdgePoint::new(&nodes, at);
            weight * field(point).iter().zip(normal).map(|(f, n)| f * n).sum::<f64>()
        };
        table.iter().map(at).sum()
    };
    (0..mesh.topology().edges().len()).map(flux).collect()
}

/// On each cell by itself, and so on the whole: the fluxes through inner edges cancel.
#[test]
fn divergence_theorem_holds_on_every_cell() {
    for cut in [some, |_| true, |_| false] {
        let mesh = PlanarMesh::new(MeshDescription::structured([6, 5], cut, bend)).expect("valid");
        let mut inside = vec![0.0; mesh.topology().cells()];
        integrate(&mesh, DEGREE, |cell, m, _| inside[cell] += m.weight * divergence(m.point));
        let (mut through, fluxes) = (vec![0.0; mesh.topology().cells()], fluxes(&mesh));
        let mut rim = 0.0;
        for (&Edge { left, right, .. }, flux) in mesh.topology().edges().iter().zip(&fluxes) {
            through[left.cell] += flux;
            match right {
                Some(right) => through[right.cell] -= flux,
                None => rim += flux,
            }
        }
        for (cell, (a, b)) in inside.iter().zip(&through).enumerate() {
            assert!((a - b).abs() < 1e-14, "cell {cell}: {a} inside, {b} through its edges");
        }
        let total: f64 = inside.iter().sum();
        assert!((total - rim).abs() < 1e-13 && total.abs() > 0.1, "{total} {rim}");
    }
}

/// The map of a cell at its edge and the map of the edge are the same, and so are their tangents.
#[test]
fn edges_of_cells_and_edges_of_the_mesh_agree() {
    use lumley_fem::element::{Q2, TriangleP2};
    use lumley_fem::geometry::Mapped;
    let mesh = PlanarMesh::new(MeshDescription::structured([4, 3], some, bend)).expect("valid");
    let triangles = mesh.topology().triangles().len();
    for (number, edge) in mesh.topology().edges().iter().enumerate() {
        for s in [0.0, 0.21, 0.5, 1.0] {
            let on = EdgePoint::new(&mesh.edge(number), &Tabulated::at(&P2, [s, 0.0], 1.0));
            let [from_left, from_right] =
                [(Some(edge.left), s), (edge.right, 1.0 - s)].map(|(side, s)| {
                    side.map(|side| {
                        let point = mesh.topology().kind(side.cell).on_edge(side.edge, s);
                        match side.cell.checked_sub(triangles) {
                            None => Mapped::new(
                                &mesh.triangle(side.cell),
                                &Tabulated::at(&TriangleP2, point, 1.0),
                            ),
                            Some(q) => {
                                Mapped::new(&mesh.quadrilateral(q), &Tabulated::at(&Q2, point, 1.0))
                            }
                        }
                    })
                });
            for mapped in [from_left, from_right].into_iter().flatten() {
                let gap = (0..2).map(|d| (mapped.point[d] - on.point[d]).abs()).fold(0.0, f64::max);
                assert!(gap < 1e-14, "edge {number} at {s}: {gap:e}");
            }
        }
    }
}
