//! Modes on their way to disk: any order, many threads, many ranks, full disks.

mod archive;
#[cfg(target_os = "linux")]
mod faults;
mod ranks;

use faer::{Mat, MatRef};
use lumley::run::FileModes;
use lumley_pod::{Decomposition, Identity, MemorySnapshots, ModeStore, Options, svd};
use std::io;
use std::ops::Range;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Rows of the modes of these tests, more than are written at a time, and the rows of a block.
const ROWS: usize = 30_011;
const BLOCK: usize = 37;

fn modes() -> Mat<f64> {
    Mat::from_fn(ROWS, 3, |i, k| (0.001 * (i * (k + 1)) as f64).sin())
}

fn mean() -> Vec<f64> {
    (0..ROWS).map(|i| (0.01 * i as f64).cos()).collect()
}

/// What belongs to three modes of two snapshots.
fn decomposition() -> Decomposition {
    let x = Mat::from_fn(3, 2, |i, j| (1 + i + 3 * j) as f64);
    let source = MemorySnapshots::new(x, vec![0.0, 0.5]);
    let basis = svd(&source, &Identity::new(3), &Options::default());
    basis.expect("two snapshots").decomposition
}

/// The blocks of some rows, in disorder.
fn blocks(rows: Range<usize>) -> Vec<Range<usize>> {
    let mut blocks: Vec<_> =
        rows.clone().step_by(BLOCK).map(|first| first..rows.end.min(first + BLOCK)).collect();
    let mut seed = 5_usize;
    for k in (1..blocks.len()).rev() {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        blocks.swap(k, (seed >> 33) % (k + 1));
    }
    blocks
}

/// Rows of `x`.
fn rows_of<'a>(x: &'a Mat<f64>, rows: &Range<usize>) -> MatRef<'a, f64> {
    x.subrows(rows.start, rows.len())
}

/// Publishes some rows, block by block.
fn publish(store: &FileModes, rows: Range<usize>) -> io::Result<()> {
    let (modes, mean) = (modes(), mean());
    blocks(rows)
        .into_iter()
        .try_for_each(|rows| store.publish(rows.clone(), rows_of(&modes, &rows), Some(&mean[rows])))
}
