//! The integrators on standard problems.

use super::*;

/// A system given by its right-hand side.
struct Problem<F>(F);

impl<F: FnMut(&[f64], &mut [f64])> System for Problem<F> {
    fn rates(&mut self, y: &[f64], rates: &mut [f64]) {
        (self.0)(y, rates);
    }
}

/// Integrates from 0 to `end` in `steps` steps.
fn solve(
    stepper: &mut dyn Stepper,
    f: impl FnMut(&[f64], &mut [f64]),
    start: &[f64],
    end: f64,
    steps: u32,
) -> Vec<f64> {
    let mut system = Problem(f);
    let (mut y, mut rates) = (start.to_vec(), vec![0.0; start.len()]);
    system.rates(&y, &mut rates);
    for _ in 0..steps {
        let dt = end / f64::from(steps);
        stepper.step(&mut system, &mut y, &mut rates, dt).expect("a step that is accepted");
    }
    y
}

/// The pendulum in the form of Lotka and Volterra, smooth and nonlinear.
fn lotka_volterra(y: &[f64], rates: &mut [f64]) {
    rates[0] = y[0] * (1.0 - y[1]);
    rates[1] = y[1] * (y[0] - 2.0);
}

fn van_der_pol(stiffness: f64) -> impl FnMut(&[f64], &mut [f64]) {
    move |y, rates| {
        rates[0] = y[1];
        rates[1] = ((1.0 - y[0] * y[0]) * y[1] - y[0]) * stiffness;
    }
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

#[test]
fn rk4_has_order_4() {
    let run = |steps| solve(&mut Rk4::new(2), lotka_volterra, &[1.0, 0.5], 2.0, steps);
    let exact = run(4000);
    let [coarse, fine] = [40, 80].map(|steps| distance(&run(steps), &exact));
    let order = (coarse / fine).log2();
    assert!((order - 4.0).abs() < 0.1, "order {order}");
}

/// With the tolerance out of the way every step is taken whole.
#[test]
fn rodas_has_order_4() {
    let exact = solve(&mut Rk4::new(2), lotka_volterra, &[1.0, 0.5], 2.0, 4000);
    let run = |steps| {
        let mut method = Rodas4::new(2, 1e3);
        method.resume(f64::INFINITY);
        solve(&mut method, lotka_volterra, &[1.0, 0.5], 2.0, steps)
    };
    let [coarse, fine] = [100, 200].map(|steps| distance(&run(steps), &exact));
    let order = (coarse / fine).log2();
    assert!((order - 4.0).abs() < 0.1, "order {order}");
}

/// One step far beyond the stable one of any explicit method leaves nothing of a fast decay, and is
/// right in the slow component.
#[test]
fn rodas_is_l_stable() {
    let mut method = Rodas4::new(2, 1e3);
    method.resume(f64::INFINITY);
    let f = |y: &[f64], rates: &mut [f64]| {
        rates[0] = -1e9 * (y[0] - y[1]);
        rates[1] = -y[1];
    };
    let y = solve(&mut method, f, &[2.0, 1.0], 0.1, 1);
    let slow = (-0.1_f64).exp();
    assert!((y[1] - slow).abs() < 1e-6, "slow {} and {slow}", y[1]);
    assert!((y[0] - y[1]).abs() < 1e-6, "fast {} and {}", y[0], y[1]);
}

/// Van der Pol's oscillator with ε = 1e-6 at t = 2; the reference is that of the test set of Mazzia and
/// Magherini (2008).
#[test]
fn rodas_solves_the_stiff_van_der_pol_oscillator() {
    let mut method = Rodas4::new(2, 1e-8);
    let y = solve(&mut method, van_der_pol(1e6), &[2.0, 0.0], 2.0, 4);
    let gap = distance(&y, &[1.706_167_732_170_483, -0.892_809_701_024_797_5]);
    assert!(gap < 1e-5, "{y:?}, {gap:e}");
}

/// Robertson's kinetics at t = 40; the sum of the concentrations stays one.
#[test]
fn rodas_solves_robertsons_kinetics() {
    let f = |y: &[f64], rates: &mut [f64]| {
        let (slow, fast, back) = (0.04 * y[0], 3e7 * y[1] * y[1], 1e4 * y[1] * y[2]);
        rates.copy_from_slice(&[back - slow, slow - back - fast, fast]);
    };
    let y = solve(&mut Rodas4::new(3, 1e-9), f, &[1.0, 0.0, 0.0], 40.0, 4);
    let exact = [0.715_827_068_7, 9.185_534_765e-6, 0.284_163_745_7];
    assert!(distance(&y, &exact) < 1e-6, "{y:?}");
    assert!((y[1] / exact[1] - 1.0).abs() < 1e-4, "{y:?}");
    assert!((y.iter().sum::<f64>() - 1.0).abs() < 1e-9);
}

/// The error falls with the tolerance.
#[test]
fn tolerance_controls_the_error() {
    let exact = solve(&mut Rk4::new(2), van_der_pol(5.0), &[2.0, 0.0], 5.0, 100_000);
    let error = |tolerance| {
        let mut method = Rodas4::new(2, tolerance);
        distance(&solve(&mut method, van_der_pol(5.0), &[2.0, 0.0], 5.0, 1), &exact)
    };
    for tolerance in [1e-4, 1e-6, 1e-8] {
        let found = error(tolerance);
        assert!(found < 300.0 * tolerance, "{tolerance:e}: {found:e}");
        assert!(found > 1e-3 * tolerance, "{tolerance:e}: {found:e}: far too careful");
    }
}

/// y' = y² from 1 ends at t = 1: no step is accepted across.
#[test]
fn rodas_gives_up_at_a_singularity() {
    let mut system = Problem(|y: &[f64], rates: &mut [f64]| rates[0] = y[0] * y[0]);
    let (mut y, mut rates) = ([1.0], [1.0]);
    let outcome = Rodas4::new(1, 1e-6).step(&mut system, &mut y, &mut rates, 2.0);
    assert!(outcome.is_err(), "arrived at {y:?}");
}

/// The bound on systems whose spectral radius is known, one with a complex pair.
#[test]
fn stable_step_is_the_bound_over_the_spectral_radius() {
    let mut decays = Problem(|y: &[f64], rates: &mut [f64]| {
        rates.copy_from_slice(&[-3.0 * y[0], -400.0 * y[1] + 7.0 * y[0], -399.0 * y[2]]);
    });
    let found = stable_step(&mut decays, &[0.1, 0.0, 0.9], 0.9);
    assert!((found * 400.0 / 2.785 - 1.0).abs() < 0.01, "{found}");
    let mut swings = Problem(|y: &[f64], rates: &mut [f64]| {
        rates.copy_from_slice(&[y[1], -79.0 * y[0] - 0.2 * y[1]]);
    });
    let found = stable_step(&mut swings, &[0.0, 0.0], 1.0);
    assert!((found * 79_f64.sqrt() / 2.785 - 1.0).abs() < 0.05, "{found}");
    let mut rests = Problem(|_: &[f64], rates: &mut [f64]| rates.fill(0.0));
    assert_eq!(stable_step(&mut rests, &[1.0], 1.0), f64::INFINITY);
}

/// `y' = y0²/y` changes over lengths of y0, here a micrometre: its slope is −1 there.
#[test]
fn stable_step_looks_closely_enough() {
    let size = 1e-6;
    let mut system = Problem(|y: &[f64], rates: &mut [f64]| rates[0] = size * size / y[0]);
    let found = stable_step(&mut system, &[size], size);
    assert!((found / 2.785_293_563 - 1.0).abs() < 1e-6, "{found}");
}

/// An oscillation of which the step asked for holds far more than a million substeps.
#[test]
fn rodas_counts_its_substeps() {
    let omega = 1e5;
    let mut system = Problem(|y: &[f64], rates: &mut [f64]| {
        rates[0] = omega * y[1];
        rates[1] = -omega * y[0];
    });
    let (mut y, mut rates) = ([1.0, 0.0], [0.0, -omega]);
    let seen = Rodas4::new(2, 1e-12).step(&mut system, &mut y, &mut rates, 1.0);
    let Err(Divergence::Substeps { count: 1_000_000, left }) = seen else { panic!("{seen:?}") };
    assert!(left > 0.0 && left < 1.0, "{left}");
}
