//! The transfer from a planar mesh to a grid, paper eqs. (27)-(30).

use crate::{bend, orders, some};
use lumley_fem::generate::Channel;
use lumley_fem::space::NodalSpace;
use lumley_fem::transfer::{
    Bodies, BodyError, Place, PlanarFlow, PlanarTransfer, Transfer, TransferError, grid_error,
};
use lumley_fem::{MeshDescription, MovingField, PlanarMesh, Point, PointLocator, UniformGrid};

const NO_BODY: &dyn Fn(usize, Point) -> Point = &|_, _| unreachable!("there is no body");
const INVERSE: Transfer = Transfer::InverseDistance { power: 2.0, neighbours: 4 };

fn mixed(cells: [usize; 2], map: impl Fn(Point) -> Point) -> PlanarMesh {
    PlanarMesh::new(MeshDescription::structured(cells, some, map)).expect("valid")
}

/// A mesh with the dofs of a field on it.
struct Fluid {
    mesh: PlanarMesh,
    space: NodalSpace,
    velocity: Vec<Point>,
}

impl Fluid {
    fn new(mesh: PlanarMesh, field: impl Fn(Point) -> Point) -> Self {
        let space = NodalSpace::velocity(mesh.topology());
        let velocity = space.points(&mesh).into_iter().map(field).collect();
        Self { mesh, space, velocity }
    }

    fn with<'a>(&'a self, solid: &'a dyn Fn(usize, Point) -> Point) -> PlanarFlow<'a> {
        PlanarFlow { mesh: &self.mesh, space: &self.space, velocity: &self.velocity, solid }
    }

    fn bodies(&self, names: &[&str]) -> Bodies {
        Bodies::new(&self.mesh, names).expect("closed")
    }
}

/// A transfer and what it gives.
fn on_grid(
    method: Transfer,
    grid: &UniformGrid,
    flow: PlanarFlow<'_>,
    bodies: Bodies,
) -> (PlanarTransfer, Vec<f64>) {
    let mut transfer = PlanarTransfer::new(method, grid.clone(), bodies).expect("good");
    transfer.update(flow.mesh);
    let mut out = vec![f64::NAN; 2 * grid.len()];
    transfer.transfer(flow, &mut out).expect("good");
    (transfer, out)
}

fn at(out: &[f64], node: usize) -> Point {
    [out[node], out[out.len() / 2 + node]]
}

fn difference(a: Point, b: Point) -> f64 {
    (a[0] - b[0]).abs().max((a[1] - b[1]).abs())
}

/// A channel of 4 m x 2 m with a disc, an ellipse and a plate as thin as a sheet.
fn bodies_in_channel() -> PlanarMesh {
    let channel: Channel = toml::from_str(
        "
        x = [0, 4]
        y = [0, 2]
        size = 0.2
        [[bodies]]
        name = 'disc'
        size = 0.06
        shape = { kind = 'disc', centre = [0.9, 1.1], radius = 0.3 }
        layers = { first = 0.01, growth = 1.3, count = 3 }
        [[bodies]]
        name = 'ellipse'
        size = 0.06
        shape = { kind = 'ellipse', centre = [2, 0.6], semi_axes = [0.4, 0.1], angle = 0.5 }
        [[bodies]]
        name = 'plate'
        size = 0.08
        shape = { kind = 'polygon', corners = [[2.3, 1.3], [3.5, 1.3], [3.5, 1.31], [2.3, 1.31]] }
        ",
    )
    .expect("a channel");
    PlanarMesh::new(channel.mesh().expect("possible")).expect("valid")
}

const NAMES: [&str; 3] = ["disc", "ellipse", "plate"];

/// How far a point is within a body, by formula: negative outside, in m.
fn depth(body: usize, [x, y]: Point) -> f64 {
    match body {
        0 => 0.3 - (x - 0.9).hypot(y - 1.1),
        1 => {
            let (sin, cos) = 0.5_f64.sin_cos();
            let [p, q] = [x - 2.0, y - 0.6];
            0.1 * (1.0 - ((cos * p + sin * q) / 0.4).hypot((cos * q - sin * p) / 0.1))
        }
        _ => (x - 2.3).min(3.5 - x).min(y - 1.3).min(1.31 - y),
    }
}

/// Physical quadratics are in the space of straight cells, linear fields in that of all.
#[test]
fn what_is_in_the_space_arrives_as_it_is() {
    let straight = |[x, y]: Point| [2.0 * x - 0.4 * y, 0.3 * x + y];
    let quadratic: fn(Point) -> Point = |[x, y]| [x * x - 3.0 * x * y, 0.5 * y * y + x - 1.0];
    let linear: fn(Point) -> Point = |[x, y]| [0.7 * x - 2.0 * y + 0.1, y - x];
    let grid = UniformGrid::rectangle([-0.5, -0.5], [2.5, 1.5], [61, 53]);
    for (mesh, field) in [(mixed([5, 4], straight), quadratic), (mixed([5, 4], bend), linear)] {
        let fluid = Fluid::new(mesh, field);
        let (transfer, out) =
            on_grid(Transfer::default(), &grid, fluid.with(NO_BODY), Bodies::none());
        let mut inside = 0;
        for (k, place) in transfer.places().iter().enumerate() {
            let is_fluid = matches!(place, Place::Fluid(_));
            let expected = if is_fluid { field(grid.point(k)) } else { [0.0; 2] };
            assert!(difference(at(&out, k), expected) < 1e-11, "{place:?}");
            inside += usize::from(is_fluid);
        }
        assert!(inside > 1000, "{inside}");
    }
}

/// The raster finds what the locator finds, point by point; bodies have what their formulas say.
#[test]
fn every_node_is_where_it_is() {
    let mesh = bodies_in_channel();
    let (locator, bodies) = (PointLocator::new(&mesh), Bodies::new(&mesh, &NAMES).expect("closed"));
    // The second grid goes beyond the channel, and has nodes on its corners and walls.
    for grid in [
        UniformGrid::rectangle([0.0, 0.0], [4.0, 2.0], [401, 201]),
        UniformGrid::rectangle([-0.2, -0.1], [4.2, 2.1], [221, 111]),
    ] {
        let mut transfer =
            PlanarTransfer::new(Transfer::default(), grid.clone(), bodies.clone()).expect("good");
        let coverage = transfer.update(&mesh);
        let mut chi = vec![f64::NAN; grid.len()];
        transfer.characteristic(&mut chi);
        let mut counts = [0; 3];
        for (k, place) in transfer.places().iter().enumerate() {
            let point = grid.point(k);
            let located = locator.locate(&mesh, point);
            assert_eq!(located.is_some(), matches!(place, Place::Fluid(_)), "{point:?}");
            assert_eq!(chi[k] == 1.0, located.is_some());
            let inside = (0..3).find(|&body| depth(body, point) > 0.0);
            match place {
                Place::Fluid(_) => {
                    assert!((0..3).all(|body| depth(body, point) < 1e-5), "{point:?}");
                    counts[0] += 1;
                }
                Place::Solid(body) => {
                    assert_eq!(bodies.containing(&mesh, point), Some(*body));
                    assert!(inside.is_none_or(|inside| inside == *body), "{point:?}");
                    assert!(depth(*body, point) > -1e-5, "{point:?}");
                    counts[1] += 1;
                }
                Place::Outside => {
                    assert!(bodies.containing(&mesh, point).is_none() && inside.is_none());
                    let to_wall = |d: usize| point[d].min([4.0, 2.0][d] - point[d]);
                    assert!(to_wall(0).min(to_wall(1)) < 1e-9, "{point:?}");
                    counts[2] += 1;
                }
            }
        }
        assert_eq!(counts, [coverage.fluid, coverage.solid, coverage.outside]);
        assert_eq!(counts[2] == 0, grid.bounds().0 == [0.0; 2]);
    }
}

/// Bodies that turn and move with the mesh round them: no fluid value in a body, none of a body in the fluid.
#[test]
fn turning_bodies_keep_their_velocity_to_themselves() {
    let mut fluid = Fluid::new(bodies_in_channel(), |_| [1.0, 2.0]);
    let still = fluid.mesh.nodes().to_vec();
    let grid = UniformGrid::rectangle([-3.0, -3.0], [5.0, 5.0], [320, 340]);
    let solid = |body: usize, [x, y]: Point| [10.0 * (body + 1) as f64 - y, x];
    let bodies = fluid.bodies(&NAMES);
    for method in [Transfer::default(), INVERSE] {
        let mut transfer = PlanarTransfer::new(method, grid.clone(), bodies.clone()).expect("good");
        let mut out = vec![f64::NAN; 2 * grid.len()];
        for step in 0..6 {
            let (sin, cos) = (0.9 * f64::from(step)).sin_cos();
            for (node, [x, y]) in fluid.mesh.nodes_mut().iter_mut().zip(&still) {
                *node = [cos * (x - 2.0) - sin * y + 1.0, sin * (x - 2.0) + cos * y];
            }
            let coverage = transfer.update(&fluid.mesh);
            transfer.transfer(fluid.with(&solid), &mut out).expect("good");
            let area = 8.0 * 8.0 / (319.0 * 339.0);
            let expected = std::f64::consts::PI * (0.09 + 0.04) + 0.012;
            assert!((coverage.solid as f64 * area / expected - 1.0).abs() < 0.03, "{coverage:?}");
            for k in 0..grid.len() {
                let [x, y] = grid.point(k);
                let back = [cos * (x - 1.0) + sin * y + 2.0, cos * y - sin * (x - 1.0)];
                let inside = (0..3).find(|&body| depth(body, back) > 0.0);
                if (0..3).any(|body| depth(body, back).abs() < 1e-5) {
                    continue;
                }
                let in_channel = (0.0..4.0).contains(&back[0]) && (0.0..2.0).contains(&back[1]);
                let expected = match inside {
                    Some(body) => solid(body, [x, y]),
                    None if in_channel => [1.0, 2.0],
                    None => [0.0; 2],
                };
                assert!(difference(at(&out, k), expected) < 1e-12, "{back:?} {:?}", at(&out, k));
            }
        }
    }
}

fn smooth([x, y]: Point) -> Point {
    [(1.3 * x + 0.4).sin() * (0.9 * y).exp(), (2.0 * x * y).cos()]
}

#[test]
fn finite_elements_are_of_order_three_and_inverse_distance_of_order_one() {
    let grid = UniformGrid::rectangle([0.2, 0.2], [1.6, 0.7], [83, 47]);
    for (method, expected) in [(Transfer::default(), 3.0), (INVERSE, 1.0)] {
        let error = |n: usize| {
            let fluid = Fluid::new(mixed([n, n], bend), smooth);
            let (transfer, out) = on_grid(method, &grid, fluid.with(NO_BODY), Bodies::none());
            let squares = transfer.places().iter().enumerate().map(|(k, place)| {
                assert!(matches!(place, Place::Fluid(_)), "{:?}", grid.point(k));
                difference(at(&out, k), smooth(grid.point(k))).powi(2)
            });
            (squares.sum::<f64>() / grid.len() as f64).sqrt()
        };
        let errors: Vec<f64> = [8, 16, 32, 64].into_iter().map(error).collect();
        let mean = orders(&errors).iter().sum::<f64>() / 3.0;
        assert!((mean - expected).abs() < 0.15, "{method:?}: {errors:?}, order {mean}");
    }
}

/// Where no body is near, the neighbours are the nearest of all nodes.
#[test]
fn inverse_distance_takes_the_nearest_nodes() {
    let grid = UniformGrid::rectangle([0.2, 0.2], [1.6, 0.7], [23, 17]);
    let fluid = Fluid::new(mixed([7, 20], bend), smooth);
    let points = fluid.space.points(&fluid.mesh);
    for (power, neighbours) in [(2.0, 1), (2.0, 4), (1.0, 8), (3.5, 40)] {
        let method = Transfer::InverseDistance { power, neighbours };
        let (_, out) = on_grid(method, &grid, fluid.with(NO_BODY), Bodies::none());
        for k in 0..grid.len() {
            let p = grid.point(k);
            let distance = |dof: usize| (points[dof][0] - p[0]).hypot(points[dof][1] - p[1]);
            let mut all: Vec<usize> = (0..points.len()).collect();
            all.sort_by(|&a, &b| distance(a).total_cmp(&distance(b)));
            let (mut v, mut sum) = ([0.0; 2], 0.0);
            for &dof in &all[..neighbours] {
                let weight = distance(dof).powf(-power);
                v = [0, 1].map(|d| v[d] + weight * fluid.velocity[dof][d]);
                sum += weight;
            }
            assert!(difference(at(&out, k), v.map(|v| v / sum)) < 1e-12, "{p:?}");
        }
    }
}

/// The fluid above a plate of 10 mm moves to the right, below to the left; nodes are 80 mm apart.
#[test]
fn nothing_passes_through_a_thin_plate() {
    let side = |[_, y]: Point| [(y - 1.305).signum(), 0.0];
    let fluid = Fluid::new(bodies_in_channel(), side);
    let grid = UniformGrid::rectangle([2.6, 1.2], [3.2, 1.4], [121, 81]);
    let solid = |_: usize, _: Point| [0.0; 2];
    let method = Transfer::InverseDistance { power: 2.0, neighbours: 8 };
    let (transfer, out) = on_grid(method, &grid, fluid.with(&solid), fluid.bodies(&NAMES));
    for (k, place) in transfer.places().iter().enumerate() {
        let expected = match place {
            Place::Solid(2) => [0.0; 2],
            Place::Fluid(_) => side(grid.point(k)),
            _ => panic!("{place:?}"),
        };
        assert!(difference(at(&out, k), expected) < 1e-14, "{:?}", grid.point(k));
    }
}

/// `v = x²`: bilinear interpolation errs by `x (h − x)` in a cell, in L2 `h²/sqrt(30)`; `||x²|| = 1/sqrt(5)`.
#[test]
fn error_of_a_parabola_is_known() {
    for cells in [4, 8] {
        let fluid = Fluid::new(mixed([cells, cells], |p| p), |[x, _]| [x * x, 0.0]);
        let grid = UniformGrid::rectangle([0.0; 2], [1.0; 2], [cells + 1, cells + 1]);
        let (transfer, out) =
            on_grid(Transfer::default(), &grid, fluid.with(NO_BODY), Bodies::none());
        let error = transfer.error(fluid.with(NO_BODY), &out);
        let expected = (cells as f64).powi(-2) / 30_f64.sqrt();
        assert!((error.distance / expected - 1.0).abs() < 1e-9, "{error:?} {expected}");
        assert!((error.norm - 5_f64.sqrt().recip()).abs() < 1e-12);
    }
}

/// The same field, point by point.
struct PointByPoint<'a> {
    flow: PlanarFlow<'a>,
    locator: PointLocator,
    bodies: Bodies,
}

impl MovingField for PointByPoint<'_> {
    fn components(&self) -> usize {
        2
    }
    fn nodes(&self) -> usize {
        self.flow.velocity.len()
    }
    fn position(&self, node: usize) -> Point {
        self.flow.space.points(self.flow.mesh)[node]
    }
    fn nodal_velocity(&self, node: usize, v: &mut [f64]) {
        v.copy_from_slice(&self.flow.velocity[node]);
    }
    fn is_fluid(&self, point: Point) -> bool {
        self.locator.locate(self.flow.mesh, point).is_some()
    }
    fn fluid_velocity(&self, point: Point, v: &mut [f64]) -> Option<()> {
        let at = self.locator.locate(self.flow.mesh, point)?;
        v.copy_from_slice(&self.flow.space.vector(self.flow.velocity, &at));
        Some(())
    }
    fn solid_velocity(&self, point: Point, v: &mut [f64]) {
        let body = self.bodies.containing(self.flow.mesh, point);
        v.copy_from_slice(&body.map_or([0.0; 2], |body| (self.flow.solid)(body, point)));
    }
}

/// The transfer of all nodes at once, its error too, are those of the general way; away from the bodies' rims
/// the error is small.
#[test]
fn same_as_point_by_point() {
    let fluid = Fluid::new(bodies_in_channel(), smooth);
    let solid = |body: usize, [x, y]: Point| [body as f64 - y, x];
    let field = PointByPoint {
        flow: fluid.with(&solid),
        locator: PointLocator::new(&fluid.mesh),
        bodies: fluid.bodies(&NAMES),
    };
    let grid = UniformGrid::rectangle([0.0, 0.0], [4.0, 2.0], [81, 41]);
    let (transfer, out) =
        on_grid(Transfer::default(), &grid, fluid.with(&solid), fluid.bodies(&NAMES));
    let mut single = vec![f64::NAN; out.len()];
    Transfer::default().transfer(&field, &grid, &mut single).expect("good");
    for (a, b) in out.iter().zip(&single) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
    let (all, one) =
        (transfer.error(fluid.with(&solid), &out), grid_error(&field, &grid, &out).expect("good"));
    assert!((all.norm / one.norm - 1.0).abs() < 2e-3, "{all:?} {one:?}");
    assert!((all.distance / one.distance - 1.0).abs() < 0.05, "{all:?} {one:?}");
}

#[test]
fn unusable_requests_are_errors() {
    let mesh = bodies_in_channel();
    let error = |names: &[&str]| Bodies::new(&mesh, names).expect_err("bad");
    let BodyError::Unknown { name, known } = error(&["disk"]) else { panic!("unknown") };
    assert_eq!((name.as_str(), known.len()), ("disk", 7));
    assert!(matches!(error(&["disc", "left"]), BodyError::Open { name, .. } if name == "left"));
    assert_eq!(error(&["disc", "plate", "disc"]), BodyError::Twice("disc".into()));

    let mut description = MeshDescription::structured([2, 2], some, |p| p);
    let edges = description.boundaries.drain(..).flat_map(|b| b.edges).collect();
    description.boundaries.push(lumley_fem::NamedBoundary { name: "wall".into(), edges });
    let mesh = PlanarMesh::new(description).expect("valid");
    let error = Bodies::new(&mesh, &["wall"]).expect_err("bad");
    assert_eq!(error, BodyError::RoundTheFluid("wall".into()));

    let grid = UniformGrid::rectangle([0.0; 2], [1.0; 2], [3, 3]);
    let new = |power, neighbours| {
        let method = Transfer::InverseDistance { power, neighbours };
        PlanarTransfer::new(method, grid.clone(), Bodies::none())
    };
    assert!(matches!(new(-1.0, 4), Err(TransferError::Power(power)) if power == -1.0));
    assert!(matches!(new(2.0, 0), Err(TransferError::NoNeighbours)));
    let fluid = Fluid::new(mesh, |p| p);
    let nodes = fluid.velocity.len();
    let mut greedy = new(2.0, nodes + 1).expect("possible on a finer mesh");
    greedy.update(&fluid.mesh);
    let error = greedy.transfer(fluid.with(NO_BODY), &mut [0.0; 18]).expect_err("too many");
    assert_eq!(error, TransferError::TooFewNodes { wanted: nodes + 1, nodes });
}

/// A mesh that has lost a node is nobody's panic.
#[test]
fn lost_nodes_do_no_harm() {
    let mut fluid = Fluid::new(bodies_in_channel(), smooth);
    let bodies = fluid.bodies(&NAMES);
    let solid = |_: usize, _: Point| [0.0; 2];
    for lost in [f64::NAN, f64::INFINITY, 1e300] {
        for k in (0..fluid.mesh.nodes().len()).step_by(7) {
            fluid.mesh.nodes_mut()[k] = [lost, -lost];
        }
        let grid = UniformGrid::rectangle([0.0, 0.0], [4.0, 2.0], [21, 11]);
        for method in [Transfer::default(), INVERSE] {
            let (transfer, _) = on_grid(method, &grid, fluid.with(&solid), bodies.clone());
            assert_eq!(transfer.places().len(), grid.len());
        }
    }
}
