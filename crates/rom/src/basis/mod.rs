//! The modes that a reduced model is built on.

mod check;

use crate::ReducedError;
use faer::MatRef;
use lumley_fem::element::{Element, P1, P2};
use lumley_fem::quadrature::gauss_legendre;
use lumley_fem::{LineMesh, UniformGrid};

/// POD modes with the nodes they are given at.
///
/// ```text
/// v_N = Φ_0 + sum_n a_n Φ_n,   (Φ_i, Φ_j) = δ_ij in L2        (6)
/// ```
///
/// Modes are finite element functions on a line, N columns of nodal values from left to right. The mean
/// field `Φ_0` of a centred POD is optional: it is a leading function whose coefficient is frozen at one.
///
/// ```
/// use lumley_rom::Basis;
/// // One mode, sqrt(30) ξ (1 − ξ), on a single cell of degree 2.
/// let modes = faer::mat![[0.0], [30_f64.sqrt() / 4.0], [0.0]];
/// let basis = Basis::on_reference(&[0.0, 0.5, 1.0], 2, modes.as_ref(), None)?;
/// let a = basis.project(&[0.0, 0.5, 0.0])?; // 2 ξ (1 − ξ)
/// assert!((a[0] - 2.0 / 30_f64.sqrt()).abs() < 1e-15);
/// # Ok::<(), lumley_rom::ReducedError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Basis {
    frame: Frame,
    mesh: LineMesh,
    /// Number in the mesh of each node from left to right.
    order: Vec<usize>,
    /// Coordinates of the nodes of the mesh.
    nodes: Vec<f64>,
    /// Values of all functions, those at a node together, the mean first.
    values: Vec<f64>,
    /// Mass matrix times `values`: `(Φ_n, f)` is its column n times the nodal values of f.
    dual: Vec<f64>,
    width: usize,
    frozen: usize,
}

/// What the coordinate of the nodes means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Frame {
    /// x on the fixed domain (0, L), in m.
    Grid,
    /// ξ = x/X on (0, 1), in the fluid.
    Reference,
}

impl Basis {
    /// Modes of the global velocity on a fixed grid of (0, L), finite elements of degree 1.
    ///
    /// * `modes`: nodal values, `grid.len()` x N, orthonormal in the P1 mass matrix
    /// * `mean`: the mean that a centred POD took away, in m/s
    ///
    /// # Errors
    /// A grid that is not a line from 0, wrong lengths, values that are not finite, modes that
    /// are not orthonormal.
    pub fn on_grid(
        grid: &UniformGrid,
        modes: MatRef<'_, f64>,
        mean: Option<&[f64]>,
    ) -> Result<Self, ReducedError> {
        let (lower, upper) = grid.bounds();
        if grid.dimension() != 1 || lower[0] != 0.0 {
            return Err(ReducedError::Grid {
                lower: lower[0],
                upper: upper[0],
                dimension: grid.dimension(),
                expected: "a line that starts at 0",
            });
        }
        let nodes: Vec<f64> = (0..grid.len()).map(|k| grid.point(k)[0]).collect();
        Self::new(Frame::Grid, &P1, &nodes, modes, mean)
    }

    /// Modes of `u − X' ξ` on the reference frame (0, 1) of the fluid, which vanish at both ends.
    ///
    /// * `nodes`: places ξ of all nodes from left to right; with degree 2, middle nodes in between
    /// * `degree`: of the finite elements, 1 or 2
    /// * `modes`: nodal values, `nodes.len()` x N, orthonormal in the mass matrix on (0, 1)
    /// * `mean`: the mean of `u − X' ξ` that a centred POD took away, in m/s
    ///
    /// # Errors
    /// Nodes that are not those of such elements, wrong lengths, values that are not finite,
    /// modes that are not orthonormal or do not vanish at the ends.
    pub fn on_reference(
        nodes: &[f64],
        degree: usize,
        modes: MatRef<'_, f64>,
        mean: Option<&[f64]>,
    ) -> Result<Self, ReducedError> {
        check::reference_nodes(nodes, degree)?;
        let element: &dyn Element = if degree == 1 { &P1 } else { &P2 };
        let basis = Self::new(Frame::Reference, element, nodes, modes, mean)?;
        check::homogeneous(&basis)?;
        Ok(basis)
    }

    fn new(
        frame: Frame,
        element: &'static dyn Element,
        nodes: &[f64],
        modes: MatRef<'_, f64>,
        mean: Option<&[f64]>,
    ) -> Result<Self, ReducedError> {
        if modes.ncols() == 0 {
            return Err(ReducedError::NoModes);
        }
        check::field("a mode", nodes.len(), modes.nrows(), |k| modes.row(k).iter().copied())?;
        if let Some(mean) = mean {
            check::field("the mean", nodes.len(), mean.len(), |k| [mean[k]].into_iter())?;
        }
        let mesh = LineMesh::new((nodes.len() - 1) / element.degree(), element);
        let frozen = usize::from(mean.is_some());
        let width = modes.ncols() + frozen;
        let mut basis = Self {
            frame,
            mesh,
            order: mesh.left_to_right().collect(),
            nodes: vec![0.0; nodes.len()],
            values: vec![0.0; nodes.len() * width],
            dual: vec![0.0; nodes.len() * width],
            width,
            frozen,
        };
        for (k, &node) in basis.order.iter().enumerate() {
            basis.nodes[node] = nodes[k];
            let values = mean.map(|f| f[k]).into_iter().chain(modes.row(k).iter().copied());
            for (value, f) in basis.values[node * width..].iter_mut().zip(values) {
                *value = f;
            }
        }
        basis.apply_mass();
        check::orthonormal(&basis)?;
        Ok(basis)
    }

    /// Number N of modes, the mean apart.
    pub fn modes(&self) -> usize {
        self.width - self.frozen
    }

    /// Coefficients `a_n = (v − Φ_0, Φ_n)` of a field given at the nodes from left to right, (7): its
    /// best approximation in L2. In the reference frame the field is `u − X' ξ`.
    ///
    /// # Errors
    /// A wrong number of values, or one that is not finite.
    pub fn project(&self, field: &[f64]) -> Result<Vec<f64>, ReducedError> {
        check::field("the field", self.nodes.len(), field.len(), |k| [field[k]].into_iter())?;
        let mut a = vec![0.0; self.width];
        for (&node, v) in self.order.iter().zip(field) {
            let mean: f64 = self.row(node)[..self.frozen].iter().sum();
            for (a, d) in a.iter_mut().zip(self.dual_row(node)) {
                *a += d * (v - mean);
            }
        }
        Ok(a.split_off(self.frozen))
    }

    /// Norm of the mean in L2; zero without one.
    pub(crate) fn mean_norm(&self) -> f64 {
        let square = |k| dot(&self.row(k)[..self.frozen], &self.dual_row(k)[..self.frozen]);
        (0..self.nodes.len()).map(square).sum::<f64>().sqrt()
    }

    pub(crate) fn frame(&self) -> Frame {
        self.frame
    }

    /// Coordinates of the nodes, vertices first.
    pub(crate) fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// Where the last node lies: L in m on a grid, 1 in the reference frame.
    pub(crate) fn extent(&self) -> f64 {
        self.nodes[self.mesh.cells()]
    }

    /// Number of functions, the mean included; it comes first.
    pub(crate) fn width(&self) -> usize {
        self.width
    }

    /// 1 with a mean, 0 without: how many leading coefficients are constant.
    pub(crate) fn frozen(&self) -> usize {
        self.frozen
    }

    /// Values of all functions at node `k` of the mesh.
    pub(crate) fn row(&self, k: usize) -> &[f64] {
        &self.values[k * self.width..][..self.width]
    }

    /// Mass matrix times all functions, its row `k`.
    pub(crate) fn dual_row(&self, k: usize) -> &[f64] {
        &self.dual[k * self.width..][..self.width]
    }

    /// `sum_n a_n Φ_n` at `x`, with a coefficient for the mean; at an end for an `x` beyond it.
    pub(crate) fn evaluate(&self, x: f64, a: &[f64]) -> f64 {
        let inside = x.clamp(self.nodes[0], self.extent());
        let (cell, s) = self.mesh.locate(&self.nodes, inside).expect("clamped to the mesh");
        let (phi, _) = self.shape(s);
        self.mesh.cell_nodes(cell).zip(phi).map(|(k, f)| f * dot(self.row(k), a)).sum()
    }

    /// Calls `visit(weight, values, slopes)` at the points of a quadrature that is exact for
    /// products of three functions and for two with one slope.
    pub(crate) fn integrate(&self, mut visit: impl FnMut(f64, &[f64], &[f64])) {
        let (mut value, mut slope) = (vec![0.0; self.width], vec![0.0; self.width]);
        for (cell, s, weight) in self.points() {
            let size = self.nodes[cell + 1] - self.nodes[cell];
            let (phi, dphi) = self.shape(s);
            value.fill(0.0);
            slope.fill(0.0);
            for (i, k) in self.mesh.cell_nodes(cell).enumerate() {
                for (n, f) in self.row(k).iter().enumerate() {
                    value[n] += phi[i] * f;
                    slope[n] += dphi[i] / size * f;
                }
            }
            visit(weight * size, &value, &slope);
        }
    }

    fn apply_mass(&mut self) {
        let n = self.width;
        for (row, column, mass) in self.mesh.mass_matrix(&self.nodes) {
            let (dual, values) = (&mut self.dual[row * n..], &self.values[column * n..]);
            dual.iter_mut().zip(&values[..n]).for_each(|(d, v)| *d += mass * v);
        }
    }

    /// Quadrature points of all cells, exact to degree 3 p − 1: cell, place in it, weight.
    fn points(&self) -> impl Iterator<Item = (usize, f64, f64)> + use<> {
        let rule = gauss_legendre((3 * self.mesh.element().degree()).div_ceil(2));
        let of_cell = move |cell| rule.clone().into_iter().map(move |(s, w)| (cell, s, w));
        (0..self.mesh.cells()).flat_map(of_cell)
    }

    /// Values and slopes of the element's functions at `s` in (0, 1); unused entries are zero.
    fn shape(&self, s: f64) -> ([f64; 3], [f64; 3]) {
        let element = self.mesh.element();
        let (mut phi, mut gradient) = ([0.0; 3], [[0.0; 2]; 3]);
        let count = element.nodes().len();
        element.tabulate([s, 0.0], &mut phi[..count], &mut gradient[..count]);
        (phi, gradient.map(|g| g[0]))
    }
}

/// Euclidean norm.
pub(crate) fn norm(x: &[f64]) -> f64 {
    dot(x, x).sqrt()
}

/// Euclidean product.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
