//! Bernstein coefficients of the determinant of a cell's map, straight from its nodes.
//!
//! The columns of the Jacobian are differences of the cell's control points, and the coefficients of the
//! determinant are weighted means of cross products of these. The determinant lies nowhere below the
//! smallest of them.

use crate::Point;

/// A lower bound of a determinant, in m².
#[derive(Debug, Clone, Copy)]
pub(super) struct Bound {
    /// No value of the determinant is below.
    pub least: f64,
    /// The squared differences of the control points, added up: round-off is a small part of them.
    pub scale: f64,
}

/// On a curved triangle, whose determinant is quadratic.
pub(super) fn on_triangle(&[v0, v1, v2, m01, m12, m20]: &[Point; 6]) -> Bound {
    let (p01, p12, p20) = (control(v0, m01, v1), control(v1, m12, v2), control(v2, m20, v0));
    // Half of the derivatives, which are linear, at the corners.
    let a = [minus(p01, v0), minus(v1, p01), minus(p12, p20)];
    let b = [minus(p20, v0), minus(p12, p01), minus(v2, p20)];
    let coefficient = |(i, j): (usize, usize)| 2.0 * (cross(a[i], b[j]) + cross(a[j], b[i]));
    let coefficients = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)].map(coefficient);
    Bound { least: least(&coefficients), scale: squares(&a) + squares(&b) }
}

/// Nodes of a quadrilateral, row by row.
const ROWS: [[usize; 3]; 3] = [[0, 4, 1], [7, 8, 5], [3, 6, 2]];

/// The linear function i times the quadratic k of Bernstein is so much of the cubic i + k.
const SHARE: [[f64; 3]; 2] = [[1.0, 2.0 / 3.0, 1.0 / 3.0], [1.0 / 3.0, 2.0 / 3.0, 1.0]];

/// On a curved quadrilateral, whose determinant is cubic in each variable.
pub(super) fn on_quadrilateral(nodes: &[Point; 9]) -> Bound {
    let rows = ROWS.map(|[a, m, b]| [nodes[a], control(nodes[a], nodes[m], nodes[b]), nodes[b]]);
    let middle = [0, 1, 2].map(|i| control(rows[0][i], rows[1][i], rows[2][i]));
    let p = [rows[0], middle, rows[2]];
    // Half of the derivatives along the rows and across.
    let along = p.map(|[a, b, c]| [minus(b, a), minus(c, b)]);
    let across = [0, 1].map(|l| [0, 1, 2].map(|k| minus(p[l + 1][k], p[l][k])));
    let mut coefficients = [[0.0; 4]; 4];
    for (l, across) in across.iter().enumerate() {
        for (j, along) in along.iter().enumerate() {
            for (k, across) in across.iter().enumerate() {
                for (i, along) in along.iter().enumerate() {
                    let share = 4.0 * SHARE[l][j] * SHARE[i][k];
                    coefficients[l + j][i + k] += share * cross(*along, *across);
                }
            }
        }
    }
    Bound {
        least: least(coefficients.as_flattened()),
        scale: squares(along.as_flattened()) + squares(across.as_flattened()),
    }
}

/// The control point between the ends of a quadratic curve through m.
fn control(a: Point, m: Point, b: Point) -> Point {
    [0, 1].map(|d| 2.0 * m[d] - 0.5 * (a[d] + b[d]))
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn least(values: &[f64]) -> f64 {
    values.iter().fold(f64::INFINITY, |a, &b| if b < a { b } else { a })
}

fn squares(vectors: &[Point]) -> f64 {
    vectors.iter().map(|[x, y]| x * x + y * y).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Areas of the straight cells, and cells whose middles are pushed too far: past the quarter point the
    /// map of an edge turns back.
    #[test]
    fn determinants_of_simple_triangles() {
        let triangle =
            |x| on_triangle(&[[0., 0.], [2., 0.], [0., 2.], [x, 0.], [1., 1.], [0., 1.]]).least;
        assert_eq!(triangle(1.0), 4.0);
        assert!(triangle(0.51) > 0.0 && triangle(0.49) < 0.0);
    }
}
