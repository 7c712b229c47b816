//! Proof that no cell is inside out anywhere, not only at sampled points.
//!
//! The determinant of the map is a polynomial: quadratic on a curved triangle, cubic in each variable on a
//! curved quadrilateral. It lies above the smallest of its Bernstein coefficients, which follow from its
//! values on a lattice; where that bound is too low, the cell is quartered (Johnen, Remacle and Geuzaine
//! 2013, J. Comput. Phys. 233, 359-372).

use super::MeshError;
use super::bernstein::{Bound, on_quadrilateral, on_triangle};
use super::cells::Cells;
use super::check::extent;
use super::place::CellPlace;
use crate::Point;
use crate::element::{Cell, Element, Q2, TriangleP2};
use crate::geometry::{Mapped, Tabulated};
use std::array::from_fn;

/// A cell that quartering so often does not decide is flat for all purposes.
const DEPTH: usize = 8;

/// A determinant below this many times the square of the cell's extent is round-off.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;

/// A cell whose lower bound is above this part of its scale needs no search: round-off is far smaller.
const SURE: f64 = 1e-10;

/// The first cell whose determinant is not positive everywhere is an error. Allocates nothing.
pub(super) fn check(points: &[Point], cells: &Cells) -> Result<(), MeshError> {
    let triangle = of_triangles();
    for (cell, nodes) in cells.triangles.iter().enumerate() {
        triangle.check(cell, &nodes.map(|node| points[node]))?;
    }
    let quadrilateral = of_quadrilaterals();
    for (q, nodes) in cells.quadrilaterals.iter().enumerate() {
        quadrilateral.check(cells.triangles.len() + q, &nodes.map(|node| points[node]))?;
    }
    Ok(())
}

fn of_triangles() -> Proof<6, 6> {
    Proof {
        element: &TriangleP2,
        bound: on_triangle,
        lattice: from_fn(|k| TriangleP2.nodes()[k]),
        lowest_coefficient: lowest_quadratic,
    }
}

fn of_quadrilaterals() -> Proof<9, 16> {
    Proof {
        element: &Q2,
        bound: on_quadrilateral,
        lattice: from_fn(thirds),
        lowest_coefficient: lowest_cubic,
    }
}

/// How the determinant of a kind of cell with N nodes is bounded: on the whole cell from the nodes, on a
/// part of it from L values.
struct Proof<const N: usize, const L: usize> {
    element: &'static dyn Element,
    bound: fn(&[Point; N]) -> Bound,
    lattice: [Point; L],
    lowest_coefficient: fn(&[f64; L]) -> f64,
}

impl<const N: usize, const L: usize> Proof<N, L> {
    fn check(&self, cell: usize, nodes: &[Point; N]) -> Result<(), MeshError> {
        let Bound { least, scale } = (self.bound)(nodes);
        if least > SURE * scale {
            return Ok(());
        }
        let floor = ROUND_OFF * extent(nodes).powi(2);
        self.search(nodes, floor, Patch::WHOLE).map_or(Ok(()), |worst| {
            let cell = CellPlace { cell, place: worst.point };
            Err(MeshError::Inverted { cell, determinant: worst.determinant })
        })
    }

    /// A point of a patch where the determinant is not above `floor`, if there is one.
    fn search(&self, nodes: &[Point; N], floor: f64, patch: Patch) -> Option<Mapped> {
        let mapped: [Mapped; L] = from_fn(|k| self.map(nodes, patch.point(self.lattice[k])));
        let lowest = mapped.into_iter().min_by(|a, b| a.determinant.total_cmp(&b.determinant));
        if lowest.is_some_and(|m| m.determinant <= floor) {
            return lowest;
        }
        if (self.lowest_coefficient)(&mapped.map(|m| m.determinant)) > floor {
            return None;
        }
        if patch.depth == DEPTH {
            return lowest;
        }
        let mut quarters = patch.quarters(self.element.layout().cell).into_iter();
        quarters.find_map(|quarter| self.search(nodes, floor, quarter))
    }

    fn map(&self, nodes: &[Point; N], reference: Point) -> Mapped {
        Mapped::new(nodes, &Tabulated::at(self.element, reference, 0.0))
    }
}

/// A part of a reference cell that is similar to it; turned by half a circle if the size is negative.
#[derive(Clone, Copy)]
struct Patch {
    origin: Point,
    size: f64,
    depth: usize,
}

impl Patch {
    const WHOLE: Self = Self { origin: [0.0; 2], size: 1.0, depth: 0 };

    fn point(&self, reference: Point) -> Point {
        [0, 1].map(|d| self.origin[d] + self.size * reference[d])
    }

    fn quarters(&self, cell: Cell) -> [Self; 4] {
        let (half, depth) = (0.5 * self.size, self.depth + 1);
        let at = |corner: Point, size: f64| Self { origin: self.point(corner), size, depth };
        let last = if cell == Cell::Triangle { -half } else { half };
        [at([0.0, 0.0], half), at([0.5, 0.0], half), at([0.0, 0.5], half), at([0.5, 0.5], last)]
    }
}

/// Of a quadratic on a triangle, from its values at the corners and at the middles of the edges.
fn lowest_quadratic(values: &[f64; 6]) -> f64 {
    let middle = |k: usize| 2.0 * values[3 + k] - 0.5 * (values[k] + values[(k + 1) % 3]);
    values[..3].iter().copied().chain((0..3).map(middle)).fold(f64::INFINITY, f64::min)
}

/// Four by four points on the square, row by row.
fn thirds(k: usize) -> Point {
    [(k % 4) as f64 / 3.0, (k / 4) as f64 / 3.0]
}

/// Of a cubic in each variable on the square, from its values on the lattice.
fn lowest_cubic(values: &[f64; 16]) -> f64 {
    let mut b = *values;
    for k in 0..4 {
        cubic_coefficients(&mut b, [4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 3]);
    }
    for k in 0..4 {
        cubic_coefficients(&mut b, [k, k + 4, k + 8, k + 12]);
    }
    b.into_iter().fold(f64::INFINITY, f64::min)
}

/// Bernstein coefficients of a cubic in place of its values at 0, 1/3, 2/3 and 1.
fn cubic_coefficients(b: &mut [f64; 16], at: [usize; 4]) {
    let f = at.map(|k| b[k]);
    b[at[1]] = (-5.0 * f[0] + 18.0 * f[1] - 9.0 * f[2] + 2.0 * f[3]) / 6.0;
    b[at[2]] = (2.0 * f[0] - 9.0 * f[1] + 18.0 * f[2] - 5.0 * f[3]) / 6.0;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `B_j^n(x)` times its coefficient, added up.
    fn cubic(b: [f64; 4], x: f64) -> f64 {
        let y = 1.0 - x;
        b[0] * y.powi(3) + 3.0 * b[1] * x * y * y + 3.0 * b[2] * x * x * y + b[3] * x.powi(3)
    }

    #[test]
    fn coefficients_of_cubics_come_back() {
        let (along, across) = ([1.0, -2.0, 0.5, 3.0], [0.7, 1.1, -0.4, 2.0]);
        let values: Vec<f64> =
            (0..16).map(thirds).map(|[x, y]| cubic(along, x) * cubic(across, y)).collect();
        let lowest = lowest_cubic(&values.try_into().expect("sixteen"));
        assert!((lowest - (-2.0 * 2.0)).abs() < 1e-14, "{lowest}");
    }

    /// `λ₀² b₀ + … + 2 λ₀ λ₁ b₀₁ + …`
    #[test]
    fn coefficients_of_quadratics_come_back() {
        let (corners, middles) = ([1.0, 2.0, 3.0], [-0.5, 4.0, 0.25]);
        let value = |&[x, y]: &Point| {
            let l = [1.0 - x - y, x, y];
            let term = |k: usize| {
                let next = l[(k + 1) % 3];
                corners[k] * l[k] * l[k] + 2.0 * middles[k] * l[k] * next
            };
            (0..3).map(term).sum::<f64>()
        };
        let values: Vec<f64> = TriangleP2.nodes().iter().map(value).collect();
        let lowest = lowest_quadratic(&values.try_into().expect("six"));
        assert!((lowest + 0.5).abs() < 1e-15, "{lowest}");
    }

    /// The unit square with a node moved.
    fn square(node: usize, place: Point) -> [Point; 9] {
        let mut nodes: [Point; 9] = Q2.nodes().try_into().expect("nine");
        nodes[node] = place;
        nodes
    }

    /// Cells from good to tangled: the reference cell with every node moved by up to `by`, by golden steps.
    fn shaken<const N: usize>(element: &dyn Element, seed: u32, by: f64) -> [Point; N] {
        let golden = |k: usize| (0.618_033_988_75 * (k as f64 + 7.3 * f64::from(seed))).fract();
        from_fn(|n| [0, 1].map(|d| element.nodes()[n][d] + by * (2.0 * golden(2 * n + d) - 1.0)))
    }

    /// The bound from the nodes and the bound from the values are the same coefficient, and what one
    /// accepts the search accepts.
    fn compare<const N: usize, const L: usize>(proof: &Proof<N, L>) -> [usize; 2] {
        let mut verdicts = [0; 2];
        for (seed, by) in (0..3000).map(|seed| (seed, 0.0001 * f64::from(seed))) {
            let nodes = shaken(proof.element, seed, by);
            let values = proof.lattice.map(|at| proof.map(&nodes, at).determinant);
            let bound = (proof.bound)(&nodes);
            let gap = bound.least - (proof.lowest_coefficient)(&values);
            assert!(gap.abs() < 1e-13 * bound.scale, "{nodes:?}: {gap:e}");
            let floor = ROUND_OFF * extent(&nodes).powi(2);
            let found = proof.search(&nodes, floor, Patch::WHOLE).is_none();
            assert_eq!(proof.check(0, &nodes).is_ok(), found, "{nodes:?}");
            verdicts[usize::from(found)] += 1;
        }
        verdicts
    }

    #[test]
    fn the_quick_bound_changes_no_verdict() {
        for verdicts in [compare(&of_triangles()), compare(&of_quadrilaterals())] {
            assert!(verdicts.iter().all(|&count| count > 300), "{verdicts:?}");
        }
    }

    fn is_valid(nodes: [Point; 9]) -> bool {
        let cells = Cells { triangles: vec![], quadrilaterals: vec![from_fn(|k| k)] };
        check(&nodes, &cells).is_ok()
    }

    /// The determinant at (0, 0) is `(4 m − 1) · 1` for the middle of the first edge at `(m, 0)`, and symmetric.
    #[test]
    fn middles_may_move_to_the_quarter_of_their_edge() {
        for m in [0.2501, 0.3, 0.5, 0.7, 0.7499] {
            assert!(is_valid(square(4, [m, 0.0])), "middle at {m}");
        }
        for m in [0.2, 0.2499, 0.25, 0.75, 0.7501, 0.8] {
            assert!(!is_valid(square(4, [m, 0.0])), "middle at {m}");
        }
    }

    fn lowest(nodes: &[Point; 9], points: impl IntoIterator<Item = Point>) -> f64 {
        let at = |point| Mapped::new(nodes, &Tabulated::at(&Q2, point, 0.0)).determinant;
        points.into_iter().map(at).fold(f64::INFINITY, f64::min)
    }

    /// Some of these cells are positive at nodes and Gauss points and folded between them. The fine grid
    /// misses the true minimum by less than the margin.
    #[test]
    fn a_fold_between_the_usual_points_is_found() {
        const MARGIN: f64 = 1e-3;
        let rule = crate::quadrature::rule(Cell::Quadrilateral, 5);
        let usual: Vec<Point> =
            Q2.nodes().iter().copied().chain(rule.into_iter().map(|(point, _)| point)).collect();
        let fine =
            (0..=100).flat_map(|i| (0..=100).map(move |j| [i, j].map(|k| f64::from(k) / 100.0)));
        let mut hidden = 0;
        for k in 0..400 {
            let nodes = square(4, [0.15 + 0.001 * f64::from(k), 0.3]);
            let truth = lowest(&nodes, fine.clone());
            if truth <= 0.0 || truth > MARGIN {
                assert_eq!(is_valid(nodes), truth > 0.0, "{nodes:?}: {truth}");
            }
            hidden += usize::from(truth <= 0.0 && lowest(&nodes, usual.iter().copied()) > 0.0);
        }
        assert!(hidden > 0, "no cell hides its fold from the usual points");
    }
}
