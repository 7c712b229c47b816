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

    /// Weights of the trapezoid rule at the nodes, in m or m²; their sum is the length or area.
    pub fn trapezoid_weights(&self) -> Vec<f64> {
        let [line, column] = self.trapezoid_factors();
        column.iter().flat_map(|wy| line.iter().map(move |wx| wx * wy)).collect()
    }

    /// The weights of the trapezoid rule along each direction, the fastest first, in m: those at the nodes are their
    /// products.
    ///
    /// ```
    /// use lumley_fem::UniformGrid;
    /// let [line, none] = UniformGrid::line(0.0, 1.0, 3).trapezoid_factors();
    /// assert_eq!((line, none), (vec![0.25, 0.5, 0.25], vec![1.0]));
    /// ```
    pub fn trapezoid_factors(&self) -> [Vec<f64>; 2] {
        [0, 1].map(|d| {
            let end = |k| if k == 0 || k == self.nodes[d] - 1 { 0.5 } else { 1.0 };
            match self.nodes[d] {
                1 => vec![1.0],
                n => (0..n).map(|k| end(k) * self.spacing()[d]).collect(),
            }
        })
    }

    /// The consistent mass matrix `∫ φ_i φ_j` of linear elements on an interval, bilinear ones on a
    /// rectangle, in m or m²: the Kronecker product of one tridiagonal matrix a direction, the fastest
    /// first, each as its diagonal and what stands beside it.
    ///
    /// ```
    /// use lumley_fem::UniformGrid;
    /// let [(diagonal, beside), none] = UniformGrid::line(0.0, 1.0, 3).mass_factors();
    /// assert_eq!((diagonal[0], beside[0]), (1.0 / 6.0, 1.0 / 12.0));
    /// assert_eq!(none, (vec![1.0], vec![]));
    /// ```
    pub fn mass_factors(&self) -> [(Vec<f64>, Vec<f64>); 2] {
        [0, 1].map(|d| line_mass(self.nodes[d], self.spacing()[d]))
    }
}

/// The mass matrix of linear elements of length `h`: its diagonal and what stands beside it. A single
/// node, the missing direction of an interval, has mass one.
fn line_mass(nodes: usize, h: f64) -> (Vec<f64>, Vec<f64>) {
    if nodes == 1 {
        return (vec![1.0], vec![]);
    }
    let cells = |k: usize| if k == 0 || k == nodes - 1 { 1.0 } else { 2.0 };
    ((0..nodes).map(|k| cells(k) * h / 3.0).collect(), vec![h / 6.0; nodes - 1])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grids() -> [UniformGrid; 2] {
        [UniformGrid::line(-0.2, 1.1, 14), UniformGrid::rectangle([0.5, -1.0], [2.0, 0.25], [5, 8])]
    }

    fn measure(grid: &UniformGrid) -> f64 {
        let (a, b) = grid.bounds();
        (0..grid.dimension()).map(|d| b[d] - a[d]).product()
    }

    #[test]
    fn nodes_fill_the_bounds() {
        for grid in grids() {
            let (a, b) = grid.bounds();
            assert_eq!(grid.point(0), a);
            assert_eq!(grid.point(grid.len() - 1), b);
            let step = grid.spacing()[0];
            assert!((grid.point(1)[0] - a[0] - step).abs() < 1e-15);
        }
    }

    #[test]
    fn trapezoid_integrates_linear_functions() {
        for grid in grids() {
            let weights = grid.trapezoid_weights();
            let (a, b) = grid.bounds();
            assert_eq!(weights.len(), grid.len());
            for d in 0..grid.dimension() {
                let sum: f64 = weights.iter().enumerate().map(|(k, w)| w * grid.point(k)[d]).sum();
                let exact = measure(&grid) * 0.5 * (a[d] + b[d]);
                assert!((sum - exact).abs() < 1e-14, "{sum} {exact}");
            }
        }
    }

    /// Entry (i, j) of the mass matrix.
    fn mass(grid: &UniformGrid, i: usize, j: usize) -> f64 {
        let entry =
            |(diagonal, beside): &(Vec<f64>, Vec<f64>), a: usize, b: usize| match b.abs_diff(a) {
                0 => diagonal[a],
                1 => beside[a.min(b)],
                _ => 0.0,
            };
        let ([line, column], nx) = (grid.mass_factors(), grid.nodes()[0]);
        entry(&line, i % nx, j % nx) * entry(&column, i / nx, j / nx)
    }

    /// `fᵀ M g = ∫ f g` for linear f and g.
    #[test]
    fn mass_matrix_integrates_products_of_linear_functions() {
        let rule = crate::quadrature::gauss_legendre(3);
        for grid in grids() {
            let n = grid.len();
            let (f, g) = (|p: Point| 1.0 + 2.0 * p[0] - p[1], |p: Point| 0.3 - p[0] + 0.7 * p[1]);
            let all = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
            let product: f64 =
                all.map(|(i, j)| f(grid.point(i)) * mass(&grid, i, j) * g(grid.point(j))).sum();
            let (a, b) = grid.bounds();
            let at = |s: f64, t: f64| [a[0] + s * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
            let mut exact = 0.0;
            for (s, ws) in &rule {
                for (t, wt) in &rule {
                    exact += measure(&grid) * ws * wt * f(at(*s, *t)) * g(at(*s, *t));
                }
            }
            assert!((product - exact).abs() < 1e-13, "{product} {exact}");
        }
    }

    #[test]
    fn mass_matrix_rows_sum_to_the_trapezoid_weights() {
        for grid in grids() {
            for (i, weight) in grid.trapezoid_weights().into_iter().enumerate() {
                let row: f64 = (0..grid.len()).map(|j| mass(&grid, i, j)).sum();
                assert!((row - weight).abs() < 1e-15, "row {i}: {row} {weight}");
            }
        }
    }
}
