//! How well the velocity and pressure spaces approximate, on curved meshes.

use crate::{bend, integrate, orders, some};
use lumley_fem::element::Element;
use lumley_fem::space::{DofMap, LinearPressure, NodalSpace};
use lumley_fem::{MeshDescription, PlanarMesh, Point};

type Cut = fn([usize; 2]) -> bool;
const CUTS: [(&str, Cut); 3] =
    [("P2 with bubble", |_| true), ("Q2", |_| false), ("both in one mesh", some)];

fn smooth([x, y]: Point) -> f64 {
    (1.3 * x + 0.4).sin() * (0.9 * y).exp()
}

fn slope([x, y]: Point) -> Point {
    [1.3 * (1.3 * x + 0.4).cos() * (0.9 * y).exp(), 0.9 * smooth([x, y])]
}

/// Errors of the interpolant in the L2 norm and of its gradient.
fn errors(mesh: &PlanarMesh) -> [f64; 2] {
    let space = NodalSpace::velocity(mesh.topology());
    let dofs = space.interpolate(mesh, smooth);
    let mut squares = [0.0; 2];
    integrate(mesh, 8, |cell, mapped, reference| {
        let element: &dyn Element = space.element(mesh.topology().kind(cell));
        let n = element.layout().nodes();
        let (mut phi, mut dphi) = (vec![0.0; n], vec![[0.0; 2]; n]);
        element.tabulate(reference, &mut phi, &mut dphi);
        let (mut value, mut gradient) = (0.0, [0.0; 2]);
        for (k, &dof) in space.dofs().cell(cell).iter().enumerate() {
            value += dofs[dof] * phi[k];
            let g = mapped.gradient(dphi[k]);
            gradient = [0, 1].map(|d| gradient[d] + dofs[dof] * g[d]);
        }
        let exact = slope(mapped.point);
        squares[0] += mapped.weight * (value - smooth(mapped.point)).powi(2);
        squares[1] += mapped.weight * (0..2).map(|d| (gradient[d] - exact[d]).powi(2)).sum::<f64>();
    });
    squares.map(f64::sqrt)
}

#[test]
fn velocity_is_of_order_three_and_its_gradient_of_order_two() {
    for (name, cut) in CUTS {
        let all: Vec<[f64; 2]> = [4, 8, 16, 32]
            .into_iter()
            .map(|n| {
                errors(
                    &PlanarMesh::new(MeshDescription::structured([n, n], cut, bend))
                        .expect("valid"),
                )
            })
            .collect();
        for (what, expected) in [(0, 3.0), (1, 2.0)] {
            let errors: Vec<f64> = all.iter().map(|e| e[what]).collect();
            let last = orders(&errors)[2];
            assert!((last - expected).abs() < 0.1, "{name}: {errors:?}, order {last}");
        }
    }
}

/// Quadratics in space are in the velocity space of straight cells, whatever their shape: linear ones of
/// curved cells too.
#[test]
fn velocity_space_holds_what_it_should() {
    let straight = |[x, y]: Point| [2.0 * x - 0.4 * y, 0.3 * x + y];
    let quadratic: fn(Point) -> f64 = |[x, y]| x * x - 3.0 * x * y + 0.5 * y * y + x - 1.0;
    let linear: fn(Point) -> f64 = |[x, y]| 0.7 * x - 2.0 * y + 0.1;
    let on = |map: &dyn Fn(Point) -> Point| {
        PlanarMesh::new(MeshDescription::structured([3, 4], some, map)).expect("valid")
    };
    for (mesh, f) in [(on(&straight), quadratic), (on(&bend), linear)] {
        let space = NodalSpace::velocity(mesh.topology());
        let dofs = space.interpolate(&mesh, f);
        integrate(&mesh, 4, |cell, mapped, reference| {
            let element = space.element(mesh.topology().kind(cell));
            let n = element.layout().nodes();
            let (mut phi, mut dphi) = (vec![0.0; n], vec![[0.0; 2]; n]);
            element.tabulate(reference, &mut phi, &mut dphi);
            let value: f64 =
                space.dofs().cell(cell).iter().zip(&phi).map(|(&d, p)| dofs[d] * p).sum();
            assert!((value - f(mapped.point)).abs() < 1e-13, "cell {cell}");
        });
    }
}

/// The best pressure on each cell is of order two, and its first coefficient the mean of the cell.
#[test]
fn pressure_is_of_order_two_in_physical_coordinates() {
    for (name, cut) in CUTS {
        let error = |n: usize| {
            let mesh =
                PlanarMesh::new(MeshDescription::structured([n, n], cut, bend)).expect("valid");
            projection_error(&mesh)
        };
        let errors: Vec<f64> = [4, 8, 16, 32].into_iter().map(error).collect();
        assert!((orders(&errors)[2] - 2.0).abs() < 0.1, "{name}: {errors:?}");
    }
}

/// L2 error of the projection, cell by cell, onto the linear pressures.
fn projection_error(mesh: &PlanarMesh) -> f64 {
    let mut points: Vec<Vec<(Point, f64)>> = vec![vec![]; mesh.topology().cells()];
    integrate(mesh, 8, |cell, m, _| points[cell].push((m.point, m.weight)));
    let of_cell = |points: &Vec<(Point, f64)>| {
        let basis = LinearPressure::centred(points.iter().copied());
        let (mut mass, mut load) = ([[0.0; 3]; 3], [0.0; 3]);
        for &(point, weight) in points {
            let psi = basis.values(point);
            for i in 0..3 {
                load[i] += weight * psi[i] * smooth(point);
                (0..3).for_each(|j| mass[i][j] += weight * psi[i] * psi[j]);
            }
        }
        assert!(mass[0][1].abs().max(mass[0][2].abs()) < 1e-13 * mass[0][0], "{mass:?}");
        let [[a, b], [c, d]] = [1, 2].map(|i| [mass[i][1], mass[i][2]]);
        let determinant = a * d - b * c;
        let p = [
            load[0] / mass[0][0],
            (d * load[1] - b * load[2]) / determinant,
            (a * load[2] - c * load[1]) / determinant,
        ];
        let defect = |&(point, weight): &(Point, f64)| {
            let value: f64 = basis.values(point).iter().zip(p).map(|(psi, p)| psi * p).sum();
            weight * (value - smooth(point)).powi(2)
        };
        points.iter().map(defect).sum::<f64>()
    };
    points.iter().map(of_cell).sum::<f64>().sqrt()
}

/// Values and gradients of the pressure functions fit together.
#[test]
fn pressure_gradients_are_differences_of_values() {
    let basis = LinearPressure::centred([([0.3, -1.0], 0.02), ([0.5, -1.2], 0.04)]);
    let (p, q) = ([0.1, 0.4], [0.7, -0.3]);
    for (k, gradient) in basis.gradients().into_iter().enumerate() {
        let difference = basis.values(q)[k] - basis.values(p)[k];
        let slope = gradient[0] * (q[0] - p[0]) + gradient[1] * (q[1] - p[1]);
        assert!((difference - slope).abs() < 1e-14, "{k}");
    }
    assert!((basis.centre()[0] - (0.006 + 0.02) / 0.06).abs() < 1e-15);
}

/// Interior dofs come last, one cell after another; shared ones are shared by the cells of an edge.
#[test]
fn dofs_are_shared_by_neighbours_only() {
    let mesh = PlanarMesh::new(MeshDescription::structured([5, 4], some, bend)).expect("valid");
    let topology = mesh.topology();
    let space = NodalSpace::velocity(topology);
    let dofs = space.dofs();
    let triangles = dofs.triangles::<7>().iter().map(|d| d[6]);
    let interior = triangles.chain(dofs.quadrilaterals::<9>().iter().map(|d| d[8]));
    assert!(interior.eq(dofs.shared()..dofs.len()));
    for edge in topology.edges() {
        let [a, b, m] = dofs.on_edge(edge.left).collect::<Vec<_>>()[..] else { panic!("three") };
        if let Some(right) = edge.right {
            assert_eq!(dofs.on_edge(right).collect::<Vec<_>>(), [b, a, m]);
        }
    }
    let mut used = vec![false; dofs.len()];
    (0..topology.cells()).flat_map(|cell| dofs.cell(cell)).for_each(|&dof| used[dof] = true);
    assert!(used.into_iter().all(|used| used));
    let pressure = DofMap::discontinuous(topology, 3);
    assert_eq!((pressure.shared(), pressure.len()), (0, 3 * topology.cells()));
}

/// Every dof is where its geometry node is, whichever cell one asks.
#[test]
fn dofs_of_a_boundary_lie_on_it() {
    let ring = |[x, y]: Point| [(1.0 + x) * y.cos(), (1.0 + x) * y.sin()];
    let mesh = PlanarMesh::new(MeshDescription::structured([4, 6], some, ring)).expect("valid");
    let space = NodalSpace::velocity(mesh.topology());
    let points = space.points(&mesh);
    let radius = |p: Point| p[0].hypot(p[1]);
    for (name, r) in [("left", 1.0), ("right", 2.0)] {
        let boundary = mesh.topology().boundary(name).expect("there");
        let on = space.dofs().on_boundary(mesh.topology(), boundary);
        assert_eq!(on.len(), 2 * boundary.edges.len() + 1, "{name}");
        assert!(on.windows(2).all(|w| w[0] < w[1]));
        assert!(on.iter().all(|&dof| (radius(points[dof]) - r).abs() < 1e-15), "{name}");
        let all = points.iter().filter(|&&p| (radius(p) - r).abs() < 1e-12).count();
        assert_eq!(all, on.len(), "{name}");
    }
}
