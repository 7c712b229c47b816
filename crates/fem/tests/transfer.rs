//! The transfer of paper eqs. (27)-(30), on a line and in the plane.

use lumley_fem::element::P2;
use lumley_fem::transfer::{Transfer, TransferError};
use lumley_fem::{LineMesh, MovingField, Point, UniformGrid, characteristic};
use std::error::Error;
use std::f64::consts::PI;

const METHODS: [Transfer; 2] =
    [Transfer::FiniteElement {}, Transfer::InverseDistance { power: 2.0, neighbours: 4 }];

/// A line of fluid from 0 to `end` that moves with `velocity(x)`, then a solid.
struct Tube {
    mesh: LineMesh,
    x: Vec<f64>,
    v: Vec<f64>,
    end: f64,
    solid: f64,
}

impl Tube {
    fn new(cells: usize, end: f64, velocity: impl Fn(f64) -> f64) -> Self {
        let mesh = LineMesh::new(cells, &P2);
        let x = mesh.uniform(0.0, end);
        let v = x.iter().map(|&x| velocity(x)).collect();
        Self { mesh, x, v, end, solid: velocity(end) }
    }
}

impl MovingField for Tube {
    fn components(&self) -> usize {
        1
    }
    fn nodes(&self) -> usize {
        self.mesh.nodes()
    }
    fn position(&self, node: usize) -> Point {
        [self.x[node], 0.0]
    }
    fn nodal_velocity(&self, node: usize, v: &mut [f64]) {
        v[0] = self.v[node];
    }
    fn is_fluid(&self, point: Point) -> bool {
        point[0] <= self.end
    }
    fn fluid_velocity(&self, point: Point, v: &mut [f64]) -> Option<()> {
        v[0] = self.mesh.evaluate(&self.x, &self.v, point[0])?;
        Some(())
    }
    fn solid_velocity(&self, _: Point, v: &mut [f64]) {
        v[0] = self.solid;
    }
}

/// Fluid in the unit square with two discs in it, each with a velocity of its own; the fluid's
/// velocity is linear, its nodes are a grid's.
struct Discs {
    nodes: UniformGrid,
    discs: [(Point, f64, Point); 2],
}

impl Discs {
    fn new() -> Self {
        let discs = [([0.3, 0.3], 0.1, [1.0, -2.0]), ([0.7, 0.6], 0.15, [0.5, 3.0])];
        Self { nodes: UniformGrid::rectangle([0.0, 0.0], [1.0, 1.0], [21, 21]), discs }
    }
    fn fluid([x, y]: Point) -> Point {
        [1.0 + x - y, 2.0 * y]
    }
    fn disc(&self, p: Point) -> Option<Point> {
        let inside = |c: Point, r: f64| (p[0] - c[0]).hypot(p[1] - c[1]) < r;
        self.discs.iter().find(|(c, r, _)| inside(*c, *r)).map(|disc| disc.2)
    }
}

impl MovingField for Discs {
    fn components(&self) -> usize {
        2
    }
    fn nodes(&self) -> usize {
        self.nodes.len()
    }
    fn position(&self, node: usize) -> Point {
        self.nodes.point(node)
    }
    fn nodal_velocity(&self, node: usize, v: &mut [f64]) {
        v.copy_from_slice(&Self::fluid(self.position(node)));
    }
    fn is_fluid(&self, point: Point) -> bool {
        self.disc(point).is_none()
    }
    fn fluid_velocity(&self, point: Point, v: &mut [f64]) -> Option<()> {
        v.copy_from_slice(&Self::fluid(point));
        Some(())
    }
    fn solid_velocity(&self, point: Point, v: &mut [f64]) {
        v.copy_from_slice(&self.disc(point).expect("asked only inside of a disc"));
    }
}

fn on_grid(method: Transfer, field: &dyn MovingField, grid: &UniformGrid) -> Vec<f64> {
    let mut out = vec![f64::NAN; field.components() * grid.len()];
    method.transfer(field, grid, &mut out).expect("a good field");
    out
}

fn worst_error(method: Transfer, cells: usize) -> f64 {
    let exact = |x: f64| (PI * x.min(0.83)).sin();
    let grid = UniformGrid::line(0.0, 1.0, 173);
    on_grid(method, &Tube::new(cells, 0.83, exact), &grid)
        .iter()
        .enumerate()
        .map(|(k, v)| (v - exact(grid.point(k)[0])).abs())
        .fold(0.0, f64::max)
}

#[test]
fn finite_elements_are_third_order_and_inverse_distance_first() {
    for (method, order) in METHODS.into_iter().zip([3.0, 1.0]) {
        let fitted = (worst_error(method, 20) / worst_error(method, 160)).log2() / 3.0;
        assert!((fitted - order).abs() < 0.25, "{method:?}: order {fitted}");
    }
}

#[test]
fn solid_moves_as_one_and_the_fluid_keeps_constants() {
    let tube = Tube { solid: -0.4, ..Tube::new(10, 0.55, |_| 0.7) };
    let grid = UniformGrid::line(0.0, 1.0, 101);
    for method in METHODS {
        for (k, v) in on_grid(method, &tube, &grid).into_iter().enumerate() {
            let expected = if grid.point(k)[0] <= 0.55 { 0.7 } else { -0.4 };
            assert!((v - expected).abs() < 1e-15, "{method:?}: {v} at node {k}");
        }
    }
}

/// At a mesh node the value is the node's, and next to it nothing overflows.
#[test]
fn coincident_nodes_give_their_value() {
    let tube = Tube::new(4, 1.0, |x| 3.0 * x);
    for power in [0.5, 2.0, 40.0] {
        let method = Transfer::InverseDistance { power, neighbours: 3 };
        let v = on_grid(method, &tube, &UniformGrid::line(0.0, 1.0, 9));
        assert_eq!(v, (0..9).map(|k| 3.0 * f64::from(k) / 8.0).collect::<Vec<_>>());
        let near = on_grid(method, &tube, &UniformGrid::line(1e-200, 1.0, 2));
        assert!(near[0].abs() < 1e-9, "{near:?}");
    }
}

#[test]
fn several_solids_and_components_in_the_plane() {
    let field = Discs::new();
    let grid = UniformGrid::rectangle([0.0, 0.0], [1.0, 1.0], [31, 31]);
    let mut chi = vec![f64::NAN; grid.len()];
    characteristic(&field, &grid, &mut chi);
    for (method, tolerance) in METHODS.into_iter().zip([1e-15, 0.05]) {
        let v = on_grid(method, &field, &grid);
        for k in 0..grid.len() {
            let p = grid.point(k);
            let expected = field.disc(p).unwrap_or(Discs::fluid(p));
            assert_eq!(chi[k] == 0.0, field.disc(p).is_some());
            for c in [0, 1] {
                let error = (v[c * grid.len() + k] - expected[c]).abs();
                let bound = if chi[k] == 0.0 { 0.0 } else { tolerance };
                assert!(error <= bound, "{method:?} at {p:?}: {error}");
            }
        }
    }
}

/// The integral of the characteristic function is the length of the fluid, to a grid spacing.
#[test]
fn characteristic_function_measures_the_fluid() {
    let grid = UniformGrid::line(0.0, 1.1, 441);
    for end in [0.1234, 0.9, 1.0999] {
        let mut chi = vec![f64::NAN; grid.len()];
        characteristic(&Tube::new(3, end, |x| x), &grid, &mut chi);
        let length: f64 = grid.trapezoid_weights().iter().zip(&chi).map(|(w, chi)| w * chi).sum();
        assert!((length - end).abs() <= grid.spacing()[0], "{length} {end}");
    }
}

#[test]
fn unusable_requests_are_errors() {
    let tube = Tube { end: 2.0, ..Tube::new(2, 1.0, |x| x) };
    let grid = UniformGrid::line(0.0, 2.0, 5);
    let attempt = |method: Transfer| method.transfer(&tube, &grid, &mut [0.0; 5]).expect_err("bad");
    let inverse = |power, neighbours| Transfer::InverseDistance { power, neighbours };
    assert_eq!(attempt(Transfer::FiniteElement {}), TransferError::NotCovered([1.5, 0.0]));
    assert_eq!(attempt(inverse(2.0, 6)), TransferError::TooFewNodes { wanted: 6, nodes: 5 });
    assert_eq!(attempt(inverse(2.0, 0)), TransferError::NoNeighbours);
    assert_eq!(attempt(inverse(0.0, 2)), TransferError::Power(0.0));
    assert!(matches!(attempt(inverse(f64::NAN, 2)), TransferError::Power(_)));
}

#[test]
fn case_files_name_the_method() -> Result<(), Box<dyn Error>> {
    let inverse = |power, neighbours| Transfer::InverseDistance { power, neighbours };
    for (text, expected) in [
        ("method = 'finite-element'", Transfer::FiniteElement {}),
        ("method = 'inverse-distance'", inverse(2.0, 4)),
        ("method = 'inverse-distance'\npower = 3.5\nneighbours = 2", inverse(3.5, 2)),
    ] {
        assert_eq!(toml::from_str::<Transfer>(text)?, expected, "{text}");
    }
    for text in ["method = 'finite-element'\npower = 2.0", "method = 'nearest'", "power = 2.0"] {
        assert!(toml::from_str::<Transfer>(text).is_err(), "{text} was accepted");
    }
    Ok(())
}
