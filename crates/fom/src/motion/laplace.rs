//! Laplace's equation (25) with quadratic cells: which share of a body's motion each node takes.

use super::MotionError;
use super::zone::Tie;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Conj, Mat, Par, Side, Spec};
use lumley_fem::element::{Element, Q2, TriangleP2};
use lumley_fem::geometry::{Mapped, Tabulated};
use lumley_fem::quadrature::rule;
use lumley_fem::{PlanarMesh, Point};

/// Degree of the quadrature: exact for straight cells.
const DEGREE: usize = 4;

/// The problem `div(lambda grad h) = 0` on the free nodes, with h = 1 on one body and 0 on all else.
pub(super) struct Laplace<'a> {
    pub mesh: &'a PlanarMesh,
    pub ties: &'a [Tie],
    pub bodies: usize,
    /// lambda, given a point and the area of its cell over that of the mean cell.
    pub stiffness: &'a dyn Fn(Point, f64) -> f64,
}

/// The equations of the free nodes.
struct System {
    /// How many free nodes stand before each node: the number of a free one.
    numbers: Vec<usize>,
    free: usize,
    /// The upper triangle.
    matrix: Vec<Triplet<usize, usize, f64>>,
    /// A column for each body.
    load: Mat<f64>,
}

impl Laplace<'_> {
    /// h at the free nodes, in their order, a column for each body.
    pub fn solve(&self) -> Result<Mat<f64>, MotionError> {
        let System { free, matrix, load, .. } = self.assemble();
        if free == 0 {
            return Ok(load);
        }
        let matrix = SparseColMat::try_new_from_triplets(free, free, &matrix)
            .map_err(|_| MotionError::Memory { unknowns: free })?;
        solve(&matrix, load)
    }

    fn assemble(&self) -> System {
        let mut free = 0;
        let count = |tie: &Tie| {
            let before = free;
            free += usize::from(*tie == Tie::Free);
            before
        };
        let numbers = self.ties.iter().map(count).collect();
        let load = Mat::zeros(free, self.bodies);
        let mut system = System { numbers, free, matrix: Vec::new(), load };
        let topology = self.mesh.topology();
        let area: f64 = self.mesh.cell_qualities().iter().map(|cell| cell.area).sum();
        let mean = area / topology.cells() as f64;
        self.add_cells(&TriangleP2, topology.triangles(), mean, &mut system);
        self.add_cells(&Q2, topology.quadrilaterals(), mean, &mut system);
        system
    }

    fn add_cells<const N: usize>(
        &self,
        element: &dyn Element,
        cells: &[[usize; N]],
        mean_area: f64,
        system: &mut System,
    ) {
        let rule: Vec<Tabulated<N>> = Tabulated::on(element, &rule(element.layout().cell, DEGREE));
        for cell in cells {
            let ties = cell.map(|node| self.ties[node]);
            if ties.contains(&Tie::Free) {
                system.add(cell, &ties, &self.cell_matrix(cell, &rule, mean_area));
            }
        }
    }

    /// `∫ lambda grad(phi_i)·grad(phi_j)` on a cell.
    fn cell_matrix<const N: usize>(
        &self,
        cell: &[usize; N],
        rule: &[Tabulated<N>],
        mean_area: f64,
    ) -> [[f64; N]; N] {
        let nodes = cell.map(|node| self.mesh.nodes()[node]);
        let mapped = || rule.iter().map(|at| (Mapped::new(&nodes, at), at));
        let relative = mapped().map(|(m, _)| m.weight).sum::<f64>() / mean_area;
        let mut matrix = [[0.0; N]; N];
        for (mapped, at) in mapped() {
            let lambda = (self.stiffness)(mapped.point, relative);
            let gradients = mapped.gradients(&at.dphi);
            for (row, a) in matrix.iter_mut().zip(gradients) {
                for (entry, b) in row.iter_mut().zip(gradients) {
                    *entry += lambda * mapped.weight * (a[0] * b[0] + a[1] * b[1]);
                }
            }
        }
        matrix
    }
}

impl System {
    /// Rows of free nodes: columns of free nodes to the matrix, of bodies to their loads.
    fn add<const N: usize>(&mut self, cell: &[usize; N], ties: &[Tie; N], matrix: &[[f64; N]; N]) {
        let numbers = cell.map(|node| self.numbers[node]);
        for (i, row) in (0..N).filter(|&i| ties[i] == Tie::Free).map(|i| (numbers[i], &matrix[i])) {
            for ((&j, tie), &value) in numbers.iter().zip(ties).zip(row) {
                match *tie {
                    Tie::Free if i <= j => self.matrix.push(Triplet::new(i, j, value)),
                    Tie::Body(body) => self.load[(i, body)] -= value,
                    _ => {}
                }
            }
        }
    }
}

/// By sparse Cholesky on one thread: the same bits on every number of threads.
fn solve(matrix: &SparseColMat<usize, f64>, mut x: Mat<f64>) -> Result<Mat<f64>, MotionError> {
    let memory = || MotionError::Memory { unknowns: matrix.nrows() };
    let (order, params) = (SymmetricOrdering::Amd, CholeskySymbolicParams::default());
    let pattern = matrix.symbolic();
    let symbolic =
        factorize_symbolic_cholesky(pattern, Side::Upper, order, params).map_err(|_| memory())?;
    let scratch = symbolic
        .factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default())
        .or(symbolic.solve_in_place_scratch::<f64>(x.ncols(), Par::Seq));
    let mut buffer = MemBuffer::try_new(scratch).map_err(|_| memory())?;
    let stack = MemStack::new(&mut buffer);
    let mut values = vec![0.0; symbolic.len_val()];
    symbolic
        .factorize_numeric_llt(
            &mut values,
            matrix.as_ref(),
            Side::Upper,
            LltRegularization::default(),
            Par::Seq,
            stack,
            Spec::default(),
        )
        .map_err(|_| MotionError::Singular)?;
    LltRef::new(&symbolic, &values).solve_in_place_with_conj(Conj::No, x.as_mut(), Par::Seq, stack);
    if x.is_all_finite() { Ok(x) } else { Err(MotionError::Singular) }
}
