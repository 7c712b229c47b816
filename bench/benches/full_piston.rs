//! The full-order piston, 800 linear cells, BDF2, beside the bare tridiagonal solves in it.

use criterion::{Criterion, criterion_group, criterion_main};
use lumley_body::joint::Prismatic;
use lumley_fom::linear::{BorderRow, BorderedTridiagonal, CellMatrix};
use lumley_fom::{InitialFlow, Piston, PistonParameters, TimeScheme};
use std::hint::black_box;
use std::time::Instant;

const CELLS: usize = 800;
const STEPS: usize = 4000;
const DT: f64 = 5e-4;

/// Case B, the coupled one.
fn piston(degree: usize, scheme: TimeScheme) -> Piston {
    let parameters = PistonParameters {
        viscosity: 0.2,
        domain_length: 1.1,
        force_factor: 1.0,
        joint: Prismatic { mass: 0.5, stiffness: 39.5, damping: 0.1, rest_length: 0.95 },
        initial_position: 0.9,
        initial_velocity: 0.0,
        initial_flow: InitialFlow::Zero,
    };
    Piston::new(&parameters, CELLS, degree, scheme).expect("the canonical piston")
}

/// Two seconds of the canonical case; returns the number of linear solves.
fn run(degree: usize, scheme: TimeScheme) -> usize {
    let mut piston = piston(degree, scheme);
    (0..STEPS).map(|_| piston.step(DT).expect("a good step").iterations).sum()
}

/// A system with the entries of such a step: mass times rate, and viscosity.
fn system() -> BorderedTridiagonal {
    let (mass, viscous) = (1.5 / DT / CELLS as f64, 0.2 * CELLS as f64 / 0.81);
    let [diagonal, side] = [mass / 3.0 + viscous, mass / 6.0 - viscous];
    let cell = CellMatrix { vertex: [[diagonal, side], [side, diagonal]], border: [1e-3, 2e-3] };
    let mut system = BorderedTridiagonal::new(CELLS);
    system.matrices.fill(cell);
    system.residuals.fill([1e-4, 2e-4]);
    system
}

const ROW: BorderRow = BorderRow { neighbour: -100.0, diagonal: 1e4, residual: 1.0 };

fn seconds(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

/// The step over the bare solves of it: best of several runs of each, in turns.
fn ratio() {
    let mut bare = system();
    let solves = run(1, TimeScheme::Bdf2);
    let (mut step, mut solve) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..15 {
        step = step.min(seconds(|| {
            black_box(run(1, TimeScheme::Bdf2));
        }));
        solve = solve.min(seconds(|| (0..solves).for_each(|_| black_box(&mut bare).solve(ROW))));
    }
    let micro = 1e6 / STEPS as f64;
    println!("P1, BDF2, {CELLS} cells: {:.2} solves a step", solves as f64 / STEPS as f64);
    println!("  step              {:8.2} us", step * micro);
    println!("  its bare solves   {:8.2} us", solve * micro);
    println!("  ratio             {:8.2}", step / solve);
}

fn benchmark(c: &mut Criterion) {
    ratio();
    let mut group = c.benchmark_group("full piston");
    group.sample_size(10);
    for degree in [1, 2] {
        for scheme in [TimeScheme::ImplicitEuler, TimeScheme::CrankNicolson, TimeScheme::Bdf2] {
            let name = format!("{STEPS} steps, degree {degree}, {scheme:?}");
            group.bench_function(name, |b| b.iter(|| black_box(run(degree, scheme))));
        }
    }
    let mut bare = system();
    group.bench_function("one bare solve", |b| b.iter(|| black_box(&mut bare).solve(ROW)));
    group.finish();
}

criterion_group!(benches, benchmark);
criterion_main!(benches);
