use super::powers::{square, triangle};
use crate::element::Cell;
use crate::{PlanarMesh, Point};

/// How far outside of the reference cell a point still counts as inside.
const TOLERANCE: f64 = 1e-9;

/// Newton's method stops after a step as short as this: its error is then the square of it.
const SHORT: f64 = 1e-8;

/// A cell with less curvature is straight.
const STRAIGHT: f64 = 1e-12;

/// Newton steps after which it is given up.
const STEPS: usize = 12;

/// A part of the reference cell as small as this is not divided any more.
const SMALLEST: f64 = 1.0 / 64.0;

/// The quadratic map of a cell, ready to be inverted.
///
/// With `z` from the centre of the reference cell and `J` the Jacobian there, `J⁻¹ (x − x_c) = z + b(z)`,
/// where b has no constant and no linear part; it vanishes on an affine cell.
pub(crate) struct CellMap {
    kind: Cell,
    centre: Point,
    inverse: [[f64; 2]; 2],
    /// Coefficients of b: number `[i][j]` belongs to `z₀^i z₁^j`.
    bend: [[Point; 3]; 3],
    /// No entry sum of a row of `∂b/∂z` exceeds it where `|z₀|, |z₁| <= 1`. Below one, `z + b(z)` takes no
    /// value twice there.
    curvature: f64,
    tolerance: f64,
}

impl CellMap {
    /// The map of a cell of a mesh as it stands.
    pub fn new(mesh: &PlanarMesh, cell: usize) -> Self {
        match cell.checked_sub(mesh.topology().triangles().len()) {
            None => Self::normalised(Cell::Triangle, triangle(&mesh.triangle(cell))),
            Some(q) => Self::normalised(Cell::Quadrilateral, square(&mesh.quadrilateral(q))),
        }
    }

    /// From the coefficients of x as a polynomial in z.
    fn normalised(kind: Cell, c: [[Point; 3]; 3]) -> Self {
        let [[centre, [b, d], _], [[a, c_], _, _], _] = c;
        let determinant = a * d - b * c_;
        let inverse = [[d, -b], [-c_, a]].map(|row| row.map(|x| x / determinant));
        let mut bend = c.map(|row| row.map(|x| product(inverse, x)));
        (bend[0][0], bend[0][1], bend[1][0]) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        let mut curvature = 0.0;
        for (i, row) in bend.iter().enumerate() {
            for (j, coefficient) in row.iter().enumerate() {
                curvature += (i + j) as f64 * largest(*coefficient);
            }
        }
        let scale = (inverse[0][0].abs() + inverse[0][1].abs())
            .max(inverse[1][0].abs() + inverse[1][1].abs());
        let tolerance = TOLERANCE + 16.0 * f64::EPSILON * scale * largest(centre);
        Self { kind, centre, inverse, bend, curvature, tolerance }
    }

    /// The point of the reference cell whose image is `point`, in m; `None` if that is outside of the cell.
    #[inline]
    pub fn invert(&self, point: Point) -> Option<Point> {
        let target = product(self.inverse, [0, 1].map(|d| point[d] - self.centre[d]));
        // Nothing inside has an image beyond; a point that is not a number is not inside either.
        let furthest = (1.0 + self.curvature) * (self.reach() + self.tolerance);
        let is_near = largest(target) <= furthest;
        if !is_near {
            return None;
        }
        if self.curvature < STRAIGHT {
            return self.inside(target);
        }
        match self.newton(target, target) {
            Some(z) => match self.inside(z) {
                None if self.curvature >= 1.0 => self.search(target, self.whole()),
                found => found,
            },
            None => self.search(target, self.whole()),
        }
    }

    /// The largest coordinate of the reference cell, seen from its centre.
    fn reach(&self) -> f64 {
        if self.kind == Cell::Triangle { 2.0 / 3.0 } else { 0.5 }
    }

    fn middle(&self) -> f64 {
        if self.kind == Cell::Triangle { 1.0 / 3.0 } else { 0.5 }
    }

    /// The point of the reference cell at z, moved onto its rim if it is outside by round-off.
    fn inside(&self, z: Point) -> Option<Point> {
        let [x, y] = z.map(|z| z + self.middle());
        let (low, high) = (-self.tolerance, 1.0 + self.tolerance);
        if self.kind == Cell::Triangle {
            let (is_inside, [x, y]) =
                (x >= low && y >= low && x + y <= high, [x.max(0.0), y.max(0.0)]);
            let scale = 1.0_f64.min(1.0 / (x + y));
            return is_inside.then_some([x * scale, y * scale]);
        }
        let is_inside = x >= low && y >= low && x <= high && y <= high;
        is_inside.then(|| [x.clamp(0.0, 1.0), y.clamp(0.0, 1.0)])
    }

    /// A root of `z + b(z) = target` near the reference cell, by Newton's method from `start`.
    fn newton(&self, target: Point, start: Point) -> Option<Point> {
        let near = |z: f64| z.clamp(-1.0, 1.0);
        let mut z = start.map(near);
        for _ in 0..STEPS {
            let (image, [[a, b], [c, d]]) = self.evaluate(z);
            let [r, s] = [target[0] - image[0], target[1] - image[1]];
            let scale = 1.0 / (a * d - b * c);
            let step = [scale * (d * r - b * s), scale * (a * s - c * r)];
            z = [z[0] + step[0], z[1] + step[1]];
            if largest(step) < SHORT {
                return Some(z);
            }
            z = z.map(near);
        }
        None
    }

    fn whole(&self) -> Patch {
        Patch { corner: [-self.middle(); 2], size: 1.0 }
    }

    /// A root in the reference cell, by Newton's method from the centre of a part of it and of parts of that,
    /// as long as the target may be in their image.
    #[cold]
    fn search(&self, target: Point, patch: Patch) -> Option<Point> {
        if !self.may_reach(target, patch) {
            return None;
        }
        let root = self.newton(target, patch.point(0.5, 0.5)).and_then(|z| self.inside(z));
        if root.is_some() || patch.size <= SMALLEST {
            return root;
        }
        patch.quarters().into_iter().find_map(|quarter| self.search(target, quarter))
    }

    /// Whether the target is in the box round the Bernstein coefficients of the map on a patch, which has the
    /// image within.
    fn may_reach(&self, target: Point, patch: Patch) -> bool {
        let [x, y] = patch.corner.map(|z| z + self.middle());
        if self.kind == Cell::Triangle && x + y > 1.0 + self.tolerance {
            return false;
        }
        let halves = [0.0, 0.5, 1.0];
        let values = halves.map(|s| halves.map(|t| self.evaluate(patch.point(s, t)).0));
        let margin = (1.0 + self.curvature) * self.tolerance;
        (0..2).all(|d| {
            let rows = values.map(|row| bernstein(row.map(|value| value[d])));
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            for k in 0..3 {
                for b in bernstein(rows.map(|row| row[k])) {
                    (low, high) = (low.min(b), high.max(b));
                }
            }
            low - margin <= target[d] && target[d] <= high + margin
        })
    }

    /// `z + b(z)` and its Jacobian.
    #[inline]
    fn evaluate(&self, [s, t]: Point) -> (Point, [[f64; 2]; 2]) {
        let b = &self.bend;
        let (mut value, mut jacobian) = ([s, t], [[1.0, 0.0], [0.0, 1.0]]);
        for d in [0, 1] {
            let row = |i: usize| b[i][0][d] + t * (b[i][1][d] + t * b[i][2][d]);
            let slope = |i: usize| b[i][1][d] + 2.0 * t * b[i][2][d];
            let (one, two) = (row(1), row(2));
            value[d] += row(0) + s * (one + s * two);
            jacobian[d][0] += one + 2.0 * s * two;
            jacobian[d][1] += slope(0) + s * (slope(1) + s * slope(2));
        }
        (value, jacobian)
    }
}

/// A square part of the plane of z.
#[derive(Clone, Copy)]
struct Patch {
    corner: Point,
    size: f64,
}

impl Patch {
    fn point(self, s: f64, t: f64) -> Point {
        [self.corner[0] + s * self.size, self.corner[1] + t * self.size]
    }

    fn quarters(self) -> [Self; 4] {
        let size = 0.5 * self.size;
        [[0.0, 0.0], [0.5, 0.0], [0.0, 0.5], [0.5, 0.5]]
            .map(|[s, t]| Self { corner: self.point(s, t), size })
    }
}

/// Bernstein coefficients of a quadratic from its values at 0, 1/2 and 1.
fn bernstein([a, middle, b]: [f64; 3]) -> [f64; 3] {
    [a, 2.0 * middle - 0.5 * (a + b), b]
}

fn product(m: [[f64; 2]; 2], x: Point) -> Point {
    m.map(|row| row[0] * x[0] + row[1] * x[1])
}

fn largest(x: Point) -> f64 {
    x[0].abs().max(x[1].abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MeshDescription;
    use crate::element::{Element, Q2, TriangleP2};
    use crate::geometry::{Mapped, Tabulated};

    /// A mesh with triangles and quadrilaterals whose maps have all coefficients.
    fn mesh() -> PlanarMesh {
        let bend = |[x, y]: Point| {
            [x + 0.2 * x * y * y + 0.1 * y + 3.0, y - 0.15 * x * x + 0.1 * (3.0 * x * y).sin()]
        };
        let cut = |[i, j]: [usize; 2]| (i + j) % 2 == 0;
        PlanarMesh::new(MeshDescription::structured([2, 2], cut, bend)).expect("valid")
    }

    fn image(mesh: &PlanarMesh, cell: usize, at: Point) -> Point {
        match cell.checked_sub(mesh.topology().triangles().len()) {
            None => Mapped::new(&mesh.triangle(cell), &Tabulated::at(&TriangleP2, at, 0.0)).point,
            Some(q) => Mapped::new(&mesh.quadrilateral(q), &Tabulated::at(&Q2, at, 0.0)).point,
        }
    }

    #[test]
    fn polynomials_are_the_map_of_the_elements() {
        let mesh = mesh();
        for cell in 0..mesh.topology().cells() {
            let map = CellMap::new(&mesh, cell);
            for at in [[0.1, 0.7], [0.3, 0.3], [0.0, 0.0], [1.0, 0.0], [0.5, 0.5]] {
                let x = image(&mesh, cell, at);
                let target = product(map.inverse, [0, 1].map(|d| x[d] - map.centre[d]));
                let (value, jacobian) = map.evaluate(at.map(|x| x - map.middle()));
                for d in [0, 1] {
                    assert!((value[d] - target[d]).abs() < 1e-13, "cell {cell}");
                    for e in [0, 1] {
                        let step = |h: f64| {
                            let mut z = at.map(|x| x - map.middle());
                            z[e] += h;
                            map.evaluate(z).0[d]
                        };
                        let slope = (step(1e-4) - step(-1e-4)) / 2e-4;
                        assert!((jacobian[d][e] - slope).abs() < 1e-7, "cell {cell}");
                    }
                }
            }
        }
    }

    #[test]
    fn nodes_come_back_and_neighbours_of_the_cell_do_not() {
        let mesh = mesh();
        for cell in 0..mesh.topology().cells() {
            let map = CellMap::new(&mesh, cell);
            let kind = mesh.topology().kind(cell);
            let element: &dyn Element = if kind == Cell::Triangle { &TriangleP2 } else { &Q2 };
            for &node in element.nodes() {
                let back = map.invert(image(&mesh, cell, node)).expect("inside");
                assert!((0..2).all(|d| (back[d] - node[d]).abs() < 1e-13), "{back:?} {node:?}");
                let outside = node.map(|x| if x < 0.5 { x - 1e-6 } else { x + 1e-6 });
                let rim = node != [0.5, 0.5] || kind == Cell::Triangle;
                assert_eq!(map.invert(image(&mesh, cell, outside)).is_none(), rim, "{node:?}");
            }
        }
    }

    #[test]
    fn what_is_not_a_number_is_nowhere() {
        let mesh = mesh();
        let map = CellMap::new(&mesh, 0);
        for x in [f64::NAN, f64::INFINITY] {
            assert_eq!(map.invert([x, 0.1]), None);
            assert_eq!(map.invert([3.1, x]), None);
        }
    }
}
