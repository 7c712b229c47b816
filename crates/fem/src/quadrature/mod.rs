//! Quadrature on reference cells: points inside, weights positive.

mod interval;
mod square;
mod triangle;

pub use interval::gauss_legendre;

use crate::Point;
use crate::element::Cell;

/// A rule on a reference cell: pairs of point and weight; the weights sum to the cell's measure.
///
/// Exact for polynomials of total degree `degree` on the triangle, of that degree in each variable
/// on the interval and on the square.
///
/// ```
/// use lumley_fem::{element::Cell, quadrature::rule};
/// let integral = |cell| rule(cell, 3).iter().map(|([x, y], w)| w * x * x * y).sum::<f64>();
/// assert!((integral(Cell::Triangle) - 1.0 / 60.0).abs() < 1e-16);
/// assert!((integral(Cell::Quadrilateral) - 1.0 / 6.0).abs() < 1e-16);
/// ```
pub fn rule(cell: Cell, degree: usize) -> Vec<(Point, f64)> {
    match cell {
        Cell::Interval => {
            gauss_legendre(degree / 2 + 1).into_iter().map(|(x, w)| ([x, 0.0], w)).collect()
        }
        Cell::Triangle => triangle::rule(degree),
        Cell::Quadrilateral => square::rule(degree),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLANAR: [Cell; 2] = [Cell::Triangle, Cell::Quadrilateral];

    fn power(x: f64, exponent: usize) -> f64 {
        x.powi(i32::try_from(exponent).expect("small"))
    }

    /// `∫ x^a y^b`: `a! b! / (a + b + 2)!` on the triangle, which the loop divides out factor by factor.
    fn exact(cell: Cell, a: usize, b: usize) -> f64 {
        match cell {
            Cell::Interval => 1.0 / (a as f64 + 1.0),
            Cell::Quadrilateral => 1.0 / ((a as f64 + 1.0) * (b as f64 + 1.0)),
            Cell::Triangle => {
                let ratio: f64 = (1..=b).map(|k| k as f64 / (a + k) as f64).product();
                ratio / ((a + b + 1) as f64 * (a + b + 2) as f64)
            }
        }
    }

    /// Largest error of the rule of `degree` over the monomials of total degree `total`.
    fn worst(cell: Cell, degree: usize, total: usize) -> f64 {
        let rule = rule(cell, degree);
        (0..=total)
            .map(|a| (a, total - a))
            .map(|(a, b)| {
                let sum: f64 = rule.iter().map(|([x, y], w)| w * power(*x, a) * power(*y, b)).sum();
                (sum - exact(cell, a, b)).abs()
            })
            .fold(0.0, f64::max)
    }

    #[test]
    fn exact_on_all_monomials_up_to_the_degree() {
        for cell in PLANAR {
            for degree in 0..=14 {
                for total in 0..=degree {
                    let error = worst(cell, degree, total);
                    assert!(error < 2e-15, "{cell:?}, rule {degree}, degree {total}: {error:e}");
                }
            }
        }
    }

    /// The degree that each rule truly has: a table entry with a wrong digit would not show above.
    #[test]
    fn not_exact_on_the_next_degree() {
        for (cell, degrees) in [
            (Cell::Triangle, vec![1, 2, 4, 5, 6, 8, 9, 10, 11, 12]),
            (Cell::Quadrilateral, vec![1, 3, 5, 7, 9]),
        ] {
            for degree in degrees {
                let error = worst(cell, degree, degree + 1);
                assert!(error > 1e-9, "{cell:?}, rule {degree}: {error:e}");
            }
        }
    }

    #[test]
    fn squares_are_exact_in_each_variable() {
        for degree in 0..=9 {
            let rule = rule(Cell::Quadrilateral, degree);
            let sum: f64 = rule.iter().map(|([x, y], w)| w * power(x * y, degree)).sum();
            assert!((sum - exact(Cell::Quadrilateral, degree, degree)).abs() < 2e-16, "{degree}");
        }
    }

    #[test]
    fn points_are_inside_and_weights_positive() {
        for degree in 0..=14 {
            for ([x, y], weight) in rule(Cell::Triangle, degree) {
                assert!(x > 0.0 && y > 0.0 && x + y < 1.0 && weight > 0.0, "rule {degree}");
            }
            for ([x, y], weight) in rule(Cell::Quadrilateral, degree) {
                assert!(x > 0.0 && y > 0.0 && x.max(y) < 1.0 && weight > 0.0, "rule {degree}");
            }
        }
    }

    /// A flow without swirl must not get one from the quadrature.
    #[test]
    fn triangle_rules_do_not_prefer_a_corner() {
        for degree in 0..=8 {
            let rule = rule(Cell::Triangle, degree);
            for ([x, y], weight) in &rule {
                let turned = [*y, 1.0 - x - y];
                let found = rule.iter().any(|([a, b], w)| {
                    (a - turned[0]).abs() + (b - turned[1]).abs() + (w - weight).abs() < 1e-15
                });
                assert!(found, "rule {degree} at ({x}, {y})");
            }
        }
    }
}
