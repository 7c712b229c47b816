//! What does not depend on threads, and what is read how.

mod common;

use common::{counted, products, random_matrix, seen, snapshots, times, with_singular_values};
use faer::{Mat, MatMut, Par};
use lumley_pod::{
    ALGORITHMS, APPROXIMATIONS, Identity, InnerProduct, MemorySnapshots, Options, PodError,
    ReducedBasis, SnapshotSource, Truncation, auto, method_of_snapshots, svd,
};
use std::io;
use std::ops::Range;

/// Many blocks of rows, the last one short.
const N: usize = 9001;

#[test]
fn threads_do_not_change_a_bit() {
    let sigma: Vec<f64> = (0..9).map(|k| 0.1_f64.powi(k)).collect();
    for (product, w) in products(N) {
        let x = MemorySnapshots::new(with_singular_values(&sigma, (N, 12), &*w, 7), times(12));
        for run in [auto, method_of_snapshots, svd] {
            let basis = |par| {
                let truncation = Truncation::Modes(6);
                let options = Options { truncation, center: true, par, ..Options::default() };
                run(&x, &*w, &options).expect("a decomposition")
            };
            let one = basis(Par::Seq);
            for threads in [2, 3, 5] {
                let many = basis(Par::rayon(threads));
                assert_eq!(one.modes, many.modes, "{}, {product}", one.algorithm);
                assert_eq!(one.spectrum, many.spectrum, "{}, {product}", one.algorithm);
                assert_eq!(one.coefficients, many.coefficients, "{}, {product}", one.algorithm);
            }
        }
    }
}

/// A source that is best read in large blocks: with less memory they are smaller, and the bits the same; so they
/// are where the snapshots are read in memory.
#[test]
fn memory_does_not_change_a_bit() {
    struct Large(MemorySnapshots);
    impl SnapshotSource for Large {
        fn dim(&self) -> usize {
            self.0.dim()
        }
        fn times(&self) -> &[f64] {
            self.0.times()
        }
        fn block(&self, r: Range<usize>, c: Range<usize>, out: MatMut<'_, f64>) -> io::Result<()> {
            self.0.block(r, c, out)
        }
        fn read_size(&self) -> usize {
            8 << 20
        }
    }
    let n = 60_001;
    let w = common::grid(n);
    let sigma: Vec<f64> = (0..9).map(|k| 0.1_f64.powi(k)).collect();
    let mut x = with_singular_values(&sigma, (n, 90), &w, 7);
    for (i, row) in x.row_iter_mut().enumerate() {
        row.iter_mut().for_each(|x| *x += (0.01 * i as f64).cos()); // a mean to be subtracted
    }
    let in_memory = MemorySnapshots::new(x, times(90));
    let in_blocks = Large(in_memory.clone());
    for algorithm in ALGORITHMS.iter().chain(APPROXIMATIONS).filter(|a| a.name != "direct") {
        for center in [false, true] {
            let basis = |x: &dyn SnapshotSource, memory_limit| {
                let truncation = Truncation::Modes(4);
                let options = Options { truncation, center, memory_limit, ..Options::default() };
                let options = Options { residuals: true, ..options };
                (algorithm.run)(x, &w, &options).expect("a decomposition")
            };
            let plenty = basis(&in_blocks, 1 << 32);
            for other in [basis(&in_blocks, 30 << 20), basis(&in_memory, 1 << 32)] {
                assert_eq!(plenty.modes, other.modes, "{}", algorithm.name);
                assert_eq!(plenty.decomposition, other.decomposition, "{}", algorithm.name);
            }
        }
    }
}

type Run = fn(&dyn SnapshotSource, &dyn InnerProduct, &Options) -> Result<ReducedBasis, PodError>;

/// Two passes in blocks, far from the whole, and a third for the exact route.
#[test]
fn snapshots_are_read_by_blocks() {
    let n = 60_000;
    let x = snapshots(random_matrix(n, 10, 3));
    for (run, passes) in [(method_of_snapshots as Run, 2), (svd, 3)] {
        for center in [false, true] {
            let options = Options { center, ..Options::default() };
            let (found, numbers, largest) = counted(&x, |x| run(x, &Identity::new(n), &options));
            found.expect("a decomposition");
            assert_eq!(numbers, passes * n * 10);
            assert!(largest <= n * 10 / 7);
        }
    }
}

/// Of few rows no sketch is taken, and the exact route is spared a pass where the columns are far from
/// dependent; less their mean they are not.
#[test]
fn a_sketch_is_taken_of_many_rows() {
    for (n, center, passes) in [(300, false, 2), (300, true, 3), (400, false, 3), (400, true, 3)] {
        let x = MemorySnapshots::new(random_matrix(n, 10, 3), times(10));
        let options = Options { center, ..Options::default() };
        let basis = svd(&x, &Identity::new(n), &options).expect("a decomposition");
        assert_eq!(basis.passes, passes, "{n} rows, centred: {center}");
    }
}

/// A medium that fails, or a block that fails, is an error of the decomposition.
#[test]
fn a_source_that_cannot_be_read_is_an_error() {
    let x = snapshots(Mat::ones(N, 3));
    let broken = seen(&x, |rows, _| match rows.end {
        N => Err(io::Error::other("block 7 is damaged")),
        _ => Ok(()),
    });
    for algorithm in &ALGORITHMS[..2] {
        for par in [Par::Seq, Par::rayon(2)] {
            let options = Options { par, ..Options::default() };
            let error = (algorithm.run)(&broken, &Identity::new(N), &options);
            let message = error.expect_err("the last block is damaged").to_string();
            assert_eq!(message, "block 7 is damaged");
        }
    }
}
