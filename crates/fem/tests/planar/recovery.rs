//! Continuous pressure and vorticity from what jumps between cells.

use crate::{bend, integrate, orders, some};
use lumley_fem::element::Element;
use lumley_fem::space::{LinearPressure, NodalSpace, Recovery};
use lumley_fem::{MeshDescription, PlanarMesh, Point};

type Cut = fn([usize; 2]) -> bool;
const CUTS: [(&str, Cut); 3] =
    [("P2 with bubble", |_| true), ("Q2", |_| false), ("both in one mesh", some)];

fn mesh(cells: usize, cut: Cut) -> (PlanarMesh, NodalSpace) {
    let mesh = PlanarMesh::new(MeshDescription::structured([cells, cells], cut, bend));
    let mesh = mesh.expect("valid");
    let space = NodalSpace::velocity(mesh.topology());
    (mesh, space)
}

/// The linear function of each cell that has the value and the slope of `f` at its centroid.
fn tangents(mesh: &PlanarMesh, f: impl Fn(Point) -> (f64, Point)) -> Vec<[f64; 3]> {
    let mut points: Vec<Vec<(Point, f64)>> = vec![vec![]; mesh.topology().cells()];
    integrate(mesh, 5, |cell, m, _| points[cell].push((m.point, m.weight)));
    let of_cell = |points: &Vec<(Point, f64)>| {
        let functions = LinearPressure::centred(points.iter().copied());
        let (value, slope) = f(functions.centre());
        let scale = 1.0 / functions.gradients()[1][0];
        [value, slope[0] * scale, slope[1] * scale]
    };
    points.iter().map(of_cell).collect()
}

fn recovered_pressure(
    (mesh, space): &(PlanarMesh, NodalSpace),
    f: impl Fn(Point) -> (f64, Point),
) -> Vec<f64> {
    let mut nodal = vec![f64::NAN; space.dofs().len()];
    Recovery::new(space).pressure(mesh, space, &tangents(mesh, f), &mut nodal);
    nodal
}

fn recovered_vorticity(
    (mesh, space): &(PlanarMesh, NodalSpace),
    velocity: impl Fn(Point) -> Point,
) -> Vec<f64> {
    let velocity: Vec<Point> = space.points(mesh).into_iter().map(velocity).collect();
    let mut nodal = vec![f64::NAN; space.dofs().len()];
    Recovery::new(space).vorticity(mesh, space, &velocity, &mut nodal);
    nodal
}

/// L2 norm of a nodal field less `exact`.
fn error((mesh, space): &(PlanarMesh, NodalSpace), nodal: &[f64], exact: fn(Point) -> f64) -> f64 {
    let mut square = 0.0;
    integrate(mesh, 6, |cell, mapped, reference| {
        let element: &dyn Element = space.element(mesh.topology().kind(cell));
        let n = element.layout().nodes();
        let (mut phi, mut dphi) = (vec![0.0; n], vec![[0.0; 2]; n]);
        element.tabulate(reference, &mut phi, &mut dphi);
        let value: f64 = space.dofs().cell(cell).iter().zip(&phi).map(|(&d, p)| nodal[d] * p).sum();
        square += mapped.weight * (value - exact(mapped.point)).powi(2);
    });
    square.sqrt()
}

#[test]
fn a_linear_pressure_is_reproduced() {
    let linear = |[x, y]: Point| (0.7 * x - 2.0 * y + 3.0, [0.7, -2.0]);
    for (name, cut) in CUTS {
        let ground = mesh(4, cut);
        let nodal = recovered_pressure(&ground, linear);
        for (point, value) in ground.1.points(&ground.0).into_iter().zip(nodal) {
            assert!((value - linear(point).0).abs() < 1e-13, "{name} at {point:?}: {value}");
        }
    }
}

#[test]
fn a_rigid_rotation_has_twice_its_rate() {
    for (name, cut) in CUTS {
        let nodal =
            recovered_vorticity(&mesh(4, cut), |[x, y]| [2.0 - 0.8 * y, 0.8 * (x - 1.0) + 0.3]);
        let worst = nodal.iter().map(|omega| (omega - 1.6).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-12, "{name}: {worst:e}");
    }
}

/// Where a uniform strain would be taken for rotation, a sign is wrong.
#[test]
fn a_uniform_strain_has_no_vorticity() {
    let nodal =
        recovered_vorticity(&mesh(4, some), |[x, y]| [0.5 * x + 2.0 * y, 2.0 * x - 0.5 * y]);
    assert!(nodal.iter().all(|omega| omega.abs() < 1e-12));
}

#[test]
fn both_are_of_order_two() {
    let smooth = |[x, y]: Point| (1.3 * x + 0.4).sin() * (0.9 * y).exp();
    let slope = move |[x, y]: Point| {
        (smooth([x, y]), [1.3 * (1.3 * x + 0.4).cos() * (0.9 * y).exp(), 0.9 * smooth([x, y])])
    };
    for (name, cut) in CUTS {
        let errors = |n: usize| {
            let ground = mesh(n, cut);
            let pressure = recovered_pressure(&ground, slope);
            let vorticity = recovered_vorticity(&ground, |[x, y]| [y.cos(), (1.3 * x).sin() * y]);
            let omega = |[x, y]: Point| 1.3 * (1.3 * x).cos() * y + y.sin();
            [error(&ground, &pressure, smooth), error(&ground, &vorticity, omega)]
        };
        let all: Vec<[f64; 2]> = [4, 8, 16, 32].into_iter().map(errors).collect();
        for (k, what) in ["pressure", "vorticity"].into_iter().enumerate() {
            let errors: Vec<f64> = all.iter().map(|e| e[k]).collect();
            let last = orders(&errors)[2];
            assert!(last > 1.9, "{what}, {name}: {errors:?}, order {last}");
        }
    }
}
