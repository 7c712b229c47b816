//! What the approximations must show: what they hold and what they leave, the bound, updates.

mod common;

use common::{inner, largest, products, snapshots, times, with_singular_values};
use faer::{Mat, Par};
use lumley_pod::{
    APPROXIMATIONS, Identity, InnerProduct, Options, PodError, ReducedBasis, Truncation,
    incremental, randomized, svd, time_weights,
};

const N: usize = 210;
const M: usize = 150;
const MODES: usize = 6;

fn ask(modes: usize) -> Options {
    Options { truncation: Truncation::Modes(modes), ..Options::default() }
}

/// Energies that decay fast, slowly, not at all, and in two steps.
fn spectra() -> [(&'static str, Vec<f64>); 4] {
    let of = |f: &dyn Fn(i32) -> f64| (0..120).map(f).collect::<Vec<_>>();
    [
        ("fast", of(&|k| 0.7_f64.powi(k))),
        ("slow", of(&|k| 1.0 / (1.0 + f64::from(k)))),
        ("flat", of(&|_| 1.0)),
        ("steps", of(&|k| if k < 8 { 1.0 } else { 1e-3 * 0.99_f64.powi(k) })),
    ]
}

/// Each spectrum with a steady field, so that centring matters; weighted in time, or not.
fn all_options(modes: usize) -> Vec<(&'static str, Options)> {
    let unequal = Some(time_weights::trapezoid(&times(M)).expect("increasing times"));
    let plain = ask(modes);
    vec![
        ("plain", plain.clone()),
        ("both", Options { center: true, time_weights: unequal, ..plain }),
    ]
}

fn field(sigma: &[f64], w: &dyn InnerProduct) -> Mat<f64> {
    let mut x = with_singular_values(sigma, (N, M), w, 11);
    for column in x.col_iter_mut() {
        column.iter_mut().enumerate().for_each(|(i, x)| *x += 0.1 * (0.2 * i as f64).cos());
    }
    x
}

struct Run<'a> {
    name: String,
    spectrum: &'static str,
    fluctuation: Mat<f64>,
    w: &'a dyn InnerProduct,
    basis: ReducedBasis,
    exact: ReducedBasis,
}

/// Runs both approximations, and `svd` for all modes, on every combination.
fn for_all(check: impl Fn(&Run<'_>)) {
    for (product, w) in products(N).into_iter().filter(|(name, _)| *name != "H1") {
        for (kind, options) in all_options(MODES) {
            for (spectrum, sigma) in spectra() {
                let x = snapshots(field(&sigma, &*w));
                let everything = Options { truncation: Truncation::Modes(M), ..options.clone() };
                let exact = svd(&x, &*w, &everything).expect("a decomposition");
                for algorithm in APPROXIMATIONS {
                    let basis = (algorithm.run)(&x, &*w, &options).expect("a decomposition");
                    let mean = basis.mean.clone().unwrap_or_else(|| vec![0.0; N]);
                    let fluctuation = Mat::from_fn(N, M, |i, j| x.matrix()[(i, j)] - mean[i]);
                    let name = format!("{}, {product}, {kind}, {spectrum}", algorithm.name);
                    let exact = exact.clone();
                    check(&Run { name, spectrum, fluctuation, w: &*w, basis, exact });
                }
            }
        }
    }
}

fn average(basis: &ReducedBasis, f: impl Fn(usize) -> f64) -> f64 {
    basis.time_weights.iter().enumerate().map(|(j, q)| q * f(j)).sum()
}

/// Paper eqs. (6) and (8), the sign, and the same mean as without approximation.
#[test]
fn modes_are_orthonormal_and_coefficients_uncorrelated() {
    for_all(|run| {
        let (basis, a) = (&run.basis, &run.basis.coefficients);
        let phi = basis.modes.as_ref();
        assert_eq!((phi.shape(), a.shape()), ((N, MODES), (MODES, M)), "{}", run.name);
        let defect = (inner(run.w, phi, phi) - Mat::<f64>::identity(MODES, MODES)).norm_max();
        assert!(defect < 1e-12, "{}: {defect:e}", run.name);
        for (mode, i) in phi.col_iter().zip(0..) {
            let peak = largest(mode.iter().copied());
            let decisive = mode.iter().find(|x| x.abs() >= (1.0 - 1e-6) * peak);
            assert!(decisive.is_some_and(|x| *x > 0.0), "{}, mode {i}", run.name);
            for k in 0..MODES {
                let expected = if i == k { basis.eigenvalues[i] } else { 0.0 };
                let gap = average(basis, |j| a[(i, j)] * a[(k, j)]) - expected;
                assert!(gap.abs() < 1e-13 * basis.eigenvalues[0], "{}: {gap:e}", run.name);
            }
        }
        assert_eq!(basis.time_weights.len(), M);
        let sum = basis.time_weights.iter().sum::<f64>();
        assert!((sum - 1.0).abs() < 1e-13, "{}: {sum}", run.name);
        let mean = |basis: &ReducedBasis| basis.mean.clone().unwrap_or_default();
        let gaps = mean(basis).into_iter().zip(mean(&run.exact)).map(|(a, b)| a - b);
        assert!(largest(gaps) < 1e-15, "{}", run.name);
    });
}

/// What the coefficients leave is the energy left out, and the coefficients differ from the projections
/// (7) by no more than that.
#[test]
fn what_is_left_is_measured() {
    for_all(|run| {
        let (basis, total) = (&run.basis, run.basis.total_energy);
        assert!((total / run.exact.total_energy - 1.0).abs() < 1e-13, "{}", run.name);
        let left = &run.fluctuation - &basis.modes * &basis.coefficients;
        let squares = inner(run.w, left.as_ref(), left.as_ref());
        let energy = average(basis, |j| squares[(j, j)]);
        let gap = (energy - basis.energy_left()).abs();
        assert!(gap < 1e-13 * total, "{}: {energy:e} left, off by {gap:e}", run.name);
        let rms = basis.rms_projection_error()[MODES - 1] - (energy / total).sqrt();
        assert!(rms.abs() < 1e-12, "{}: {rms:e}", run.name);
        let projections = inner(run.w, basis.modes.as_ref(), run.fluctuation.as_ref());
        let gaps = projections - &basis.coefficients;
        for (j, gap) in gaps.col_iter().enumerate() {
            let allowed = squares[(j, j)].max(0.0).sqrt() + 1e-13;
            assert!(gap.norm_l2() <= allowed, "{}: a(t_{j}) is off by {gap:?}", run.name);
        }
    });
}

/// `0 <= lambda_n(exact) - lambda_n(found) <= error_bound`, also where nothing was found.
#[test]
fn eigenvalues_are_within_the_bound() {
    for_all(|run| {
        let bound = run.basis.error_bound.expect("an approximation");
        // That of sums over M columns, on both sides.
        let round_off = M as f64 * f64::EPSILON * run.exact.eigenvalues[0];
        for (k, exact) in run.exact.spectrum.iter().enumerate() {
            let found = run.basis.spectrum.get(k).copied().unwrap_or(0.0);
            let error = exact - found;
            assert!(error >= -round_off, "{}: lambda_{k} is over by {error:e}", run.name);
            assert!(error <= bound + round_off, "{}: {error:e} of {bound:e}", run.name);
        }
        assert_eq!(run.basis.eigenvalues, run.basis.spectrum[..MODES], "{}", run.name);
    });
}

/// On energies that decay the bound is little more than the largest that could not be found, and what is
/// found is found far better.
#[test]
fn the_bound_is_sharp_where_energies_decay() {
    for_all(|run| {
        let bound = run.basis.error_bound.expect("an approximation");
        if run.spectrum != "fast" {
            return;
        }
        // With energies that fall by half, a rank k leaves twice the energy of the next mode.
        let kept = if run.basis.algorithm == "randomized" { MODES + 10 } else { 2 * MODES + 4 };
        let next = run.exact.spectrum[kept];
        assert!(bound < 3.0 * next, "{}: {bound:e} for {next:e}", run.name);
        for (found, exact) in run.basis.eigenvalues.iter().zip(&run.exact.eigenvalues) {
            let error = 1.0 - found / exact;
            assert!(error < 1e-7, "{}: {exact:e} is off by {error:e}", run.name);
        }
    });
}

/// Two steps of iteration find what is over 1e-11 of the first value to round-off, the rest within the bound.
#[test]
fn randomized_resolves_small_modes() {
    let sigma: Vec<f64> = (0..28).map(|k| 10_f64.powf(-0.5 * f64::from(k))).collect();
    for (product, w) in products(N).into_iter().filter(|(name, _)| *name != "H1") {
        let x = with_singular_values(&sigma, (N, M), &*w, 21);
        let basis = randomized(&snapshots(x.clone()), &*w, &ask(28)).expect("a decomposition");
        let bound = (M as f64 * basis.error_bound.expect("an approximation")).sqrt();
        assert!(basis.size() >= 27 && bound < 1e-12, "{product}: {bound:e}");
        for (got, known) in basis.singular_values.iter().zip(&sigma) {
            let allowed = 2e-15 + if *known < 1e-11 { bound } else { 0.0 };
            assert!((got - known).abs() < allowed, "{product}: {known:e} became {got:e}");
        }
        let phi = basis.modes.as_ref();
        let defect =
            (inner(&*w, phi, phi) - Mat::<f64>::identity(phi.ncols(), phi.ncols())).norm_max();
        assert!(defect < 1e-12, "{product}: {defect:e}");
        let back = basis.reconstruct(basis.coefficients.as_ref()) - &x;
        let error = inner(&*w, back.as_ref(), back.as_ref()).norm_max().sqrt();
        assert!(error < 2e-14 + bound, "{product}: |X - Phi a| = {error:e}");
    }
}

/// An energy asked for is held, with the modes that `svd` would take where energies decay.
#[test]
fn an_energy_asked_for_is_held() {
    let w = Identity::new(N);
    for (spectrum, sigma) in spectra() {
        let x = snapshots(field(&sigma, &w));
        for fraction in [0.5, 0.9, 0.999, 1.0] {
            let options =
                Options { truncation: Truncation::Energy(fraction), ..Options::default() };
            let exact = svd(&x, &w, &options).expect("a decomposition").size();
            for algorithm in APPROXIMATIONS {
                let basis = (algorithm.run)(&x, &w, &options).expect("a decomposition");
                let (name, held) = (algorithm.name, basis.cumulative_percent()[basis.size() - 1]);
                assert!(held >= 100.0 * fraction - 1e-11, "{name}, {spectrum}: {held} %");
                let most = if fraction == 1.0 {
                    M
                } else if spectrum == "fast" {
                    exact
                } else {
                    exact + exact / 5 + 2
                };
                let size = basis.size();
                assert!(size <= most, "{name}, {spectrum}, {fraction}: {size} modes of {exact}");
            }
        }
    }
}

/// Neither threads nor memory nor a second run changes a bit.
#[test]
fn bits_are_always_the_same() {
    let n = 20_001;
    let sigma: Vec<f64> = (0..30).map(|k| 0.6_f64.powi(k)).collect();
    for (product, w) in
        products(n).into_iter().filter(|(name, _)| ["diagonal", "grid"].contains(name))
    {
        let x = snapshots(with_singular_values(&sigma, (n, 90), &*w, 7));
        for algorithm in APPROXIMATIONS {
            let basis = |threads, memory_limit| {
                let par = if threads == 1 { Par::Seq } else { Par::rayon(threads) };
                let options =
                    Options { center: true, par, memory_limit, residuals: true, ..ask(5) };
                (algorithm.run)(&x, &*w, &options).expect("a decomposition")
            };
            let one = basis(1, 1 << 32);
            for (threads, memory) in [(1, 1 << 32), (2, 1 << 32), (3, 1 << 32), (1, 30 << 20)] {
                let other = basis(threads, memory);
                let name = format!("{}, {product}, {threads} threads, {memory}", algorithm.name);
                assert_eq!(one.modes, other.modes, "{name}");
                assert_eq!(one.decomposition, other.decomposition, "{name}");
            }
        }
    }
}

/// A flow that starts from rest, and one whose first snapshots are steady.
#[test]
fn first_snapshots_without_energy_wait_for_others() {
    let w = Identity::new(N);
    let mut x = field(&[1.0, 0.5], &w);
    for (center, start) in [(false, 0.0), (true, 2.0)] {
        x.subcols_mut(0, 130).fill(start);
        let options = Options { center, ..ask(3) };
        let exact = svd(&snapshots(x.clone()), &w, &options).expect("it moves at last");
        let basis = incremental(&snapshots(x.clone()), &w, &options).expect("it moves at last");
        assert!((&basis.modes - &exact.modes).norm_max() < 1e-12, "centred {center}");
        x.fill(start);
        for algorithm in APPROXIMATIONS {
            let nothing = (algorithm.run)(&snapshots(x.clone()), &w, &options);
            let refused = matches!(nothing, Err(PodError::NoEnergy { snapshots: M, .. }));
            assert!(refused, "{}, centred {center}", algorithm.name);
        }
    }
}

/// The residual (32) that is measured on the way is that of the modes.
#[test]
fn residuals_are_those_of_the_modes() {
    let w = common::grid(N);
    let sigma: Vec<f64> = (0..12).map(|k| 0.3_f64.powi(k)).collect();
    let x = snapshots(field(&sigma, &w));
    let options = Options { center: true, residuals: true, ..ask(MODES) };
    for algorithm in APPROXIMATIONS {
        let basis = (algorithm.run)(&x, &w, &options).expect("a decomposition");
        let measured = lumley_pod::projection_residuals(&basis, &x, &w).expect("finite fields");
        for (told, known) in basis.residuals.iter().zip(&measured) {
            assert!((told / known - 1.0).abs() < 1e-8, "{}: {told} {known}", algorithm.name);
        }
        assert_eq!(basis.residuals.len(), MODES);
    }
}

/// Where the damage is, counted from the first snapshot of all.
#[test]
fn bad_input_is_refused() {
    let (w, mut damaged) = (Identity::new(N), field(&[1.0, 0.5, 0.2], &Identity::new(N)));
    damaged[(7, 140)] = f64::INFINITY;
    for algorithm in APPROXIMATIONS {
        let run = |x: &Mat<f64>, options: &Options| {
            (algorithm.run)(&snapshots(x.clone()), &w, options).expect_err("bad input").to_string()
        };
        let told = run(&damaged, &ask(4));
        assert!(told.contains("snapshot 140") && told.contains("row 7"), "{told}");
        assert!(run(&damaged, &ask(0)).starts_with("0 modes"), "{}", algorithm.name);
        let small = Options { memory_limit: 1000, ..ask(4) };
        assert!(run(&damaged, &small).contains("the limit is"), "{}", algorithm.name);
    }
}

/// As many as there are.
#[test]
fn any_number_of_modes_may_be_asked_for() {
    let w = Identity::new(N);
    let x = snapshots(field(&[1.0, 0.5, 0.2], &w));
    for algorithm in APPROXIMATIONS {
        let basis = (algorithm.run)(&x, &w, &ask(usize::MAX)).expect("a decomposition");
        assert_eq!(basis.size(), 4, "{}: {:?}", algorithm.name, basis.spectrum);
    }
}
