use crate::Point;

/// A fixed uniform grid of nodes on an interval or a rectangle, on which POD is done.
///
/// Node `(i, j)` has the number `j * nodes[0] + i`. A field of k components on it is a vector of
/// length `k * len()`, component after component.
///
/// ```
/// use lumley_fem::UniformGrid;
/// let grid = UniformGrid::line(0.0, 1.1, 401);
/// assert_eq!(grid.len(), 401);
/// assert!((grid.point(400)[0] - 1.1).abs() < 1e-15);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct UniformGrid {
    lower: Point,
    upper: Point,
    nodes: [usize; 2],
}

impl UniformGrid {
    /// The grid of `nodes` nodes on the interval from `a` to `b`, in m.
    ///
    /// # Panics
    /// If `nodes < 2` or `a >= b`.
    pub fn line(a: f64, b: f64, nodes: usize) -> Self {
        assert!(nodes >= 2 && a < b, "a grid needs two nodes and a length");
        Self { lower: [a, 0.0], upper: [b, 0.0], nodes: [nodes, 1] }
    }

    /// The grid of `nodes[0] x nodes[1]` nodes on the rectangle from `lower` to `upper`, in m.
    ///
    /// # Panics
    /// If a direction has fewer than two nodes or no length.
    pub fn rectangle(lower: Point, upper: Point, nodes: [usize; 2]) -> Self {
        for d in 0..2 {
            assert!(nodes[d] >= 2 && lower[d] < upper[d], "a grid needs two nodes and a length");
        }
        Self { lower, upper, nodes }
    }

    /// 1 for an interval, 2 for a rectangle.
    pub fn dimension(&self) -> usize {
        if self.nodes[1] == 1 { 1 } else { 2 }
    }

    /// Nodes in each direction.
    pub fn nodes(&self) -> [usize; 2] {
        self.nodes
    }

    /// Lower and upper corner, in m.
    pub fn bounds(&self) -> (Point, Point) {
        (self.lower, self.upper)
    }

    /// Number of nodes.
    #[expect(clippy::len_without_is_empty, reason = "a grid has at least two nodes")]
    pub fn len(&self) -> usize {
        self.nodes[0] * self.nodes[1]
    }

    /// Distance between neighbours in each direction, in m; zero across an interval.
    pub fn spacing(&self) -> Point {
        [0, 1].map(|d| match self.nodes[d] {
            1 => 0.0,
            n => (self.upper[d] - self.lower[d]) / (n - 1) as f64,
        })
    }

    /// Position of node `k`, in m.
    pub fn point(&self, k: usize) -> Point {
        let index = [k % self.nodes[0], k / self.nodes[0]];
        [0, 1].map(|d| match self.nodes[d] {
            1 => self.lower[d],
            n => {
                let t = index[d] as f64 / (n - 1) as f64;
                self.lower[d] * (1.0 - t) + self.upper[d] * t
            }
        })
    }
}
