//! Looking for tangled cells, mapping and finding points, recovering fields and the transfer to a grid allocate
//! nothing: they happen in every step or in many.

mod counting;

use counting::allocations;
use lumley_fem::element::{Cell, Q2};
use lumley_fem::geometry::{Mapped, Tabulated};
use lumley_fem::quadrature::rule;
use lumley_fem::space::{LinearPressure, NodalSpace, Recovery};
use lumley_fem::transfer::{Bodies, PlanarFlow, PlanarTransfer, Transfer};
use lumley_fem::{MeshDescription, PlanarMesh, Point, PointLocator, UniformGrid};

/// An edge is so bent that its cell has to be quartered before it is proven.
#[test]
fn checks_and_maps_allocate_nothing() {
    let cut = |[i, j]: [usize; 2]| i + j == 2;
    let mut description = MeshDescription::structured([2, 2], cut, |p| p.map(|x| 2.0 * x));
    let middle = description.quadrilaterals[0][4];
    description.points[middle] = [0.37, 0.3];
    let mesh = PlanarMesh::new(description).expect("valid");
    let table = Tabulated::on(&Q2, &rule(Cell::Quadrilateral, 5));
    let mut sum = 0.0;
    let before = allocations();
    mesh.check().expect("valid");
    for q in 0..mesh.topology().quadrilaterals().len() {
        let nodes = mesh.quadrilateral(q);
        let mapped = || table.iter().map(|at| Mapped::new(&nodes, at));
        let pressure = LinearPressure::centred(mapped().map(|m| (m.point, m.weight)));
        for (at, mapped) in table.iter().zip(mapped()) {
            let gradients = mapped.gradients(&at.dphi);
            sum += mapped.weight * gradients[0][0] * pressure.values(mapped.point)[1];
        }
    }
    let count = allocations() - before;
    assert!(sum.is_finite());
    assert_eq!(count, 0);
}

/// Pressure and vorticity for a file or a picture.
#[test]
fn recovery_allocates_nothing() {
    let description = MeshDescription::structured([3, 2], |[i, j]| i + j == 2, |p| p);
    let mesh = PlanarMesh::new(description).expect("valid");
    let space = NodalSpace::velocity(mesh.topology());
    let mut recovery = Recovery::new(&space);
    let (velocity, pressure) = (space.points(&mesh), vec![[1.0; 3]; mesh.topology().cells()]);
    let mut nodal = vec![0.0; space.dofs().len()];
    let before = allocations();
    recovery.pressure(&mesh, &space, &pressure, &mut nodal);
    recovery.vorticity(&mesh, &space, &velocity, &mut nodal);
    assert_eq!(allocations() - before, 0);
}

/// The mesh turns under the grid, and more of it comes to lie there.
#[test]
fn following_a_mesh_to_a_grid_allocates_once() {
    let description = MeshDescription::structured([8, 8], |[i, _]| i < 4, |p| p);
    let mut mesh = PlanarMesh::new(description).expect("valid");
    let still = mesh.nodes().to_vec();
    let space = NodalSpace::velocity(mesh.topology());
    let mut locator = PointLocator::new(&mesh);
    let velocity = space.points(&mesh);
    let none = |_: usize, _: Point| [0.0; 2];
    for method in
        [Transfer::FiniteElement {}, Transfer::InverseDistance { power: 2.0, neighbours: 9 }]
    {
        let grid = UniformGrid::rectangle([-0.5; 2], [1.0; 2], [40, 50]);
        let mut transfer = PlanarTransfer::new(method, grid, Bodies::none()).expect("good");
        let mut out = vec![0.0; 4000];
        let mut counts = vec![];
        for step in 0..4 {
            let (sin, cos) = (0.3 * f64::from(step)).sin_cos();
            for (node, [x, y]) in mesh.nodes_mut().iter_mut().zip(&still) {
                *node = [cos * x - sin * y, sin * x + cos * y];
            }
            let before = allocations();
            locator.update(&mesh);
            let found = locator.locate_near(&mesh, [0.3, -0.1], 1.0);
            transfer.update(&mesh);
            let flow = PlanarFlow { mesh: &mesh, space: &space, velocity: &velocity, solid: &none };
            transfer.transfer(flow, &mut out).expect("good");
            counts.push(allocations() - before);
            assert!(found.is_some() && out.iter().any(|v| *v != 0.0));
        }
        assert_eq!(counts[1..], [0; 3], "{method:?}");
    }
}
