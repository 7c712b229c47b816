use crate::UniformGrid;

/// How far plane fields on a grid are from being free of divergence, by central differences.
///
/// At a node of the grid with spacings `h`,
///
/// ```text
/// u_x ≈ (u(x + h) − u(x − h))/(2 h),   |∇·u|² = (u_x + v_y)²,   |∇u|² = u_x² + u_y² + v_x² + v_y²
/// ```
///
/// second order where the field is smooth. Only nodes count whose four neighbours can be used, such as those that no
/// body covers: across a wall the differences mean nothing.
///
/// ```
/// use lumley_fem::{GridDivergence, UniformGrid};
/// let grid = UniformGrid::rectangle([0.0, 0.0], [1.0, 1.0], [5, 5]);
/// // u = (x, y): its divergence is 2, its gradient the identity.
/// let field: Vec<f64> = (0..2).flat_map(|d| (0..25).map(move |k| (d, k)))
///     .map(|(d, k)| grid.point(k)[d]).collect();
/// let squares = GridDivergence::new(&grid, |_| true).of(&field);
/// assert!((squares.divergence - 4.0 * 9.0).abs() < 1e-12, "at nine nodes inside");
/// assert!((squares.ratio().expect("a gradient") - 2.0_f64.sqrt()).abs() < 1e-14);
/// ```
#[derive(Debug, Clone)]
pub struct GridDivergence {
    /// Neighbours of the nodes that count: right, left, above, below.
    stencils: Vec<[usize; 4]>,
    /// Half of one over the spacing in each direction, in 1/m.
    factors: [f64; 2],
    nodes: usize,
}

/// Sums of squares over nodes of a grid: those of several fields can be added.
///
/// ```
/// let squares = lumley_fem::DivergenceSquares { divergence: 1.0, gradient: 4.0 };
/// assert_eq!(squares.plus(squares).ratio(), Some(0.5));
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct DivergenceSquares {
    /// Of the divergence, in the square of the field's unit over m².
    pub divergence: f64,
    /// Of the gradient, in the same unit.
    pub gradient: f64,
}

impl DivergenceSquares {
    /// Both sums together.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            divergence: self.divergence + other.divergence,
            gradient: self.gradient + other.gradient,
        }
    }

    /// `||∇·u|| / ||∇u||`, between 0 and √2; `None` of a field without gradient.
    pub fn ratio(&self) -> Option<f64> {
        (self.gradient > 0.0).then(|| (self.divergence / self.gradient).sqrt())
    }
}

impl GridDivergence {
    /// At the nodes within `grid` that can be used with all of their neighbours, which `is_usable` says of each
    /// node by its number.
    ///
    /// # Panics
    /// If the grid is one of an interval.
    pub fn new(grid: &UniformGrid, is_usable: impl Fn(usize) -> bool) -> Self {
        assert_eq!(grid.dimension(), 2, "dimension of the grid");
        let [columns, rows] = grid.nodes();
        let usable: Vec<bool> = (0..grid.len()).map(is_usable).collect();
        let inside = (1..rows - 1).flat_map(|row| (1..columns - 1).map(move |i| row * columns + i));
        let stencil = |node: usize| [node + 1, node - 1, node + columns, node - columns];
        let counts =
            |node: &usize| usable[*node] && stencil(*node).iter().all(|&beside| usable[beside]);
        Self {
            stencils: inside.filter(counts).map(stencil).collect(),
            factors: grid.spacing().map(|h| 0.5 / h),
            nodes: grid.len(),
        }
    }

    /// How many nodes count.
    pub fn nodes(&self) -> usize {
        self.stencils.len()
    }

    /// The sums of squares of a field: its x components at all nodes of the grid, then its y components.
    ///
    /// # Panics
    /// If the field has not two entries for each node.
    pub fn of(&self, field: &[f64]) -> DivergenceSquares {
        assert_eq!(field.len(), 2 * self.nodes, "two components at each node");
        let (u, v) = field.split_at(self.nodes);
        let [fx, fy] = self.factors;
        let mut sum = DivergenceSquares::default();
        for &[right, left, above, below] in &self.stencils {
            let [ux, vx] = [u, v].map(|f| fx * (f[right] - f[left]));
            let [uy, vy] = [u, v].map(|f| fy * (f[above] - f[below]));
            sum.divergence += (ux + vy) * (ux + vy);
            sum.gradient += ux * ux + uy * uy + vx * vx + vy * vy;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// u = (sin x cos y, −cos x sin y) is free of divergence, and so are its differences where the spacings are
    /// equal; where they are not, what is left falls with the square of the spacing.
    #[test]
    fn a_field_free_of_divergence_has_little() {
        let ratio = |nodes: [usize; 2]| {
            let grid = UniformGrid::rectangle([0.0; 2], [PI; 2], nodes);
            let points = || (0..grid.len()).map(|k| grid.point(k));
            let u = points().map(|[x, y]| x.sin() * y.cos());
            let field: Vec<f64> = u.chain(points().map(|[x, y]| -x.cos() * y.sin())).collect();
            GridDivergence::new(&grid, |_| true).of(&field).ratio().expect("a gradient")
        };
        assert!(ratio([21, 21]) < 1e-14);
        let order = (ratio([21, 41]) / ratio([41, 81])).log2();
        assert!((order - 2.0).abs() < 0.05, "order {order}");
    }

    /// A node that cannot be used takes itself and its four neighbours out.
    #[test]
    fn what_a_body_covers_does_not_count() {
        let grid = UniformGrid::rectangle([0.0; 2], [6.0, 4.0], [7, 5]);
        assert_eq!(GridDivergence::new(&grid, |_| true).nodes(), 15);
        let covered = 2 * 7 + 3;
        let around = GridDivergence::new(&grid, |node| node != covered);
        assert_eq!(around.nodes(), 10);
        let mut field = vec![0.0; 70];
        field[covered] = 1e9;
        assert_eq!(around.of(&field), DivergenceSquares::default());
        assert_eq!(around.of(&field).ratio(), None);
    }
}
