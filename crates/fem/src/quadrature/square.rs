use super::gauss_legendre;
use crate::Point;

/// The product of two Gauss-Legendre rules.
pub(super) fn rule(degree: usize) -> Vec<(Point, f64)> {
    let line = gauss_legendre(degree / 2 + 1);
    let row = |(y, v): (f64, f64)| line.iter().map(move |&(x, w)| ([x, y], w * v));
    line.iter().copied().flat_map(row).collect()
}
