//! Passes over the snapshots are counted, told to those who watch, and read in bounded pieces.

mod common;

use common::{counted, h1, random_matrix, snapshots, times};
use lumley_pod::{
    ALGORITHMS, APPROXIMATIONS, Algorithm, Decomposition, Execution, Identity, InnerProduct,
    MemoryModes, MemorySnapshots, Options, Pass, Truncation, Watch, direct, projection_residuals,
};
use std::cell::RefCell;

/// Few unknowns and many snapshots fit where M x M numbers, or some of each snapshot for each thread,
/// would not.
#[test]
fn the_classical_method_takes_little_memory() {
    let (n, m) = (16, 20_000);
    let x = MemorySnapshots::new(random_matrix(n, m, 3), times(m));
    for algorithm in ALGORITHMS.iter().filter(|a| ["auto", "direct"].contains(&a.name)) {
        let par = faer::Par::rayon(8);
        let options = Options { memory_limit: 4 << 20, par, center: true, ..Options::default() };
        let basis = (algorithm.run)(&x, &Identity::new(n), &options).expect("little memory");
        assert_eq!((basis.algorithm, basis.size()), ("direct", n), "{}", algorithm.name);
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
    [n, m]: [usize; 2],
    w: &dyn InnerProduct,
    options: &Options,
) -> (Decomposition, usize, Vec<usize>) {
    let (told, modes) = (Told::default(), MemoryModes::default());
    let execution = Execution { watch: &told, ..Execution::default() };
    let (found, numbers, _) = counted(&snapshots(random_matrix(n, m, 3)), |x| {
        (algorithm.stream)(x, w, options, execution, &modes).expect("a decomposition")
    });
    let (passes, done) = told.0.into_inner();
    assert_eq!((numbers % (n * m), done), (0, n), "{}", algorithm.name);
    (found, numbers / (n * m), passes)
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
    let many = snapshots(random_matrix(20, 300_000, 3));
    let limited = Options { memory_limit: 32 << 20, ..options.clone() };
    let (found, _, largest) = counted(&many, |x| direct(x, &Identity::new(20), &limited));
    found.expect("a decomposition");
    assert!(8 * largest <= 8 << 20);

    let (long, w) = (snapshots(random_matrix(20_000, 20, 3)), Identity::new(20_000));
    let basis = (ALGORITHMS[0].run)(&long, &w, &options).expect("a decomposition");
    let (found, _, largest) = counted(&long, |x| projection_residuals(&basis, x, &w));
    found.expect("residuals");
    assert!(largest <= 8 * 20_000);
}
