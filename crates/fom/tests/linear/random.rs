//! Random patterns of cells with random matrices.

use crate::oseen::noise;
use faer::Par;
use faer::prelude::Solve;
use faer::sparse::{SparseColMat, Triplet};
use lumley_fom::linear::{Analysis, CellUnknowns, DelayedUnknowns, Multifrontal, Scalar};

/// Cells scattered over a square; each unknown belongs to the cells that are nearest to it.
struct Scattered {
    cells: CellUnknowns,
    centroids: Vec<[f64; 2]>,
}

impl Scattered {
    fn new(count: usize, cells: usize, seed: usize) -> Self {
        let numbers = noise(2 * (count + cells) + seed);
        let point = |k: usize| [numbers[seed + 2 * k], numbers[seed + 2 * k + 1]];
        let centroids: Vec<_> = (0..cells).map(point).collect();
        let mut lists = vec![Vec::new(); cells];
        for unknown in 0..count {
            let [x, y] = point(cells + unknown);
            let distance = |c: usize| (centroids[c][0] - x).hypot(centroids[c][1] - y);
            let mut nearest: Vec<usize> = (0..cells).collect();
            nearest.sort_by(|&a, &b| distance(a).total_cmp(&distance(b)));
            for &cell in &nearest[..=unknown % 4.min(cells)] {
                lists[cell].push(unknown);
            }
        }
        let cells = CellUnknowns::new(count, &lists).expect("every unknown has a cell");
        Self { cells, centroids }
    }

    fn analysis(&self) -> std::sync::Arc<Analysis> {
        Analysis::new(self.cells.clone(), &self.centroids, &DelayedUnknowns::default())
    }

    /// Entries between −1/2 and 1/2, and `diagonal` on the diagonal of each cell.
    fn matrices(&self, diagonal: f64) -> Vec<f64> {
        let mut matrices = noise(self.cells.matrix_len());
        for cell in 0..self.cells.cells() {
            let size = self.cells.of(cell).len();
            for k in 0..size {
                matrices[self.cells.matrix(cell).start + k * (size + 1)] += diagonal;
            }
        }
        matrices
    }

    /// The solution by faer's sparse LU of the assembled matrix.
    fn reference(&self, matrices: &[f64], b: &[f64]) -> Vec<f64> {
        let mut triplets = Vec::new();
        for cell in 0..self.cells.cells() {
            let unknowns = self.cells.of(cell);
            let matrix = &matrices[self.cells.matrix(cell)];
            for (column, &j) in matrix.chunks_exact(unknowns.len()).zip(unknowns) {
                triplets.extend(
                    unknowns
                        .iter()
                        .zip(column)
                        .map(|(&i, &a)| Triplet::new(i as usize, j as usize, a)),
                );
            }
        }
        let n = self.cells.count();
        let matrix = SparseColMat::<usize, f64>::try_new_from_triplets(n, n, &triplets);
        let lu = matrix.expect("sound triplets").sp_lu().expect("a regular matrix");
        let x = lu.solve(faer::Col::from_fn(n, |i| b[i]));
        (0..n).map(|i| x[i]).collect()
    }
}

fn largest_difference(x: &[f64], y: &[f64]) -> f64 {
    let size = y.iter().fold(0.0, |m: f64, y| m.max(y.abs()));
    x.iter().zip(y).fold(0.0, |m: f64, (x, y)| m.max((x - y).abs())) / size
}

fn solve<T: Scalar>(scattered: &Scattered, matrices: &[f64], b: &[f64]) -> Vec<f64> {
    let mut lu = Multifrontal::<T>::new(scattered.analysis(), Par::Seq);
    lu.factorise(matrices).expect("a regular matrix");
    let mut x = b.to_vec();
    lu.solve(&mut x);
    x
}

#[test]
fn solutions_are_those_of_the_assembled_matrix() {
    for (count, cells) in [(1, 1), (7, 1), (30, 2), (50, 9), (400, 60), (3000, 150)] {
        for seed in [0, 17, 40] {
            let scattered = Scattered::new(count, cells, seed);
            let b = noise(count);
            for (diagonal, tolerance) in [(8.0, 1e-13), (0.0, 1e-7)] {
                let matrices = scattered.matrices(diagonal);
                let difference = largest_difference(
                    &solve::<f64>(&scattered, &matrices, &b),
                    &scattered.reference(&matrices, &b),
                );
                assert!(
                    difference < tolerance,
                    "{count} unknowns, {cells} cells, diagonal {diagonal}: {difference:e}"
                );
            }
        }
    }
}

#[test]
fn single_precision_is_single() {
    let scattered = Scattered::new(800, 60, 3);
    let (matrices, b) = (scattered.matrices(8.0), noise(800));
    let exact = scattered.reference(&matrices, &b);
    let difference = largest_difference(&solve::<f32>(&scattered, &matrices, &b), &exact);
    assert!((1e-9..1e-5).contains(&difference), "{difference:e}");
}

#[test]
fn several_right_hand_sides_are_solved_as_one_by_one() {
    let scattered = Scattered::new(300, 40, 1);
    let mut lu = Multifrontal::<f64>::new(scattered.analysis(), Par::Seq);
    lu.factorise(&scattered.matrices(8.0)).expect("a regular matrix");
    let mut together = noise(3 * 300);
    let mut apart = together.clone();
    lu.solve(&mut together);
    apart.chunks_exact_mut(300).for_each(|x| lu.solve(x));
    assert_eq!(together, apart);
}

#[test]
fn bits_do_not_depend_on_threads() {
    let scattered = Scattered::new(3000, 300, 5);
    let matrices = scattered.matrices(8.0);
    let [one, two] = [Par::Seq, Par::rayon(2)].map(|par| {
        let mut lu = Multifrontal::<f64>::new(scattered.analysis(), par);
        let mut x = noise(3000);
        for _ in 0..3 {
            lu.factorise(&matrices).expect("a regular matrix");
            lu.solve(&mut x);
        }
        x
    });
    assert_eq!(one, two);
}

#[test]
fn products_are_those_of_the_cells() {
    let scattered = Scattered::new(200, 3, 0);
    assert!(scattered.cells.of(0).len() > 40, "longer than the blocks of the product");
    let (matrices, x) = (scattered.matrices(0.0), noise(200));
    let mut y = vec![0.0; 200];
    scattered.cells.multiply(&matrices, &x, &mut y);
    let mut expected = vec![0.0; 200];
    for cell in 0..3 {
        let unknowns = scattered.cells.of(cell);
        let matrix = &matrices[scattered.cells.matrix(cell)];
        for (column, &j) in matrix.chunks_exact(unknowns.len()).zip(unknowns) {
            for (&i, a) in unknowns.iter().zip(column) {
                expected[i as usize] += a * x[j as usize];
            }
        }
    }
    assert!(largest_difference(&y, &expected) < 1e-14);
}

/// Products go by strips of rows, and the last columns of the last cell must not be read beyond their end.
#[test]
fn cells_of_every_size_are_multiplied() {
    for size in 1..=70 {
        let cells = [(0..size).collect::<Vec<_>>(), (0..size).rev().collect()];
        let cells = CellUnknowns::new(size, &cells).expect("a sound numbering");
        let (matrices, x) = (noise(cells.matrix_len()), noise(size));
        let mut y = vec![0.0; size];
        cells.multiply(&matrices, &x, &mut y);
        let mut expected = vec![0.0; size];
        for cell in 0..2 {
            for (k, a) in matrices[cells.matrix(cell)].iter().enumerate() {
                let [row, column] = [k % size, k / size].map(|k| cells.of(cell)[k] as usize);
                expected[row] += a * x[column];
            }
        }
        assert!(largest_difference(&y, &expected) < 1e-13, "{size} unknowns");
    }
}

/// Fronts without room behind them, whose blocks end within a vector register and are inverted or factorised.
#[test]
fn blocks_of_every_size_are_eliminated() {
    for count in 1..=70 {
        let scattered = Scattered::new(count, 1, count);
        let (matrices, b) = (scattered.matrices(8.0), noise(count));
        let exact = scattered.reference(&matrices, &b);
        let double = largest_difference(&solve::<f64>(&scattered, &matrices, &b), &exact);
        let single = largest_difference(&solve::<f32>(&scattered, &matrices, &b), &exact);
        assert!(double < 1e-13 && single < 1e-4, "{count} unknowns: {double:e}, {single:e}");
    }
}
