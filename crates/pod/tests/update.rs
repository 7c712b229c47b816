//! A basis that new snapshots update.

mod common;

use common::{h1, largest, products, snapshots, times, with_singular_values};
use faer::Mat;
use lumley_pod::{
    Decomposition, Diagonal, Identity, InnerProduct, MemorySnapshots, Options, PodError,
    Truncation, svd,
};
use std::ops::Range;

const N: usize = 210;
const M: usize = 150;

fn ask(modes: usize) -> Options {
    Options { truncation: Truncation::Modes(modes), ..Options::default() }
}

/// With a steady field, so that centring matters.
fn field(sigma: &[f64], w: &dyn InnerProduct) -> Mat<f64> {
    let mut x = with_singular_values(sigma, (N, M), w, 11);
    for column in x.col_iter_mut() {
        column.iter_mut().enumerate().for_each(|(i, x)| *x += 0.1 * (0.2 * i as f64).cos());
    }
    x
}

fn part(x: &Mat<f64>, cols: Range<usize>) -> MemorySnapshots {
    MemorySnapshots::new(x.subcols(cols.start, cols.len()).to_owned(), times(M)[cols].to_vec())
}

/// A basis of all modes is updated exactly, whatever the means and however few the new snapshots.
#[test]
fn an_untruncated_basis_is_updated_exactly() {
    let sigma: Vec<f64> = (0..20).map(|k| 0.6_f64.powi(k)).collect();
    for (product, w) in products(N).into_iter().filter(|(name, _)| *name != "H1") {
        let mut x = field(&sigma, &*w);
        x.subcols_mut(0, 40).col_iter_mut().for_each(|u| u.iter_mut().for_each(|u| *u += 0.3));
        for center in [false, true] {
            let options = Options { center, ..ask(12) };
            let exact = svd(&snapshots(x.clone()), &*w, &options).expect("a decomposition");
            for first in [1, 40, 149] {
                let everything = Options { truncation: Truncation::Modes(M), ..options.clone() };
                let Ok(old) = svd(&part(&x, 0..first), &*w, &everything) else {
                    assert!(center && first == 1, "one snapshot less itself is nothing");
                    continue;
                };
                let basis = old.updated(&part(&x, first..M), &*w, &options).expect("an update");
                let name = format!("{product}, centred {center}, {first}");
                assert!(basis.error_bound.expect("an update") < 1e-25, "{name}");
                assert_eq!(basis.times, exact.times, "{name}");
                let gaps = [
                    ("modes", (&basis.modes - &exact.modes).norm_max()),
                    ("coefficients", (&basis.coefficients - &exact.coefficients).norm_max()),
                ];
                for (what, gap) in gaps {
                    assert!(gap < 1e-11, "{name}: {what} {gap:e}");
                }
                for (found, known) in basis.singular_values.iter().zip(&exact.singular_values) {
                    assert!((found - known).abs() < 1e-14 * exact.singular_values[0], "{name}");
                }
            }
        }
    }
}

/// Weights for old and for new snapshots, each scaled to the share of its number.
#[test]
fn time_weights_of_both_sets_are_joined() {
    let w = Identity::new(N);
    let x = field(&[1.0, 0.5, 0.2], &w);
    let weights: Vec<f64> = (0..M).map(|j| 1.0 + 0.5 * (j as f64).sin()).collect();
    let of = |cols: Range<usize>| Options {
        center: true,
        time_weights: Some(weights[cols].to_vec()),
        ..ask(4)
    };
    let old = svd(&part(&x, 0..50), &w, &of(0..50)).expect("a decomposition");
    let basis = old.updated(&part(&x, 50..M), &w, &of(50..M)).expect("an update");
    let share = |set: Range<usize>| {
        let (count, sum) = (set.len() as f64, weights[set.clone()].iter().sum::<f64>());
        weights[set].iter().map(move |q| q / sum * count / M as f64).collect::<Vec<_>>()
    };
    let joined = [share(0..50), share(50..M)].concat();
    let options = Options { time_weights: Some(joined), ..of(0..M) };
    let exact = svd(&snapshots(x), &w, &options).expect("a decomposition");
    assert!((&basis.modes - &exact.modes).norm_max() < 1e-12);
    assert!((&basis.coefficients - &exact.coefficients).norm_max() < 1e-12);
    let gaps = basis.time_weights.iter().zip(&exact.time_weights).map(|(a, b)| a - b);
    assert!(largest(gaps) < 1e-16);
}

#[test]
fn what_does_not_fit_is_refused() {
    let (w, x) = (Identity::new(N), field(&[1.0, 0.5, 0.2], &Identity::new(N)));
    let old = svd(&part(&x, 0..50), &w, &ask(4)).expect("a decomposition");
    let new = part(&x, 50..M);
    let centred = old.updated(&new, &w, &Options { center: true, ..ask(4) });
    assert!(matches!(centred, Err(PodError::Centring { centred: false })), "{centred:?}");
    let other = Diagonal::new(vec![2.0; N]).expect("positive");
    let weighted = old.updated(&new, &other, &ask(4));
    assert!(matches!(weighted, Err(PodError::OldModes { defect }) if (defect - 1.0).abs() < 1e-12));
    let short = MemorySnapshots::new(x.subrows(0, 9).to_owned(), times(M));
    let length = old.updated(&short, &Identity::new(9), &ask(4));
    assert!(matches!(length, Err(PodError::Modes { unknowns: 9, modes: N })), "{length:?}");
    let mut broken = old.clone();
    broken.modes[(3, 1)] = f64::NAN;
    assert!(matches!(broken.updated(&new, &w, &ask(4)), Err(PodError::OldModes { .. })));
}

/// The parts of a basis that was put together by hand, or read from a damaged file.
#[test]
fn parts_that_do_not_belong_together_are_refused() {
    let (w, x) = (Identity::new(N), field(&[1.0, 0.5, 0.2], &Identity::new(N)));
    let old = svd(&part(&x, 0..50), &w, &ask(4)).expect("a decomposition");
    let refused = |break_it: &dyn Fn(&mut Decomposition), told: (&str, usize, usize)| {
        let mut broken = old.clone();
        break_it(&mut broken.decomposition);
        let error = broken.updated(&part(&x, 50..M), &w, &ask(4)).expect_err(told.0);
        let PodError::OldBasis { what, found, expected } = error else { panic!("{error}") };
        assert_eq!((what, found, expected), told);
    };
    refused(&|d| d.coefficients.truncate(3, 50), ("rows of coefficients", 3, 4));
    refused(&|d| d.coefficients.truncate(4, 49), ("columns of coefficients", 49, 50));
    refused(&|d| d.time_weights.truncate(7), ("time weights", 7, 50));
    refused(&|d| d.spectrum.truncate(2), ("eigenvalues in its spectrum", 2, 4));
    refused(&|d| d.times.push(1e3), ("columns of coefficients", 50, 51));
}

/// In a product that amplifies round-off, old snapshots a million times as large as the new ones.
#[test]
fn loud_old_snapshots_make_no_modes_of_noise() {
    let w = h1(N);
    let shape = |k: usize, i: usize| ((k + 1) as f64 * i as f64 / N as f64).cos() + 1.3;
    let x = Mat::from_fn(N, M, |i, j| {
        let loud = if j < 50 { 1.0 } else { 1e-6 };
        let t = 0.3 * j as f64;
        loud * (shape(0, i) * t.sin() + 0.3 * shape(1, i) * (2.0 * t).cos())
    });
    for center in [false, true] {
        let options = Options { center, ..ask(10) };
        let old = svd(&part(&x, 0..50), &w, &options).expect("a decomposition");
        let basis = old.updated(&part(&x, 50..M), &w, &options).expect("an update");
        assert_eq!((old.rank, basis.rank), (2, 2), "{:?}", basis.spectrum);
        assert!(basis.spectrum[1] > 1e6 * basis.noise_floor);
    }
}
