//! GMRES on small systems whose behaviour is known.

use crate::oseen::noise;
use lumley_fom::linear::{Gmres, GmresError, GmresLimits};

const COUNT: usize = 60;

/// Upwind convection and diffusion on a line.
fn multiply(x: &[f64], y: &mut [f64]) {
    for i in 0..x.len() {
        let left = if i > 0 { x[i - 1] } else { 0.0 };
        let right = x.get(i + 1).copied().unwrap_or(0.0);
        y[i] = 3.0 * x[i] - 2.0 * left - 0.5 * right;
    }
}

fn identity(x: &[f64], y: &mut [f64]) {
    y.copy_from_slice(x);
}

fn residual(multiply: impl Fn(&[f64], &mut [f64]), x: &[f64], b: &[f64]) -> f64 {
    let mut y = vec![0.0; b.len()];
    multiply(x, &mut y);
    let norm = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    norm(&y.iter().zip(b).map(|(y, b)| b - y).collect::<Vec<_>>()) / norm(b)
}

#[test]
fn the_residual_is_what_was_asked_for() -> Result<(), GmresError> {
    let b = noise(COUNT);
    for restart in [5, 20, COUNT] {
        for tolerance in [1e-3, 1e-10] {
            let limits = GmresLimits { tolerance, restart, iterations: 500 };
            let mut x = vec![0.0; COUNT];
            let iterations = Gmres::new(COUNT, limits).solve(multiply, identity, &b, &mut x)?;
            let residual = residual(multiply, &x, &b);
            assert!(residual <= 1.01 * tolerance, "{residual:e} after {iterations}");
            assert!(restart < COUNT || iterations <= COUNT);
        }
    }
    Ok(())
}

#[test]
fn a_perfect_preconditioner_takes_one_iteration_and_a_perfect_start_none() -> Result<(), GmresError>
{
    let diagonal = |k: usize| 1.0 + k as f64;
    let matrix = |x: &[f64], y: &mut [f64]| (0..COUNT).for_each(|k| y[k] = diagonal(k) * x[k]);
    let inverse = |x: &[f64], y: &mut [f64]| (0..COUNT).for_each(|k| y[k] = x[k] / diagonal(k));
    let mut gmres = Gmres::new(COUNT, GmresLimits::default());
    let (b, mut x) = (noise(COUNT), vec![0.0; COUNT]);
    assert_eq!(gmres.solve(matrix, inverse, &b, &mut x)?, 1);
    assert_eq!(gmres.solve(matrix, inverse, &b, &mut x)?, 0);
    assert_eq!(gmres.solve(matrix, inverse, &[0.0; COUNT], &mut x)?, 0);
    assert_eq!(x, [0.0; COUNT]);
    Ok(())
}

/// The preconditioner may change in every iteration.
#[test]
fn the_preconditioner_is_flexible() -> Result<(), GmresError> {
    let mut calls = 0_usize;
    let fickle = |x: &[f64], y: &mut [f64]| {
        calls += 1;
        for (k, (y, x)) in y.iter_mut().zip(x).enumerate() {
            *y = x * (1.0 + 0.3 * ((calls + k) % 3) as f64);
        }
    };
    let (b, mut x) = (noise(COUNT), vec![0.0; COUNT]);
    Gmres::new(COUNT, GmresLimits::default()).solve(multiply, fickle, &b, &mut x)?;
    assert!(residual(multiply, &x, &b) < 1.01e-10);
    Ok(())
}

#[test]
fn failures_have_names() {
    let limits = GmresLimits { restart: 10, ..GmresLimits::default() };
    let mut gmres = Gmres::new(COUNT, limits);
    let mut solve = |operator: &dyn Fn(&[f64], &mut [f64]), b: &[f64]| {
        gmres.solve(operator, identity, b, &mut [0.0; COUNT])
    };
    // A cyclic shift: the residual stays until the space is whole.
    let shift = |x: &[f64], y: &mut [f64]| (0..COUNT).for_each(|k| y[k] = x[(k + 1) % COUNT]);
    let mut unit = [0.0; COUNT];
    unit[0] = 1.0;
    let stagnation = GmresError::Stagnation { iterations: 10, residual: 1.0, tolerance: 1e-10 };
    assert_eq!(solve(&shift, &unit), Err(stagnation));
    // A projection whose range lacks the right-hand side.
    let singular = |x: &[f64], y: &mut [f64]| {
        y.copy_from_slice(x);
        y[0] = 0.0;
    };
    let broken = solve(&singular, &unit);
    assert!(matches!(broken, Err(GmresError::Breakdown { iterations: 1, .. })), "{broken:?}");
    let poison = |_: &[f64], y: &mut [f64]| y.fill(f64::NAN);
    assert_eq!(solve(&poison, &unit), Err(GmresError::NotFinite { iteration: 0 }));
    let few = GmresLimits { iterations: 7, ..limits };
    let short = Gmres::new(COUNT, few).solve(multiply, identity, &noise(COUNT), &mut [0.0; COUNT]);
    assert!(matches!(short, Err(GmresError::Iterations { iterations: 7, .. })), "{short:?}");
}
