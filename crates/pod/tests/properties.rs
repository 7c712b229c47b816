//! What every algorithm in the table must show, in every inner product, centred or not, with time
//! weights or without.

mod common;

use common::{inner, largest, orthonormal, products, snapshots, times, with_singular_values};
use faer::{Mat, Scale};
use lumley_pod::{
    ALGORITHMS, InnerProduct, MemorySnapshots, Options, ReducedBasis, Truncation, svd, time_weights,
};

const N: usize = 70;
const M: usize = 24;
const MODES: usize = 7;

struct Run<'a> {
    name: String,
    x: Mat<f64>,
    fluctuation: Mat<f64>,
    w: &'a dyn InnerProduct,
    options: &'a Options,
    basis: ReducedBasis,
}

/// Energies fall by 4 from mode to mode; a steady field is added so that centring matters.
fn field(w: &dyn InnerProduct) -> Mat<f64> {
    let sigma: Vec<f64> = (0..16).map(|k| 0.5_f64.powi(k)).collect();
    let mut x = with_singular_values(&sigma, (N, M), w, 11);
    for column in x.col_iter_mut() {
        column.iter_mut().enumerate().for_each(|(i, x)| *x += 0.1 * (0.2 * i as f64).cos());
    }
    x
}

fn all_options() -> Vec<(&'static str, Options)> {
    let unequal = Some(time_weights::trapezoid(&times(M)).expect("increasing times"));
    let truncation = Truncation::Modes(MODES);
    let plain = Options { truncation, ..Options::default() };
    vec![
        ("plain", plain.clone()),
        ("centred", Options { center: true, ..plain.clone() }),
        ("weighted", Options { time_weights: unequal.clone(), ..plain.clone() }),
        ("both", Options { center: true, time_weights: unequal, ..plain }),
    ]
}

/// Runs every algorithm on every combination.
fn for_all(check: impl Fn(&Run<'_>)) {
    for (product, w) in products(N) {
        for (kind, options) in all_options() {
            for algorithm in ALGORITHMS {
                let x = field(&*w);
                let basis = (algorithm.run)(&snapshots(x.clone()), &*w, &options)
                    .expect("a decomposition of a smooth field");
                let mean = basis.mean.clone().unwrap_or_else(|| vec![0.0; N]);
                let fluctuation = Mat::from_fn(N, M, |i, j| x[(i, j)] - mean[i]);
                let name = format!("{}, {product}, {kind}", algorithm.name);
                check(&Run { name, x, fluctuation, w: &*w, options: &options, basis });
            }
        }
    }
}

/// `<a b>` for two rows of values in time.
fn average(basis: &ReducedBasis, f: impl Fn(usize) -> f64) -> f64 {
    basis.time_weights.iter().enumerate().map(|(j, q)| q * f(j)).sum()
}

/// Paper eq. (6).
#[test]
fn modes_are_orthonormal() {
    for_all(|run| {
        let phi = run.basis.modes.as_ref();
        assert_eq!(phi.shape(), (N, MODES), "{}", run.name);
        let defect = (inner(run.w, phi, phi) - Mat::<f64>::identity(MODES, MODES)).norm_max();
        assert!(defect < 1e-12, "{}: {defect:e}", run.name);
    });
}

/// Paper eq. (7).
#[test]
fn coefficients_are_the_projections() {
    for_all(|run| {
        let a = inner(run.w, run.basis.modes.as_ref(), run.fluctuation.as_ref());
        let gap = (&run.basis.coefficients - &a).norm_max();
        assert!(gap < 1e-12, "{}: {gap:e}", run.name);
        let projected = run.basis.project(run.x.as_ref(), run.w).expect("weights in memory");
        let gap = (projected - a).norm_max();
        assert!(gap < 1e-14, "{}: {gap:e}", run.name);
    });
}

/// Paper eq. (8).
#[test]
fn coefficients_are_uncorrelated_with_the_eigenvalues_as_energies() {
    for_all(|run| {
        let (basis, a) = (&run.basis, &run.basis.coefficients);
        for i in 0..MODES {
            for k in 0..MODES {
                let mean = average(basis, |j| a[(i, j)] * a[(k, j)]);
                let expected = if i == k { basis.eigenvalues[i] } else { 0.0 };
                let gap = (mean - expected).abs() / basis.eigenvalues[0];
                assert!(gap < 1e-14, "{}: <a_{i} a_{k}> is off by {gap:e}", run.name);
            }
        }
    });
}

/// Paper eqs. (1) and (31): no basis of N modes leaves less than the discarded energy.
#[test]
fn mean_squared_projection_error_is_the_discarded_energy() {
    for_all(|run| {
        let basis = &run.basis;
        let energy = |u: &Mat<f64>| {
            let squares = inner(run.w, u.as_ref(), u.as_ref());
            average(basis, |j| squares[(j, j)])
        };
        let total = energy(&run.fluctuation);
        assert!((basis.total_energy / total - 1.0).abs() < 1e-13, "{}", run.name);
        for modes in 1..=MODES {
            let phi = basis.modes.subcols(0, modes);
            let error = energy(&(&run.fluctuation - phi * basis.coefficients.subrows(0, modes)));
            let discarded = total - basis.eigenvalues[..modes].iter().sum::<f64>();
            assert!((error - discarded).abs() < 1e-13 * total, "{}, {modes} modes", run.name);
            let rms = basis.rms_projection_error()[modes - 1];
            assert!((rms - (error / total).sqrt()).abs() < 1e-10, "{}, {modes} modes", run.name);
            let percent = basis.cumulative_percent()[modes - 1];
            assert!((100.0 - percent - 100.0 * error / total).abs() < 1e-11, "{}", run.name);
        }

        let other = with_singular_values(&[1.0; MODES], (N, MODES), run.w, 99);
        let q = orthonormal(MODES, MODES, 1);
        let other = other * q;
        let a = inner(run.w, other.as_ref(), run.fluctuation.as_ref());
        let worse = energy(&(&run.fluctuation - other * a));
        assert!(worse > total - basis.eigenvalues.iter().sum::<f64>(), "{}", run.name);
    });
}

/// The decisive entry is positive, and algorithms agree on modes, energies and coefficients.
#[test]
fn algorithms_agree_signs_included() {
    for_all(|run| {
        let exact = svd(&snapshots(run.x.clone()), run.w, run.options).expect("the same field");
        for k in 0..MODES {
            let mode: Vec<f64> = run.basis.modes.col(k).iter().copied().collect();
            let peak = largest(mode.iter().copied());
            let decisive = mode.iter().find(|x| x.abs() >= (1.0 - 1e-6) * peak);
            assert!(decisive.is_some_and(|x| *x > 0.0), "{}, mode {k}", run.name);
            let ratio = run.basis.eigenvalues[k] / exact.eigenvalues[k];
            assert!((ratio - 1.0).abs() < 1e-11, "{}, lambda_{k}: {ratio}", run.name);
        }
        let modes = (&run.basis.modes - &exact.modes).norm_max();
        assert!(modes < 1e-10, "{}: {modes:e}", run.name);
        let coefficients = (&run.basis.coefficients - &exact.coefficients).norm_max();
        assert!(coefficients < 1e-10, "{}: {coefficients:e}", run.name);
    });
}

/// A linear constraint that every snapshot obeys, as div u = 0 does: the modes obey it.
#[test]
fn modes_keep_linear_constraints() {
    // The discrete divergence of a staggered velocity on a 5 x 7 grid, and a curl, which it kills.
    let (nx, ny) = (5, 7);
    let u = |i: usize, j: usize| j * (nx + 1) + i;
    let v = |i: usize, j: usize| (nx + 1) * ny + j * nx + i;
    let n = (nx + 1) * ny + nx * (ny + 1);
    let mut stream = common::random(4);
    let x = {
        let psi: Vec<Vec<f64>> =
            (0..M).map(|_| (0..(nx + 1) * (ny + 1)).map(|_| stream()).collect()).collect();
        let mut x = Mat::zeros(n, M);
        for (k, psi) in psi.iter().enumerate() {
            let at = |i: usize, j: usize| psi[j * (nx + 1) + i];
            for j in 0..ny {
                (0..=nx).for_each(|i| x[(u(i, j), k)] = at(i, j + 1) - at(i, j));
            }
            for j in 0..=ny {
                (0..nx).for_each(|i| x[(v(i, j), k)] = at(i, j) - at(i + 1, j));
            }
        }
        x
    };
    let divergence = |f: &[f64]| {
        let of_cell = |c: usize| (c % nx, c / nx, f[u(c % nx + 1, c / nx)] - f[u(c % nx, c / nx)]);
        largest((0..nx * ny).map(of_cell).map(|(i, j, du)| du + f[v(i, j + 1)] - f[v(i, j)]))
    };
    let options = Options { truncation: Truncation::Modes(10), ..Options::default() };
    for (product, w) in products(n) {
        for algorithm in ALGORITHMS {
            let basis = (algorithm.run)(&snapshots(x.clone()), &*w, &options).expect("a flow");
            for mode in basis.modes.col_iter() {
                let worst = divergence(&mode.iter().copied().collect::<Vec<_>>());
                assert!(worst < 1e-13, "{}, {product}: div Phi = {worst:e}", algorithm.name);
            }
        }
    }
}

/// Weights count snapshots: doubling one is the same as showing it twice.
#[test]
fn a_time_weight_is_a_repetition() {
    let (_, w) = &products(N)[2];
    let x = field(&**w);
    let twice = Mat::from_fn(N, M + 1, |i, j| x[(i, if j == M { 5 } else { j })]);
    let mut weights = vec![1.0; M];
    weights[5] = 2.0;
    for center in [false, true] {
        let repeated = Options { truncation: Truncation::Modes(5), center, ..Options::default() };
        let weighted = Options { time_weights: Some(weights.clone()), ..repeated.clone() };
        for algorithm in ALGORITHMS {
            let run = |x: &Mat<f64>, o: &Options| {
                (algorithm.run)(&snapshots(x.clone()), &**w, o).expect("a smooth field")
            };
            let (a, b) = (run(&twice, &repeated), run(&x, &weighted));
            let gap = (&a.modes - &b.modes).norm_max();
            assert!(gap < 1e-12, "{}, centred {center}: {gap:e}", algorithm.name);
            for (a, b) in a.eigenvalues.iter().zip(&b.eigenvalues) {
                assert!((a - b).abs() < 1e-14, "{}: {a} and {b}", algorithm.name);
            }
        }
    }
}

/// Scaling the data scales sigma alone; the order of snapshots does not matter to the modes.
#[test]
fn scale_and_order_of_snapshots_do_not_change_the_modes() {
    let (_, w) = &products(N)[1];
    let x = field(&**w);
    let options = Options { truncation: Truncation::Modes(5), ..Options::default() };
    let mixed = Mat::from_fn(N, M, |i, j| 1e40 * x[(i, (j * 7) % M)]);
    for algorithm in ALGORITHMS {
        let run = |x: Mat<f64>| (algorithm.run)(&snapshots(x), &**w, &options).expect("a field");
        let (a, b) = (run(x.clone()), run(mixed.clone()));
        let gap = (&a.modes - &b.modes).norm_max();
        assert!(gap < 1e-11, "{}: {gap:e}", algorithm.name);
        for (a, b) in a.singular_values.iter().zip(&b.singular_values) {
            assert!((b / a / 1e40 - 1.0).abs() < 1e-12, "{}: {a} and {b}", algorithm.name);
        }
    }
}

/// More snapshots than unknowns, one unknown, one snapshot, two equal energies.
#[test]
fn every_shape_is_decomposed() {
    for (n, m) in [(1, 1), (1, 6), (6, 1), (4, 30), (30, 4), (300, 2)] {
        let x = common::random_matrix(n, m, 8);
        let options = Options { truncation: Truncation::Energy(1.0), ..Options::default() };
        for algorithm in ALGORITHMS {
            let source = MemorySnapshots::new(x.clone(), times(m));
            let w = lumley_pod::Identity::new(n);
            let basis = (algorithm.run)(&source, &w, &options).expect("random snapshots");
            assert_eq!(basis.size(), n.min(m), "{} on {n} x {m}", algorithm.name);
            assert_eq!(basis.spectrum.len(), n.min(m));
            let gap = (basis.reconstruct(basis.coefficients.as_ref()) - &x).norm_max();
            assert!(gap < 1e-13, "{} on {n} x {m}: {gap:e}", algorithm.name);
            assert!((basis.cumulative_percent()[n.min(m) - 1] - 100.0).abs() < 1e-12);
            assert_eq!(basis.rms_projection_error()[n.min(m) - 1], 0.0);
        }
    }
}

/// Antisymmetric modes have two entries of the same size: round-off must not choose the sign.
#[test]
fn ties_do_not_decide_the_sign() {
    let n = 41;
    let wave = |i: usize, k: f64| (k * std::f64::consts::TAU * i as f64 / (n - 1) as f64).sin();
    let x = Mat::from_fn(n, 9, |i, j| {
        let t = j as f64;
        wave(i, 1.0) * (0.7 * t).cos() + 0.3 * wave(i, 2.0) * (1.9 * t).sin()
    });
    let options = Options { truncation: Truncation::Modes(2), ..Options::default() };
    let w = lumley_pod::Identity::new(n);
    let expected = svd(&snapshots(x.clone()), &w, &options).expect("two waves").modes;
    for k in 0..2 {
        let tie = largest((0..n).map(|i| expected[(i, k)] + expected[(n - 1 - i, k)]));
        assert!(tie < 1e-14, "mode {k} is not antisymmetric: {tie:e}");
    }
    for algorithm in ALGORITHMS {
        for scale in [1.0, -1.0, 3.0, -0.7] {
            let basis = (algorithm.run)(&snapshots(&x * Scale(scale)), &w, &options);
            let gap = (basis.expect("two waves").modes - &expected).norm_max();
            assert!(gap < 1e-12, "{}, x {scale}: {gap:e}", algorithm.name);
        }
    }
}
