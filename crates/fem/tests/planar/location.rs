//! Points are found in the cells that they are in, and nowhere else.

use crate::{bend, some};
use lumley_fem::element::{Cell, Element, Q2, TriangleP2};
use lumley_fem::geometry::{Mapped, Tabulated};
use lumley_fem::space::NodalSpace;
use lumley_fem::{Location, MeshDescription, NamedBoundary, PlanarMesh, Point, PointLocator};

/// Numbers from 0 to 1, the same each time.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn inside(&mut self, kind: Cell) -> Point {
        let [x, y] = [self.next(), self.next()];
        if kind == Cell::Triangle && x + y > 1.0 { [1.0 - x, 1.0 - y] } else { [x, y] }
    }
}

fn image(mesh: &PlanarMesh, at: &Location) -> Point {
    match at.cell.checked_sub(mesh.topology().triangles().len()) {
        None => {
            let here = Tabulated::at(&TriangleP2, at.reference, 0.0);
            Mapped::new(&mesh.triangle(at.cell), &here).point
        }
        Some(q) => {
            let here = Tabulated::at(&Q2, at.reference, 0.0);
            Mapped::new(&mesh.quadrilateral(q), &here).point
        }
    }
}

fn distance(a: Point, b: Point) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// A mesh of one cell whose nodes lie where they like, if it is valid.
fn lonely(kind: Cell, mut shake: impl FnMut() -> f64) -> Option<PlanarMesh> {
    let element: &dyn Element = if kind == Cell::Triangle { &TriangleP2 } else { &Q2 };
    let points: Vec<Point> = element.nodes().iter().map(|node| node.map(|x| x + shake())).collect();
    let corners = kind.vertices();
    let edges = (0..corners).map(|k| [k, (k + 1) % corners, corners + k]).collect();
    let mut description = MeshDescription {
        points,
        boundaries: vec![NamedBoundary { name: "rim".into(), edges }],
        ..MeshDescription::default()
    };
    match kind {
        Cell::Triangle => description.triangles.push([0, 1, 2, 3, 4, 5]),
        _ => description.quadrilaterals.push([0, 1, 2, 3, 4, 5, 6, 7, 8]),
    }
    PlanarMesh::new(description).ok()
}

/// However bent a cell is, as long as it is not folded: its points come back where they come from.
#[test]
fn random_points_of_random_cells_come_back() {
    let mut random = Random(1);
    for kind in [Cell::Triangle, Cell::Quadrilateral] {
        for size in [0.05, 0.15, 0.3] {
            let mut cells = 0;
            while cells < 150 {
                let Some(mesh) = lonely(kind, || size * (2.0 * random.next() - 1.0)) else {
                    continue;
                };
                cells += 1;
                let locator = PointLocator::new(&mesh);
                for _ in 0..60 {
                    let from = Location { cell: 0, reference: random.inside(kind) };
                    let point = image(&mesh, &from);
                    let found = locator.locate(&mesh, point);
                    let found = found.unwrap_or_else(|| panic!("{from:?} of {:?}", mesh.nodes()));
                    assert!(distance(found.reference, from.reference) < 1e-7, "{from:?} {found:?}");
                    assert!(distance(image(&mesh, &found), point) < 1e-12, "{from:?} {found:?}");
                }
            }
        }
    }
}

/// Whether an odd number of chords of a fine division of the rim is above the point.
fn is_within(rim: &[Point], [x, y]: Point) -> bool {
    let chords = rim.iter().zip(rim.iter().cycle().skip(1));
    let above = chords.filter(|(a, b)| {
        (a[0] <= x) != (b[0] <= x) && a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]) > y
    });
    above.count() % 2 == 1
}

/// Points beside the cells, too: inside and outside as their curved rims say.
#[test]
fn points_round_random_cells_are_in_or_out_as_the_rim_says() {
    let mut random = Random(2);
    for kind in [Cell::Triangle, Cell::Quadrilateral] {
        let mut cells = 0;
        while cells < 60 {
            let Some(mesh) = lonely(kind, || 0.5 * random.next() - 0.25) else { continue };
            cells += 1;
            let locator = PointLocator::new(&mesh);
            let on_rim =
                |edge: usize| (0..400).map(move |k| kind.on_edge(edge, f64::from(k) / 400.0));
            let rim: Vec<Point> = (0..kind.edges())
                .flat_map(on_rim)
                .map(|reference| image(&mesh, &Location { cell: 0, reference }))
                .collect();
            for _ in 0..100 {
                let point = [2.0 * random.next() - 0.5, 2.0 * random.next() - 0.5];
                // The chords leave the rim by less than this.
                if rim.iter().all(|&at| distance(at, point) > 4e-3) {
                    let found = locator.locate(&mesh, point).is_some();
                    assert_eq!(found, is_within(&rim, point), "{point:?} of {:?}", mesh.nodes());
                }
            }
        }
    }
}

fn mixed(map: impl Fn(Point) -> Point) -> PlanarMesh {
    PlanarMesh::new(MeshDescription::structured([9, 7], some, map)).expect("valid")
}

/// Every cell is tried for every point: at least one has it, and what the locator says is one of them.
#[test]
fn same_as_trying_every_cell() {
    let mesh = mixed(bend);
    let locator = PointLocator::new(&mesh);
    let triangles = mesh.topology().triangles().len();
    let alone = |cell: usize| {
        let nodes = mesh.topology().cell_nodes(cell);
        let mut at = nodes.iter().map(|&node| mesh.nodes()[node]);
        let kind = if cell < triangles { Cell::Triangle } else { Cell::Quadrilateral };
        let element: &dyn Element = if kind == Cell::Triangle { &TriangleP2 } else { &Q2 };
        let mut shifts = element.nodes().iter().flat_map(|node| {
            let at = at.next().expect("as many nodes");
            [at[0] - node[0], at[1] - node[1]]
        });
        lonely(kind, || shifts.next().expect("as many coordinates")).expect("valid")
    };
    let cells: Vec<PlanarMesh> = (0..mesh.topology().cells()).map(alone).collect();
    let locators: Vec<PointLocator> = cells.iter().map(PointLocator::new).collect();
    for k in 0..2500 {
        let point = [f64::from(k % 50) * 0.055 - 0.2, f64::from(k / 50) * 0.035 - 0.4];
        let having: Vec<usize> = (0..cells.len())
            .filter(|&cell| locators[cell].locate(&cells[cell], point).is_some())
            .collect();
        match locator.locate(&mesh, point) {
            None => assert!(having.is_empty(), "{point:?} is in {having:?}"),
            Some(found) => {
                assert!(having.contains(&found.cell), "{point:?}: {found:?}, {having:?}");
                assert!(distance(image(&mesh, &found), point) < 1e-12);
            }
        }
    }
}

/// Corners, middles and points of edges lie in one of their cells, wherever the mesh stands.
#[test]
fn no_gap_between_cells() {
    for far in [0.0, 1e3, -1e6] {
        let mesh = mixed(|p| bend(p).map(|x| x + far));
        let locator = PointLocator::new(&mesh);
        for edge in 0..mesh.topology().edges().len() {
            let ends = mesh.edge(edge);
            for s in [0.0, 1e-9, 0.1, 0.37, 0.5, 0.9, 1.0] {
                let phi = [(1.0 - s) * (1.0 - 2.0 * s), s * (2.0 * s - 1.0), 4.0 * s * (1.0 - s)];
                let point = [0, 1].map(|d| (0..3).map(|k| phi[k] * ends[k][d]).sum());
                let found = locator.locate(&mesh, point).expect("on an edge");
                let of = mesh.topology().edges()[edge];
                let near = distance(image(&mesh, &found), point);
                assert!(near < 1e-9 + 1e-14 * far.abs(), "{found:?}: {near}");
                let beside = found.cell == of.left.cell
                    || of.right.is_some_and(|right| right.cell == found.cell);
                assert!(beside || s < 1e-8 || s == 1.0, "{found:?} on {of:?}");
            }
        }
    }
}

/// A ring with a slit that turns: what is found moves with it.
#[test]
fn a_turning_mesh_is_followed() {
    let ring = |[x, y]: Point| {
        let (radius, angle) = (0.2 + 0.8 * x, 6.0 * y);
        [radius * angle.cos(), radius * angle.sin()]
    };
    let cut = |[i, j]: [usize; 2]| i < 2 && j % 3 == 0;
    let mut mesh = PlanarMesh::new(MeshDescription::structured([4, 24], cut, ring)).expect("valid");
    let still = mesh.nodes().to_vec();
    let mut locator = PointLocator::new(&mesh);
    let start = [0.55, 0.3];
    let before = locator.locate(&mesh, start).expect("inside");
    for step in 0..40 {
        let (sin, cos) = (0.37 * f64::from(step)).sin_cos();
        let turn = |[x, y]: Point| [cos * x - sin * y, sin * x + cos * y];
        for (node, &at) in mesh.nodes_mut().iter_mut().zip(&still) {
            *node = turn(at);
        }
        locator.update(&mesh);
        let found = locator.locate(&mesh, turn(start)).expect("inside");
        assert_eq!(found.cell, before.cell);
        assert!(distance(found.reference, before.reference) < 1e-12, "{found:?} {before:?}");
        assert_eq!(locator.locate(&mesh, turn([0.1, 0.0])), None, "the hole");
    }
}

/// A wall of another polygon: nodes of the finer mesh that are outside of the coarser one get the nearest point
/// of its wall; far away there is nothing.
#[test]
fn a_little_outside_is_on_the_wall() {
    let ring = |[x, y]: Point| [(1.0 + x) * y.cos(), (1.0 + x) * y.sin()];
    let on =
        |n: usize| PlanarMesh::new(MeshDescription::structured([n, n], some, ring)).expect("valid");
    let (coarse, fine) = (on(3), on(8));
    let locator = PointLocator::new(&coarse);
    let space = NodalSpace::velocity(coarse.topology());
    let radius: Vec<Point> =
        space.points(&coarse).into_iter().map(|p| [p[0].hypot(p[1]), 1.0]).collect();
    let mut outside = 0;
    for point in NodalSpace::velocity(fine.topology()).points(&fine) {
        outside += usize::from(locator.locate(&coarse, point).is_none());
        let at = locator.locate_near(&coarse, point, 2e-4).expect("near");
        assert!(distance(image(&coarse, &at), point) < 2e-4);
        let [r, one] = space.vector(&radius, &at);
        assert!((r - point[0].hypot(point[1])).abs() < 1e-3 && (one - 1.0).abs() < 1e-14);
    }
    assert!(outside > 10, "{outside}");
    assert_eq!(locator.locate_near(&coarse, [0.9, 0.0], 0.09), None);
    let at = locator.locate_near(&coarse, [0.9, -0.1], 0.2).expect("near the corner");
    assert!(distance(image(&coarse, &at), [1.0, 0.0]) < 1e-12);
}

/// The distance that `locate_near` goes is the least to any point of any edge.
#[test]
fn the_nearest_point_is_nearest() {
    let mesh = mixed(bend);
    let locator = PointLocator::new(&mesh);
    let rim: Vec<Point> = mesh
        .topology()
        .edges()
        .iter()
        .filter(|edge| edge.right.is_none())
        .flat_map(|edge| {
            let (cell, kind) = (edge.left.cell, mesh.topology().kind(edge.left.cell));
            let at = move |k: i32| kind.on_edge(edge.left.edge, f64::from(k) / 200.0);
            (0..=200).map(move |k| Location { cell, reference: at(k) })
        })
        .map(|at| image(&mesh, &at))
        .collect();
    for k in 0..60 {
        let (sin, cos) = (0.105 * f64::from(k)).sin_cos();
        let point = [1.0 + 2.0 * cos, 0.3 + 1.5 * sin];
        assert_eq!(locator.locate(&mesh, point), None);
        let at = locator.locate_near(&mesh, point, 10.0).expect("somewhere");
        let least = rim.iter().map(|&at| distance(at, point)).fold(f64::INFINITY, f64::min);
        let found = distance(image(&mesh, &at), point);
        assert!(found <= least + 1e-13 && found > least - 1e-4, "{found} {least}");
        assert!(locator.locate_near(&mesh, point, 0.999 * found).is_none());
        assert!(locator.locate_near(&mesh, point, 1.001 * found).is_some());
    }
}

#[test]
fn what_is_not_a_number_is_nowhere() {
    let mesh = mixed(bend);
    let locator = PointLocator::new(&mesh);
    for point in [[f64::NAN, 0.3], [0.5, f64::INFINITY], [f64::NEG_INFINITY, f64::NAN]] {
        assert_eq!(locator.locate(&mesh, point), None);
        assert_eq!(locator.locate_near(&mesh, point, 1.0), None);
    }
}
