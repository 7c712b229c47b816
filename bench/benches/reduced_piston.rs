//! Time of one RK4 step of the reduced piston, by the thousand.
//!
//! `bench/numba_piston.py` times the same steps compiled from Python.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use faer::Mat;
use lumley_body::joint::Prismatic;
use lumley_fem::UniformGrid;
use lumley_rom::{
    Basis, ClosureKind, Integrator, ModelChoice, Multiplier, Penalty, PistonPhysics, PistonStart,
    ProjectionKind, ReducedError, ReducedPiston,
};
use std::f64::consts::{PI, SQRT_2};

const STEPS: u64 = 1000;
const STEP: f64 = 1e-4;
const LENGTH: f64 = 1.1;
const NODES: usize = 401;

/// Modes by Gram and Schmidt in the P1 mass matrix: a kink at 0.95 m and sines before it.
fn grid_modes(count: usize) -> Mat<f64> {
    let h = LENGTH / (NODES - 1) as f64;
    let product = |f: &[f64], g: &[f64]| -> f64 {
        let cell = |i: usize| {
            2.0 * (f[i] * g[i] + f[i + 1] * g[i + 1]) + f[i] * g[i + 1] + f[i + 1] * g[i]
        };
        (0..NODES - 1).map(|i| h / 6.0 * cell(i)).sum()
    };
    let mut modes: Vec<Vec<f64>> = Vec::new();
    for k in 0..count {
        let f = |x: f64| if k == 0 { x } else { (k as f64 * PI * x).sin() };
        let mut mode: Vec<f64> = (0..NODES).map(|i| f((i as f64 * h / 0.95).min(1.0))).collect();
        for earlier in &modes {
            let part = product(earlier, &mode);
            mode.iter_mut().zip(earlier).for_each(|(m, e)| *m -= part * e);
        }
        let norm = product(&mode, &mode).sqrt();
        mode.iter_mut().for_each(|m| *m /= norm);
        modes.push(mode);
    }
    Mat::from_fn(NODES, count, |i, k| modes[k][i])
}

/// A basis of `count` modes in the frame of the projection.
fn basis(projection: ProjectionKind, count: usize) -> Result<Basis, ReducedError> {
    if projection != (ProjectionKind::Mapped {}) {
        let grid = UniformGrid::line(0.0, LENGTH, NODES);
        return Basis::on_grid(&grid, grid_modes(count).as_ref(), None);
    }
    let nodes: Vec<f64> = (0..=800).map(|i| f64::from(i) / 800.0).collect();
    // The interpolant of a sine is an eigenvector of the mass matrix: scaled, it has the norm one.
    let sine = |i: usize, k: usize| {
        let angle = (k + 1) as f64 * PI;
        let norm = ((2.0 + (angle / 800.0).cos()) / 3.0).sqrt();
        if i == 800 { 0.0 } else { SQRT_2 / norm * (angle * nodes[i]).sin() }
    };
    Basis::on_reference(&nodes, 1, Mat::from_fn(801, count, sine).as_ref(), None)
}

fn piston(projection: ProjectionKind, modes: usize) -> Result<ReducedPiston, ReducedError> {
    let joint = Prismatic { mass: 0.5, stiffness: 39.5, damping: 0.1, rest_length: 0.95 };
    let physics = PistonPhysics { viscosity: 0.2, force_factor: 1.0, domain_length: LENGTH, joint };
    let model = ModelChoice { projection, closure: ClosureKind::default() };
    let start = PistonStart { coefficients: vec![0.01; modes], position: 0.9, velocity: 0.0 };
    ReducedPiston::new(&physics, &model, Integrator::Rk4 {}, &basis(projection, modes)?, &start)
}

fn steps(c: &mut Criterion) {
    let mut group = c.benchmark_group("reduced piston");
    group.throughput(Throughput::Elements(STEPS));
    for projection in [
        ProjectionKind::Multiplier(Multiplier::default()),
        ProjectionKind::Penalty(Penalty::default()),
        ProjectionKind::Mapped {},
    ] {
        for modes in [6, 10] {
            let mut piston = piston(projection, modes).expect("orthonormal modes");
            let mut start = Vec::new();
            piston.save(&mut start).expect("memory");
            group.bench_function(format!("{}, N = {modes}", projection.name()), |b| {
                b.iter(|| {
                    piston.restore(&mut start.as_slice()).expect("its own checkpoint");
                    (0..STEPS).try_for_each(|_| piston.step(STEP)).expect("a stable step");
                });
            });
        }
    }
    group.finish();
}

criterion_group!(benches, steps);
criterion_main!(benches);
