//! An old factorisation in single precision, and when it is renewed.

use crate::oseen::{Grid, Oseen, System, noise, relative_residual};
use faer::Par;
use lumley_fom::linear::{
    Analysis, GmresLimits, LaggedError, LaggedSolver, LaggedStep, RenewalPolicy,
};

const STEPS: usize = 60;
const PRICE: f64 = 6.0;

/// A channel whose wind and step change with time.
fn system(step: usize) -> System {
    let map = |[x, y]: [f64; 2]| [2.0 * x, y];
    let grid = Grid { cells: [16, 8], map, periodic: false, outlet: true };
    let wind = |[x, y]: [f64; 2]| [1.0 + y, 0.5 * x];
    let rate = 100.0 + 4.0 * step as f64;
    grid.assemble(&Oseen { viscosity: 0.01, rate, wind, condensed: true }, false)
}

fn solver(system: &System) -> LaggedSolver {
    let cells = system.unknowns.clone();
    let analysis = Analysis::new(cells, &system.centroids, &system.delay());
    LaggedSolver::new(analysis, GmresLimits::default(), RenewalPolicy::new(PRICE), Par::Seq)
}

fn run(
    solver: &mut LaggedSolver,
    steps: std::ops::Range<usize>,
) -> Result<Vec<LaggedStep>, LaggedError> {
    let mut x = vec![0.0; system(0).unknowns.count()];
    steps
        .map(|step| {
            let system = system(step);
            let b = noise(x.len());
            let done = solver.solve(&system.matrices, &b, &mut x)?;
            let residual = relative_residual(&system, &x, &b);
            assert!(residual < 1.01e-10, "step {step}: {residual:e}");
            Ok(done)
        })
        .collect()
}

fn cost(steps: &[LaggedStep]) -> f64 {
    steps.iter().map(|s| s.iterations as f64 + if s.renewed { PRICE } else { 0.0 }).sum()
}

#[test]
fn renewals_keep_the_cost_low() -> Result<(), LaggedError> {
    let steps = run(&mut solver(&system(0)), 0..STEPS)?;
    let renewals = steps.iter().filter(|s| s.renewed).count();
    assert!(steps[0].renewed && (2..STEPS / 4).contains(&renewals), "{renewals} renewals");
    let mut always = solver(&system(0));
    let mut fresh = Vec::new();
    for step in 0..STEPS {
        always.forget();
        fresh.extend(run(&mut always, step..step + 1)?);
    }
    assert!(fresh.iter().all(|s| s.renewed));
    assert!(cost(&steps) < 0.75 * cost(&fresh), "{} beside {}", cost(&steps), cost(&fresh));
    Ok(())
}

/// A run that forgets at a checkpoint goes on as one that starts there.
#[test]
fn what_follows_a_checkpoint_does_not_depend_on_the_past() -> Result<(), LaggedError> {
    let mut whole = solver(&system(0));
    run(&mut whole, 0..7)?;
    whole.forget();
    assert_eq!(run(&mut whole, 7..20)?, run(&mut solver(&system(0)), 7..20)?);
    Ok(())
}

/// An old factorisation of another flow altogether is renewed at once; a singular matrix is an error.
#[test]
fn failures_renew() -> Result<(), LaggedError> {
    let mut solver = solver(&system(0));
    run(&mut solver, 0..2)?;
    let mut far = system(0);
    let pattern = noise(far.matrices.len());
    for (a, n) in far.matrices.iter_mut().zip(&pattern) {
        *a *= 1.0 + 1.9 * n;
    }
    let b = noise(far.unknowns.count());
    let mut x = vec![0.0; b.len()];
    let step = solver.solve(&far.matrices, &b, &mut x)?;
    assert!(step.renewed && relative_residual(&far, &x, &b) < 1.01e-10);
    far.matrices.fill(0.0);
    let refused = solver.solve(&far.matrices, &b, &mut x);
    assert!(matches!(refused, Err(LaggedError::Singular(_))), "{refused:?}");
    run(&mut solver, 0..1)?;
    Ok(())
}

/// The policy alone: iterations grow by one every third step.
#[test]
fn the_average_is_least_where_it_renews() {
    let iterations = |age: usize| 2 + age / 3;
    let mut policy = RenewalPolicy::new(12.0);
    assert!(policy.is_due());
    policy.renewed();
    let mut age = 0;
    while !policy.is_due() {
        policy.solved(iterations(age));
        age += 1;
    }
    let average = |n: usize| (12.0 + (0..n).map(iterations).sum::<usize>() as f64) / n as f64;
    let best = (1..100).map(average).fold(f64::INFINITY, f64::min);
    assert!(average(age) <= 1.05 * best, "{} beside {best} after {age}", average(age));
}
