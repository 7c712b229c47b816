use super::super::GridError;
use super::super::grid_error::{Squares, squares};
use super::{Bodies, PlanarFlow};
use crate::element::{Cell, Element, Q2, TriangleP2};
use crate::geometry::{Mapped, Tabulated};
use crate::quadrature::rule;
use crate::{Location, Point, UniformGrid};

/// Exact for the square of the field on a straight cell.
const DEGREE: usize = 8;

/// Lines of points in a cell of the grid, in each direction, where bodies are.
const PARTS: usize = 8;

/// Adds up `|v_h − v|²` and `|v|²`.
struct Sum<'a> {
    grid: &'a UniformGrid,
    values: &'a [f64],
    squares: Squares,
}

impl Sum<'_> {
    /// A point of this weight in m², if it is within the grid.
    fn add(&mut self, point: Point, weight: f64, exact: Point) {
        let ((lower, upper), spacing) = (self.grid.bounds(), self.grid.spacing());
        if (0..2).any(|d| point[d] < lower[d] || point[d] > upper[d]) {
            return;
        }
        let at = [0, 1].map(|d| (point[d] - lower[d]) / spacing[d]);
        self.squares.add(weight, squares(self.grid, self.values, at, &exact));
    }
}

pub(super) fn error(
    grid: &UniformGrid,
    bodies: &Bodies,
    flow: PlanarFlow<'_>,
    values: &[f64],
) -> GridError {
    assert_eq!(values.len(), 2 * grid.len(), "one value for each component and node");
    let mut sum = Sum { grid, values, squares: Squares::default() };
    add_fluid(&mut sum, flow);
    if !bodies.is_empty() {
        add_solid(&mut sum, bodies, flow);
    }
    sum.squares.error(1.0)
}

fn add_fluid(sum: &mut Sum<'_>, flow: PlanarFlow<'_>) {
    let triangles = flow.mesh.topology().triangles().len();
    let at = tables(&TriangleP2);
    for cell in 0..triangles {
        add_cell(sum, flow, cell, &flow.mesh.triangle(cell), &at);
    }
    let at = tables(&Q2);
    for q in 0..flow.mesh.topology().quadrilaterals().len() {
        add_cell(sum, flow, triangles + q, &flow.mesh.quadrilateral(q), &at);
    }
}

fn tables<const N: usize>(element: &dyn Element) -> Vec<Tabulated<N>> {
    let kind: Cell = element.layout().cell;
    Tabulated::on(element, &rule(kind, DEGREE))
}

fn add_cell<const N: usize>(
    sum: &mut Sum<'_>,
    flow: PlanarFlow<'_>,
    cell: usize,
    nodes: &[Point; N],
    rule: &[Tabulated<N>],
) {
    for at in rule {
        let mapped = Mapped::new(nodes, at);
        let place = Location { cell, reference: at.reference };
        sum.add(mapped.point, mapped.weight, flow.space.vector(flow.velocity, &place));
    }
}

/// The midpoint rule on parts of the cells of the grid: their middles are a grid too.
fn add_solid(sum: &mut Sum<'_>, bodies: &Bodies, flow: PlanarFlow<'_>) {
    let (spacing, lower) = (sum.grid.spacing(), sum.grid.bounds().0);
    let part = spacing.map(|h| h / PARTS as f64);
    let middles = |d: usize| {
        let count = PARTS * (sum.grid.nodes()[d] - 1);
        (0..count).map(move |k| lower[d] + (k as f64 + 0.5) * part[d])
    };
    let xs: Vec<f64> = middles(0).collect();
    let mut codes = vec![0; xs.len()];
    for y in middles(1).collect::<Vec<_>>() {
        bodies.on_line(flow.mesh, y, &xs, &mut codes);
        for (&x, code) in xs.iter().zip(&codes) {
            if let Some(body) = code.checked_sub(1) {
                sum.add([x, y], part[0] * part[1], (flow.solid)(body, [x, y]));
            }
        }
    }
}
