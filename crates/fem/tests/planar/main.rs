//! Planar meshes of curved triangles and quadrilaterals: geometry, integrals, interpolation, bad input.

mod bad_input;
mod disc;
mod divergence;
mod interpolation;
mod location;
mod motion;
mod recovery;
mod topology;
mod transfer;

use lumley_fem::element::{Cell, Element, Q2, TriangleP2};
use lumley_fem::geometry::{Mapped, Tabulated};
use lumley_fem::quadrature::rule;
use lumley_fem::{PlanarMesh, Point};

/// Calls `visit` with every quadrature point of every cell, and its cell.
fn integrate(mesh: &PlanarMesh, degree: usize, mut visit: impl FnMut(usize, &Mapped, Point)) {
    fn tables<const N: usize>(element: &dyn Element, degree: usize) -> Vec<Tabulated<N>> {
        Tabulated::on(element, &rule(element.layout().cell, degree))
    }
    let triangles = mesh.topology().triangles().len();
    let (of_triangle, of_square) = (tables(&TriangleP2, degree), tables(&Q2, degree));
    for cell in 0..mesh.topology().cells() {
        if mesh.topology().kind(cell) == Cell::Triangle {
            let nodes = mesh.triangle(cell);
            for at in &of_triangle {
                visit(cell, &Mapped::new(&nodes, at), at.reference);
            }
        } else {
            let nodes = mesh.quadrilateral(cell - triangles);
            for at in &of_square {
                visit(cell, &Mapped::new(&nodes, at), at.reference);
            }
        }
    }
}

/// The slope of `log(error)` between each refinement by two and the next.
fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|e| (e[0] / e[1]).log2()).collect()
}

/// A smooth map of the unit square that bends all lines, in m.
fn bend([x, y]: Point) -> Point {
    [2.0 * x + 0.15 * (3.0 * y).sin() * (1.0 + x), y - 0.2 * x * x + 0.1 * (2.0 * x + y).cos()]
}

/// Some cells cut and some not, in a pattern that has all pairs of neighbours.
fn some([i, j]: [usize; 2]) -> bool {
    (i + 2 * j) % 5 < 2
}
