//! Snapshots and options that cannot be decomposed: an error that says why, never a panic.

mod common;

use common::{products, random_matrix, times};
use faer::{Mat, MatMut};
use lumley_pod::{
    ALGORITHMS, Identity, MemorySnapshots, Options, PodError, SnapshotSource, TimeWeightsError,
    Truncation,
};
use std::io;
use std::ops::Range;

fn steady(m: usize, value: f64) -> MemorySnapshots {
    MemorySnapshots::new(Mat::from_fn(6, m, |i, _| value * (0.1 + i as f64).sqrt()), times(m))
}

/// The error of every algorithm in every inner product.
fn for_all(x: &dyn SnapshotSource, options: &Options, check: impl Fn(&PodError) -> bool) {
    for (product, w) in products(6) {
        for algorithm in ALGORITHMS {
            let error = (algorithm.run)(x, &*w, options).err();
            let name = algorithm.name;
            assert!(error.as_ref().is_some_and(&check), "{name}, {product}: {error:?}");
        }
    }
}

#[test]
fn nothing_to_decompose() {
    let no_snapshots = MemorySnapshots::new(Mat::zeros(6, 0), vec![]);
    let plain = Options::default();
    for_all(&no_snapshots, &plain, |e| matches!(e, PodError::Empty { unknowns: 6 }));
    let no_unknowns = MemorySnapshots::new(Mat::zeros(0, 3), times(3));
    for algorithm in ALGORITHMS {
        let error = (algorithm.run)(&no_unknowns, &Identity::new(0), &plain);
        assert!(matches!(error, Err(PodError::Empty { unknowns: 0 })), "{}", algorithm.name);
    }
}

#[test]
fn no_energy() {
    let plain = Options::default();
    let centred = Options { center: true, ..Options::default() };
    let unequal = Options { time_weights: Some(vec![0.3, 0.1, 7.0, 1.0 / 3.0]), ..centred.clone() };
    let still = |e: &PodError| matches!(e, PodError::NoEnergy { centred: true, .. });
    for_all(&steady(4, 0.0), &plain, |e| {
        matches!(e, PodError::NoEnergy { snapshots: 4, centred: false })
    });
    for_all(&steady(4, 1e-200), &plain, |e| matches!(e, PodError::NoEnergy { .. }));
    for_all(&steady(4, 0.7), &centred, still);
    for_all(&steady(4, 0.7), &unequal, still);
    for_all(&steady(1, 0.7), &centred, still);
}

#[test]
fn entries_that_are_no_numbers_are_named() {
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut x = random_matrix(6, 5, 1);
        x[(4, 3)] = value;
        let x = MemorySnapshots::new(x, times(5));
        for center in [false, true] {
            let options = Options { center, ..Options::default() };
            for_all(&x, &options, |e| matches!(e, PodError::NonFinite { snapshot: 3, row: 4, .. }));
        }
    }
}

#[test]
fn entries_too_large_to_square_are_refused() {
    for_all(&steady(4, 1e200), &Options::default(), |e| matches!(e, PodError::Overflow));
}

#[test]
fn wrong_length() {
    let x = MemorySnapshots::new(random_matrix(7, 5, 1), times(5));
    for_all(&x, &Options::default(), |e| {
        matches!(e, PodError::Dimension { unknowns: 7, product: 6 })
    });
}

#[test]
fn options_without_meaning() {
    let x = MemorySnapshots::new(random_matrix(6, 3, 1), times(3));
    let modes = |truncation| Options { truncation, ..Options::default() };
    for_all(&x, &modes(Truncation::Modes(0)), |e| matches!(e, PodError::NoModes));
    for fraction in [0.0, -1.0, 1.1, f64::NAN] {
        let options = modes(Truncation::Energy(fraction));
        for_all(&x, &options, |e| matches!(e, PodError::Energy { .. }));
    }
    let weights = |q: &[f64]| Options { time_weights: Some(q.to_vec()), ..Options::default() };
    for_all(&x, &weights(&[1.0, 1.0]), |e| {
        let PodError::TimeWeights(e) = e else { return false };
        *e == TimeWeightsError::Length { weights: 2, snapshots: 3 }
    });
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for_all(&x, &weights(&[1.0, 1.0, bad]), |e| {
            matches!(e, PodError::TimeWeights(TimeWeightsError::Value { index: 2, .. }))
        });
    }
    for tiny in [f64::MIN_POSITIVE, 1e-31] {
        for_all(&x, &weights(&[1.0, 1.0, tiny]), |e| {
            matches!(e, PodError::TimeWeights(TimeWeightsError::Negligible { index: 2, .. }))
        });
    }
}

#[test]
fn more_memory_than_allowed_is_refused_with_the_figure() {
    /// Claims to be enormous: it must be refused before anything is read or held.
    struct Enormous(Vec<f64>);
    impl SnapshotSource for Enormous {
        fn dim(&self) -> usize {
            3_000_000
        }
        fn times(&self) -> &[f64] {
            &self.0
        }
        fn block(&self, _: Range<usize>, _: Range<usize>, _: MatMut<'_, f64>) -> io::Result<()> {
            Err(io::Error::other("nothing must be read"))
        }
    }
    let few = Enormous(times(10));
    let w = Identity::new(few.dim());
    let error = lumley_pod::direct(&few, &w, &Options::default()).expect_err("216 TB");
    // Three squares, and little beside them.
    let squares = 3 * 8 * 3_000_000_u128.pow(2);
    let near = |bytes: u128| bytes > squares && bytes - squares < squares / 1000;
    assert!(matches!(error, PodError::Memory { bytes, .. } if near(bytes)), "{error}");
    assert!(error.to_string().contains("take `snapshots` or `svd`"), "{error}");

    let wide = Enormous(times(3_000_001));
    let error = lumley_pod::direct(&wide, &w, &Options::default()).expect_err("216 TB");
    assert!(error.to_string().ends_with("take `randomized` or `incremental`"), "{error}");

    let many = Enormous(times(2_000_000));
    for run in [lumley_pod::method_of_snapshots, lumley_pod::svd, lumley_pod::auto] {
        let error = run(&many, &w, &Options::default()).expect_err("96 TB");
        assert!(matches!(error, PodError::Memory { .. }), "{error}");
    }
    let error = lumley_pod::auto(&few, &w, &Options::default()).expect_err("the source fails");
    assert!(error.to_string().contains("nothing must be read"), "{error}");
}
