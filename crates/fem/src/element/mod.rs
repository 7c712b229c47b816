//! Reference elements: where their nodes are, which functions belong to the nodes.
//!
//! A new element is one file here and one line in [`ELEMENTS`]; the property suite below then runs
//! over it.

mod p1;
mod p2;

pub use p1::P1;
pub use p2::P2;

use crate::Point;

/// The shape of a reference cell.
///
/// ```
/// use lumley_fem::element::Cell;
/// assert_eq!(Cell::Interval.vertices(), 2);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Cell {
    /// The interval from 0 to 1; points have a second coordinate of zero.
    Interval,
}

impl Cell {
    /// Number of corners.
    pub fn vertices(self) -> usize {
        match self {
            Self::Interval => 2,
        }
    }

    /// Number of edges; an interval is its own interior and has none.
    pub fn edges(self) -> usize {
        match self {
            Self::Interval => 0,
        }
    }
}

/// How many nodes sit on each vertex, on each edge and inside of a cell.
///
/// Nodes are numbered in this order: vertices, edges, interior.
///
/// ```
/// use lumley_fem::element::{Element, P2};
/// let layout = P2.layout();
/// assert_eq!((layout.vertex, layout.interior, layout.nodes()), (1, 1, 3));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DofLayout {
    /// The cell that carries the nodes.
    pub cell: Cell,
    /// Nodes on each vertex.
    pub vertex: usize,
    /// Nodes on each edge, its ends apart.
    pub edge: usize,
    /// Nodes inside.
    pub interior: usize,
}

impl DofLayout {
    /// Nodes of a cell.
    pub fn nodes(self) -> usize {
        self.vertex * self.cell.vertices() + self.edge * self.cell.edges() + self.interior
    }
}

/// A Lagrange element on its reference cell: function `i` is one at node `i`, zero at the others.
///
/// ```
/// use lumley_fem::element::{Element, P1};
/// let (mut phi, mut dphi) = ([0.0; 2], [[0.0; 2]; 2]);
/// P1.tabulate([0.25, 0.0], &mut phi, &mut dphi);
/// assert_eq!((phi, dphi), ([0.75, 0.25], [[-1.0, 0.0], [1.0, 0.0]]));
/// ```
pub trait Element: Sync {
    /// Largest p such that every polynomial of degree p is in the span.
    fn degree(&self) -> usize;
    /// Where the nodes sit, in numbers.
    fn layout(&self) -> DofLayout;
    /// Where the nodes sit, in reference coordinates.
    fn nodes(&self) -> &[Point];
    /// Values `phi` and gradients `dphi` of all functions at a point of the reference cell; both
    /// have as many entries as there are nodes.
    fn tabulate(&self, point: Point, phi: &mut [f64], dphi: &mut [Point]);
}

/// Every element, with its name.
pub const ELEMENTS: &[(&str, &dyn Element)] = &[("interval P1", &P1), ("interval P2", &P2)];

#[cfg(test)]
mod tests {
    use super::*;

    fn tabulated(element: &dyn Element, point: Point) -> (Vec<f64>, Vec<Point>) {
        let n = element.layout().nodes();
        let (mut phi, mut dphi) = (vec![f64::NAN; n], vec![[f64::NAN; 2]; n]);
        element.tabulate(point, &mut phi, &mut dphi);
        (phi, dphi)
    }

    /// Points inside of a cell, away from its symmetries.
    fn samples(cell: Cell) -> &'static [Point] {
        match cell {
            Cell::Interval => &[[0.07, 0.0], [0.37, 0.0], [0.81, 0.0]],
        }
    }

    /// Directions in which a cell extends.
    fn axes(cell: Cell) -> std::ops::Range<usize> {
        match cell {
            Cell::Interval => 0..1,
        }
    }

    #[test]
    fn functions_are_nodal() {
        for (name, element) in ELEMENTS {
            assert_eq!(element.nodes().len(), element.layout().nodes(), "{name}");
            for (i, &node) in element.nodes().iter().enumerate() {
                for (j, phi) in tabulated(*element, node).0.into_iter().enumerate() {
                    let expected = f64::from(u8::from(i == j));
                    assert!((phi - expected).abs() < 1e-15, "{name}: phi_{j}(node {i}) = {phi}");
                }
            }
        }
    }

    #[test]
    fn functions_sum_to_one_and_gradients_to_zero() {
        for (name, element) in ELEMENTS {
            for &point in samples(element.layout().cell) {
                let (phi, dphi) = tabulated(*element, point);
                assert!((phi.iter().sum::<f64>() - 1.0).abs() < 1e-15, "{name}");
                for d in [0, 1] {
                    assert!(dphi.iter().map(|g| g[d]).sum::<f64>().abs() < 1e-14, "{name}");
                }
            }
        }
    }

    #[test]
    fn gradients_are_the_limits_of_differences() {
        let h = 1e-5;
        for (name, element) in ELEMENTS {
            for &point in samples(element.layout().cell) {
                let (_, dphi) = tabulated(*element, point);
                for d in axes(element.layout().cell) {
                    let at = |s: f64| {
                        let mut p = point;
                        p[d] += s;
                        tabulated(*element, p).0
                    };
                    for ((ahead, behind), g) in at(h).iter().zip(at(-h)).zip(&dphi) {
                        let difference = (ahead - behind) / (2.0 * h);
                        assert!((difference - g[d]).abs() < 1e-9, "{name}: {difference} {g:?}");
                    }
                }
            }
        }
    }

    /// The span holds every monomial up to the degree, and not the next.
    #[test]
    fn degree_is_what_is_reproduced() {
        for (name, element) in ELEMENTS {
            for power in 0..=element.degree() + 1 {
                let monomial = |p: Point| p[0].powi(i32::try_from(power).expect("small"));
                let worst = samples(element.layout().cell)
                    .iter()
                    .map(|&point| {
                        let (phi, _) = tabulated(*element, point);
                        let sum: f64 =
                            phi.iter().zip(element.nodes()).map(|(f, &n)| f * monomial(n)).sum();
                        (sum - monomial(point)).abs()
                    })
                    .fold(0.0, f64::max);
                assert_eq!(worst < 1e-14, power <= element.degree(), "{name}, x^{power}: {worst}");
            }
        }
    }
}
