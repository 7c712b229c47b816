//! Round-off is not reported as modes: large means, inner products that amplify it.

mod common;

use common::{h1, inner, snapshots};
use faer::Mat;
use lumley_pod::{
    ALGORITHMS, Identity, InnerProduct, Options, PodError, SparseSpd, Truncation, direct,
    method_of_snapshots, svd,
};

fn ask(modes: usize, center: bool) -> Options {
    Options { truncation: Truncation::Modes(modes), center, ..Options::default() }
}

/// A mean of about 1000 and one fluctuation of about 2^-20, each entry of which is exact: the
/// mean is a multiple of 2^-20 too.
fn one_fluctuation() -> Mat<f64> {
    let (shape, time) = ([3.0, -1.0, 2.0, 5.0, -4.0], [1.0, -2.0, 3.0, 1.0, -1.0, 2.0, -3.0]);
    let mean = |i: usize| 1000.0 + ((7 * i) % 40) as f64 + 0.125;
    Mat::from_fn(50, 7, |i, j| mean(i) + shape[i % 5] * time[j] * 0.5_f64.powi(20))
}

#[test]
fn rounding_of_a_large_mean_is_no_mode() {
    let (x, w) = (one_fluctuation(), Identity::new(50));
    for algorithm in ALGORITHMS {
        let basis = (algorithm.run)(&snapshots(x.clone()), &w, &ask(5, true)).expect("a wave");
        assert_eq!((basis.size(), basis.rank), (1, 1), "{}: {:?}", algorithm.name, basis.spectrum);
        let steady: f64 = basis.coefficients.row(0).iter().sum();
        assert!(steady.abs() < 1e-13 * basis.singular_values[0], "{}: {steady:e}", algorithm.name);
    }
}

/// Smooth snapshots of rank 1 whose entries are much larger than their energy is to errors.
#[test]
fn amplified_round_off_is_no_mode() {
    for n in [200, 2000] {
        let w = h1(n);
        let shape = |i: usize| (2.0 * i as f64 / n as f64).cos() + 1.3;
        let x = Mat::from_fn(n, 6, |i, j| shape(i) * (0.9 * j as f64 + 0.2).sin());
        for center in [false, true] {
            for algorithm in ALGORITHMS.iter().filter(|a| n < 2000 || a.name != "direct") {
                let run = (algorithm.run)(&snapshots(x.clone()), &w, &ask(5, center));
                let (basis, name) = (run.expect("a wave"), algorithm.name);
                assert_eq!((basis.size(), basis.rank), (1, 1), "{name}, {n}: {:?}", basis.spectrum);
                let mut z = basis.modes.clone();
                w.factor(0..z.nrows(), z.as_mut()).expect("weights in memory");
                let defect = (z.transpose() * &z)[(0, 0)] - 1.0;
                assert!(defect.abs() < 1e-12, "{name}, {n}: {defect:e}");
            }
        }
    }
}

/// Modes above the floor are kept, and are orthonormal as far as the condition of W lets them.
#[test]
fn modes_over_the_amplified_noise_are_kept() {
    let n = 400;
    let w = h1(n);
    let wave = |i: usize, k: f64| (3.1 * k * i as f64 / n as f64).cos() / k;
    let x = Mat::from_fn(n, 9, |i, j| {
        (1..5)
            .map(|k| {
                0.03_f64.powi(k)
                    * wave(i, f64::from(k))
                    * (f64::from(k * k) * 0.37 * j as f64).sin()
            })
            .sum()
    });
    for algorithm in ALGORITHMS {
        let basis = (algorithm.run)(&snapshots(x.clone()), &w, &ask(3, false)).expect("waves");
        assert_eq!(basis.size(), 3, "{}: {:?}", algorithm.name, basis.spectrum);
        let phi = basis.modes.as_ref();
        let defect = (inner(&w, phi, phi) - Mat::<f64>::identity(3, 3)).norm_max();
        assert!(defect < 1e-10, "{}: {defect:e}", algorithm.name);
    }
}

/// A uniform field costs this product next to nothing, and differences of large entries all the more: squares
/// of them are noise, and no number of modes would help.
#[test]
fn where_all_is_noise_another_algorithm_is_named() {
    let (n, small) = (8, 2e-15);
    let of_cell = |k: usize| [(k, k, 1.0), (k, k + 1, -1.0), (k + 1, k, -1.0), (k + 1, k + 1, 1.0)];
    let stiff = (0..n - 1).flat_map(of_cell).chain((0..n).map(|k| (k, k, small)));
    let w = SparseSpd::from_triplets(n, &stiff.collect::<Vec<_>>()).expect("positive definite");
    let x = snapshots(Mat::from_fn(n, 3, |_, j| 1.0 + j as f64));
    let error = method_of_snapshots(&x, &w, &ask(1, false)).expect_err("noise");
    let PodError::AllNoise { first, floor } = error else { panic!("{error}") };
    assert!(first > 0.0 && first <= floor, "{first:e} {floor:e}");
    assert!(error.is_of_computation() && error.to_string().ends_with("take `svd`"), "{error}");
    assert_eq!(svd(&x, &w, &ask(1, false)).expect("no squares").size(), 1);
}

/// Large entries count for noise with the weight that their snapshot has.
#[test]
fn a_loud_snapshot_of_little_weight_makes_little_noise() {
    let (n, loud) = (30, 1e3);
    let x = Mat::from_fn(n, 5, |i, j| if j == 0 { loud } else { 1e-6 * ((i * j) as f64).sin() });
    let time_weights = Some(vec![1e-14, 1.0, 1.0, 1.0, 1.0]);
    let options = Options { time_weights, ..ask(1, false) };
    let basis = direct(&snapshots(x), &h1(n), &options).expect("a decomposition");
    let squaring = n as f64 * f64::EPSILON * basis.eigenvalues[0];
    let gap = basis.noise_floor / squaring - 1.0;
    assert!(gap.abs() < 1e-12, "{:e}, {squaring:e} of squaring", basis.noise_floor);
}
