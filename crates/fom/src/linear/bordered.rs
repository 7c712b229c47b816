/// What one cell of a line adds to the matrix: its two vertices and the bordering unknown.
///
/// ```
/// use lumley_fom::linear::CellMatrix;
/// let stiffness = CellMatrix { vertex: [[1.0, -1.0], [-1.0, 1.0]], border: [0.0, 0.0] };
/// assert_eq!(stiffness.vertex[0].iter().sum::<f64>(), 0.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CellMatrix {
    /// Rows and columns of the left and the right vertex.
    pub vertex: [[f64; 2]; 2],
    /// The column of the bordering unknown.
    pub border: [f64; 2],
}

/// The row of the bordering unknown, which knows the last vertex unknown only.
///
/// ```
/// use lumley_fom::linear::BorderRow;
/// let alone = BorderRow { neighbour: 0.0, diagonal: 2.0, residual: 1.0 };
/// assert_eq!(-alone.residual / alone.diagonal, -0.5);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BorderRow {
    /// Entry in the column of the last vertex unknown.
    pub neighbour: f64,
    /// Entry on the diagonal.
    pub diagonal: f64,
    /// Residual of the row.
    pub residual: f64,
}

/// A tridiagonal system, cell by cell, with one bordering row and column: `A δ = −r`.
///
/// A line of n cells has the vertices 0..=n. Vertex 0 is held, vertex n is the bordering unknown V (its
/// coupling to vertex n−1 stands in the last cell's matrix), the others are unknowns:
///
/// ```text
/// A_(i,i−1) δ_(i−1) + A_ii δ_i + A_(i,i+1) δ_(i+1) + b_i δV = −r_i,   i = 1..n−1
/// neighbour δ_(n−1) + diagonal δV = −residual
/// ```
///
/// Elimination without pivoting, V last: one factorisation, two right-hand sides forward, one
/// backward, linear in n. That is stable for matrices with a positive definite symmetric part that
/// dominates, such as mass and viscosity in a step of moderate length.
///
/// ```
/// use lumley_fom::linear::{BorderRow, BorderedTridiagonal, CellMatrix};
/// // −u'' = 1 on (0, 1), u(0) = 0, and the end is free: u = x − x²/2.
/// let (n, h) = (4, 0.25);
/// let mut system = BorderedTridiagonal::new(n);
/// let stiffness = CellMatrix { vertex: [[1.0 / h, -1.0 / h], [-1.0 / h, 1.0 / h]], border: [0.0; 2] };
/// system.matrices.fill(stiffness);
/// system.residuals.fill([-h / 2.0; 2]);
/// system.solve(BorderRow { neighbour: -1.0 / h, diagonal: 1.0 / h, residual: -h / 2.0 });
/// assert!((system.solution()[2] - 0.375).abs() < 1e-15);
/// assert!((system.solution()[n] - 0.5).abs() < 1e-15);
/// ```
#[derive(Debug, Clone)]
pub struct BorderedTridiagonal {
    /// What each cell adds to the matrix.
    pub matrices: Vec<CellMatrix>,
    /// What each cell adds to the residual r at its left and its right vertex.
    pub residuals: Vec<[f64; 2]>,
    rows: Vec<EliminatedRow>,
    solution: Vec<f64>,
}

/// A row after elimination, divided by its pivot.
#[derive(Debug, Clone, Copy, Default)]
struct EliminatedRow {
    next: f64,
    border: f64,
    residual: f64,
}

impl BorderedTridiagonal {
    /// Room for a line of `cells` cells.
    ///
    /// # Panics
    /// If there are fewer than two cells: there is no unknown then but the bordering one.
    pub fn new(cells: usize) -> Self {
        assert!(cells >= 2, "a bordered tridiagonal system needs two cells");
        Self {
            matrices: vec![CellMatrix::default(); cells],
            residuals: vec![[0.0; 2]; cells],
            rows: vec![EliminatedRow::default(); cells],
            solution: vec![0.0; cells + 1],
        }
    }

    /// The last solution δ at the vertices 0..=n; the first is zero, the last is δV.
    pub fn solution(&self) -> &[f64] {
        &self.solution
    }

    /// Solves with this row of the bordering unknown. A pivot of zero leaves values that are not
    /// finite in the [`solution`](Self::solution).
    pub fn solve(&mut self, row: BorderRow) {
        let n = self.matrices.len();
        self.eliminate();
        let last = self.rows[n - 1];
        // The last vertex unknown meets V in its cell, too.
        let coupling = last.border + last.next;
        let pivot = row.diagonal - row.neighbour * coupling;
        let border = -(row.residual - row.neighbour * last.residual) / pivot;
        self.rows[n - 1].next = 0.0;
        self.rows[n - 1].border = coupling;
        self.substitute(border);
    }

    fn eliminate(&mut self) {
        // The recurrence of the pivots is the critical path. Its quotient does not wait for the
        // reciprocal that scales the row: a division and a subtraction for each cell.
        let (mut pivot, mut lower_upper) = (1.0, 0.0);
        let mut above = EliminatedRow::default();
        let cells = self.matrices.windows(2).zip(self.residuals.windows(2));
        for (row, (matrix, residual)) in self.rows[1..].iter_mut().zip(cells) {
            let ([left, right], [r_left, r_right]) =
                ([&matrix[0], &matrix[1]], [residual[0], residual[1]]);
            pivot = left.vertex[1][1] + right.vertex[0][0] - lower_upper / pivot;
            let (lower, upper) = (left.vertex[1][0], right.vertex[0][1]);
            lower_upper = right.vertex[1][0] * upper;
            let scale = 1.0 / pivot;
            let border = left.border[1] + right.border[0] - lower * above.border;
            let residual = r_left[1] + r_right[0] - lower * above.residual;
            above = EliminatedRow {
                next: upper * scale,
                border: border * scale,
                residual: residual * scale,
            };
            *row = above;
        }
    }

    fn substitute(&mut self, border: f64) {
        let n = self.rows.len();
        self.solution[n] = border;
        let mut next = border;
        for (delta, row) in self.solution[1..n].iter_mut().zip(&self.rows[1..]).rev() {
            next = -(row.residual + row.border * border) - row.next * next;
            *delta = next;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The residual of the whole system at the solution, for entries without any symmetry.
    #[test]
    fn solution_satisfies_every_row() {
        let noise = |k: usize| (k as f64 * 0.754_877_666).fract() - 0.5;
        for n in [2, 3, 40] {
            let mut system = BorderedTridiagonal::new(n);
            for c in 0..n {
                let entry = |k: usize| noise(9 * c + k);
                let vertex = [[2.0 + entry(1), entry(2)], [entry(3), 2.0 + entry(4)]];
                system.matrices[c] = CellMatrix { vertex, border: [entry(5), entry(6)] };
                system.residuals[c] = [entry(7), entry(8)];
            }
            let row = BorderRow { neighbour: 0.7, diagonal: -3.0, residual: 0.2 };
            system.solve(row);
            let delta = system.solution();
            assert_eq!((delta.len(), delta[0]), (n + 1, 0.0));
            for i in 1..n {
                let [left, right] = [&system.matrices[i - 1], &system.matrices[i]];
                let tridiagonal = left.vertex[1][0] * delta[i - 1]
                    + (left.vertex[1][1] + right.vertex[0][0]) * delta[i]
                    + right.vertex[0][1] * delta[i + 1];
                let border = (left.border[1] + right.border[0]) * delta[n];
                let residual = system.residuals[i - 1][1] + system.residuals[i][0];
                let sum = tridiagonal + border + residual;
                assert!(sum.abs() < 1e-14, "n = {n}, row {i}: {sum:e}");
            }
            let last = row.neighbour * delta[n - 1] + row.diagonal * delta[n] + row.residual;
            assert!(last.abs() < 1e-14, "n = {n}: {last:e}");
        }
    }
}
