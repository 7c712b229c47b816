//! Passes over the snapshots are counted, told to those who watch, and read in bounded pieces.

mod common;

use common::{h1, random_matrix, times};
use faer::MatMut;
use lumley_pod::{
    ALGORITHMS, APPROXIMATIONS, Algorithm, Decomposition, Execution, Identity, InnerProduct,
    MemoryModes, MemorySnapshots, Options, Pass, SnapshotSource, Truncation, Watch, direct,
    projection_residuals,
};
use std::cell::RefCell;
use std::io;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Counts the numbers that are read, and the most of them at once.
struct Counting {
    x: MemorySnapshots,
    numbers: AtomicUsize,
    largest: AtomicUsize,
}

impl Counting {
    fn new(rows: usize, snapshots: usize) -> Self {
        let x = MemorySnapshots::new(random_matrix(rows, snapshots, 3), times(snapshots));
        Self { x, numbers: AtomicUsize::new(0), largest: AtomicUsize::new(0) }
    }
}

impl SnapshotSource for Counting {
    fn dim(&self) -> usize {
        self.x.dim()
    }

    fn times(&self) -> &[f64] {
        self.x.times()
    }

    fn block(
        &self,
        rows: Range<usize>,
        cols: Range<usize>,
        out: MatMut<'_, f64>,
    ) -> io::Result<()> {
        let size = rows.len() * cols.len();
        self.numbers.fetch_add(size, Ordering::Relaxed);
        self.largest.fetch_max(size, Ordering::Relaxed);
        self.x.block(rows, cols, out)
    }
}

/// Numbers of the passes over the snapshots that began, and how many rows of the last are done.
#[derive(Default)]
struct Told(RefCell<(Vec<usize>, usize)>);

impl Watch for Told {
    fn begin(&self, pass: &Pass, rows: usize) {
        if pass.over_snapshots {
            self.0.borrow_mut().0.push(pass.number);
            self.0.borrow_mut().1 = rows;
        }
    }

    fn advance(&self, pass: &Pass, rows: usize) {
        assert!(rows <= pass.rows, "{rows} of {}", pass.rows);
        if pass.over_snapshots {
            assert!(rows >= self.0.borrow().1, "{rows}");
            self.0.borrow_mut().1 = rows;
        }
    }
}

/// The decomposition, what was read in passes, and what was told.
fn watched(
    algorithm: &Algorithm,
    [rows, snapshots]: [usize; 2],
    w: &dyn InnerProduct,
    options: &Options,
) -> (Decomposition, usize, Vec<usize>) {
    let (x, told, modes) =
        (Counting::new(rows, snapshots), Told::default(), MemoryModes::default());
    let execution = Execution { watch: &told, ..Execution::default() };
    let found = (algorithm.stream)(&x, w, options, execution, &modes).expect("a decomposition");
    let (numbers, (passes, done)) = (x.numbers.into_inner(), told.0.into_inner());
    assert_eq!((numbers % (rows * snapshots), done), (0, rows), "{}", algorithm.name);
    (found, numbers / (rows * snapshots), passes)
}

#[test]
fn passes_are_those_that_were_made_and_told() {
    for center in [false, true] {
        let truncation = Truncation::Modes(3);
        let options = Options { truncation, center, residuals: true, ..Options::default() };
        let all = ALGORITHMS.iter().chain(APPROXIMATIONS);
        for algorithm in all.filter(|a| a.name != "incremental") {
            let (found, read, told) = watched(algorithm, [700, 60], &Identity::new(700), &options);
            assert_eq!((found.passes, &told), (read, &(1..=read).collect()), "{}", algorithm.name);
        }
    }
}

/// The mean, the size of the entries, the correlation and the coefficients.
#[test]
fn passes_of_the_direct_method() {
    for (center, passes) in [(false, 2), (true, 3)] {
        let options = Options { center, ..Options::default() };
        let (plain, ..) = watched(&ALGORITHMS[2], [30, 200], &Identity::new(30), &options);
        let (coupled, read, told) = watched(&ALGORITHMS[2], [30, 200], &h1(30), &options);
        assert_eq!((plain.passes, coupled.passes, read), (passes, passes + 1, passes + 1));
        assert_eq!(told, (1..=passes + 1).collect::<Vec<_>>());
    }
}

/// One set, whose residuals take a pass more.
#[test]
fn residuals_of_sets_are_a_pass() {
    let plain = Options { truncation: Truncation::Modes(3), ..Options::default() };
    let of =
        |options: &Options| watched(&APPROXIMATIONS[1], [300, 60], &Identity::new(300), options);
    let ((without, read, _), (with, more, _)) =
        (of(&plain), of(&Options { residuals: true, ..plain.clone() }));
    assert_eq!([without.passes, with.passes], [read, more]);
    assert_eq!(more, read + 1);
}

/// Few rows of many snapshots, for the mean, and few whole columns, for residuals.
#[test]
fn what_is_read_at_once_is_bounded() {
    let options = Options { truncation: Truncation::Modes(2), center: true, ..Options::default() };
    let many = Counting::new(20, 300_000);
    direct(&many, &Identity::new(20), &options).expect("a decomposition");
    assert!(8 * many.largest.into_inner() <= 16 << 20);

    let long = Counting::new(20_000, 20);
    let w = Identity::new(20_000);
    let basis = (ALGORITHMS[0].run)(&long, &w, &options).expect("a decomposition");
    long.largest.store(0, Ordering::Relaxed);
    projection_residuals(&basis, &long, &w).expect("residuals");
    assert!(long.largest.into_inner() <= 8 * 20_000);
}
