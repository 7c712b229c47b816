//! Reference elements: where their nodes are, which functions belong to the nodes.
//!
//! A new element is one file here and one line in [`ELEMENTS`]; the property suite below then runs
//! over it.

mod p1;
mod p2;
mod p2_bubble;
mod q1;
mod q2;
mod tensor;
mod triangle_p1;
mod triangle_p2;

pub use p1::P1;
pub use p2::P2;
pub use p2_bubble::P2Bubble;
pub use q1::Q1;
pub use q2::Q2;
pub use triangle_p1::TriangleP1;
pub use triangle_p2::TriangleP2;

use crate::Point;

/// The shape of a reference cell.
///
/// Corners are numbered counterclockwise; edge k goes from corner k to the next.
///
/// ```
/// use lumley_fem::element::Cell;
/// assert_eq!((Cell::Interval.vertices(), Cell::Triangle.edges()), (2, 3));
/// assert_eq!(Cell::Quadrilateral.on_edge(2, 0.25), [0.75, 1.0]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Cell {
    /// The interval from 0 to 1; points have a second coordinate of zero.
    Interval,
    /// The triangle (0, 0), (1, 0), (0, 1).
    Triangle,
    /// The unit square, from (0, 0) to (1, 1).
    Quadrilateral,
}

impl Cell {
    /// The corners.
    pub fn corners(self) -> &'static [Point] {
        match self {
            Self::Interval => &[[0.0, 0.0], [1.0, 0.0]],
            Self::Triangle => &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
            Self::Quadrilateral => &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
        }
    }

    /// Number of corners.
    pub fn vertices(self) -> usize {
        self.corners().len()
    }

    /// Number of edges; an interval is its own interior and has none.
    pub fn edges(self) -> usize {
        match self {
            Self::Interval => 0,
            Self::Triangle => 3,
            Self::Quadrilateral => 4,
        }
    }

    /// The point at `s`, from 0 to 1, along edge `edge`.
    pub fn on_edge(self, edge: usize, s: f64) -> Point {
        let (a, b) = (self.corners()[edge], self.corners()[(edge + 1) % self.edges()]);
        [0, 1].map(|d| a[d] * (1.0 - s) + b[d] * s)
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

    /// Numbers in the cell of the nodes on edge `edge`: at its start, at its end, between them.
    pub fn on_edge(self, edge: usize) -> impl Iterator<Item = usize> {
        let (vertex, count) = (self.vertex, self.edge);
        let of_vertex = move |v: usize| v * vertex..(v + 1) * vertex;
        let first = vertex * self.cell.vertices() + edge * count;
        let ends = of_vertex(edge).chain(of_vertex((edge + 1) % self.cell.edges()));
        ends.chain(first..first + count)
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
    /// Values alone, which some elements have at less cost.
    ///
    /// # Panics
    /// If the element has more nodes than any of this crate.
    fn values(&self, point: Point, phi: &mut [f64]) {
        let n = phi.len();
        self.tabulate(point, phi, &mut [[0.0; 2]; MOST_NODES][..n]);
    }
}

/// Nodes of the largest element.
pub(crate) const MOST_NODES: usize = 9;

/// Every element, with its name.
pub const ELEMENTS: &[(&str, &dyn Element)] = &[
    ("interval P1", &P1),
    ("interval P2", &P2),
    ("triangle P1", &TriangleP1),
    ("triangle P2", &TriangleP2),
    ("triangle P2 with bubble", &P2Bubble),
    ("square Q1", &Q1),
    ("square Q2", &Q2),
];

#[cfg(test)]
mod tests;
