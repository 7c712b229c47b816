//! Times the multifrontal factorisation of condensed Oseen problems beside faer's sparse LU and, with the feature
//! `mumps`, MUMPS.
//!
//! ```text
//! front_timing REPEATS
//! ```
//!
//! Rings of cells round a cylinder, Q2 velocities and discontinuous linear pressures, about 10, 40 and 150
//! thousand unknowns before the interior ones are eliminated. Prints a line of JSON for each: CPU
//! times in ms (medians; the direct solvers take turns), one thread; residuals relative to the right-hand side. The matrix
//! of faer and MUMPS is assembled beforehand, which is not counted.
//!
//! MUMPS is Debian's sequential one (`libmumps-seq-dev`). It spends its time in the BLAS: take a fast one with one
//! thread (`libopenblas0-serial`), not the reference library.
//!
//! ```text
//! OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 \
//!     cargo run --release --manifest-path bench/Cargo.toml --features mumps --bin front_timing -- 5
//! ```

#[expect(dead_code, reason = "the tests use more of it")]
#[path = "../../../../crates/fom/tests/linear/oseen/mod.rs"]
mod oseen;
mod solvers;

use faer::Par;
use lumley_fom::linear::{Analysis, GmresLimits, LaggedSolver, RenewalPolicy};
use oseen::{Grid, Oseen, System, relative_residual};
use rustix::time::{ClockId, clock_gettime};
use serde_json::{Map, Value, json};
use solvers::Analyse;
use std::env;
use std::error::Error;
use std::num::NonZeroUsize;
use std::sync::Arc;

/// Cells round the cylinder and across the ring.
const RINGS: [[usize; 2]; 3] = [[44, 22], [88, 42], [168, 82]];
const STEPS: usize = 100;

fn main() -> Result<(), Box<dyn Error>> {
    let repeats = env::args().nth(1).ok_or("front_timing REPEATS")?.parse::<NonZeroUsize>()?;
    for cells in RINGS {
        println!("{}", time(cells, repeats.get())?);
    }
    Ok(())
}

/// The flow of an impulsively started ring, step 0.02; the wind turns with `step`.
fn ring(cells: [usize; 2], step: usize) -> System {
    let map = |[x, y]: [f64; 2]| {
        let (radius, angle) = (0.5 * 30f64.powf(y), -std::f64::consts::TAU * x);
        [radius * angle.cos(), radius * angle.sin()]
    };
    let wind = |[x, y]: [f64; 2]| {
        let square = x * x + y * y;
        [1.0 - 0.25 * (x * x - y * y) / (square * square), -0.5 * x * y / (square * square)]
    };
    let grid = Grid { cells, map, periodic: true, outlet: false };
    let rate = 75.0 * (1.0 + 0.002 * step as f64);
    grid.assemble(&Oseen { viscosity: 0.01, rate, wind, condensed: true }, true)
}

fn time(cells: [usize; 2], repeats: usize) -> Result<Value, Box<dyn Error>> {
    let system = ring(cells, 0);
    let analysis = Analysis::new(system.unknowns.clone(), &system.centroids, &system.delay());
    let matrix = solvers::assembled(&system)?;
    let solvers = solvers::all(&system, &matrix);
    let mut rounds = vec![Vec::new(); solvers.len()];
    for _ in 0..repeats {
        for ((_, analyse), rounds) in solvers.iter().zip(&mut rounds) {
            rounds.push(round(&system, analyse)?);
        }
    }
    let direct: Map<String, Value> = solvers
        .iter()
        .zip(&rounds)
        .map(|((name, _), rounds)| (name.clone(), medians(rounds)))
        .collect();
    Ok(json!({
        "unknowns": system.whole,
        "condensed": system.unknowns.count(),
        "entries": analysis.entries(),
        "operations": analysis.operations(),
        "direct": direct,
        "lagged": lagged(cells, &system, &analysis)?,
    }))
}

/// CPU times of analysis, second factorisation and solution, and the residual.
fn round(system: &System, analyse: &Analyse<'_>) -> Result<[f64; 4], Box<dyn Error>> {
    let (analysed, solver) = timed(analyse);
    let mut solver = solver?;
    solver.factorise()?;
    let (factorised, done) = timed(|| solver.factorise());
    done?;
    let mut x = system.rhs.clone();
    let (solved, done) = timed(|| solver.solve(&mut x));
    done?;
    Ok([analysed, factorised, solved, relative_residual(system, &x, &system.rhs)])
}

/// CPU time for each step of a sequence of changing matrices, assembly not counted.
fn lagged(
    cells: [usize; 2],
    first: &System,
    analysis: &Arc<Analysis>,
) -> Result<Value, Box<dyn Error>> {
    let (limits, policy) = (GmresLimits::default(), RenewalPolicy::new(6.0));
    let mut solver = LaggedSolver::new(analysis.clone(), limits, policy, Par::Seq);
    let mut x = vec![0.0; first.rhs.len()];
    let (mut spent, mut iterations, mut renewals) = (0.0, 0, 0);
    for step in 0..STEPS {
        let system = ring(cells, step);
        let (time, done) = timed(|| solver.solve(&system.matrices, &system.rhs, &mut x));
        let done = done?;
        spent += time;
        iterations += done.iterations;
        renewals += usize::from(done.renewed);
    }
    Ok(json!({
        "step": spent / STEPS as f64,
        "iterations": iterations as f64 / STEPS as f64,
        "renewals": renewals,
    }))
}

fn medians(rounds: &[[f64; 4]]) -> Value {
    let [analyse, factorise, solve, residual] = [0, 1, 2, 3].map(|column| {
        let mut values: Vec<f64> = rounds.iter().map(|round| round[column]).collect();
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    });
    json!({ "analyse": analyse, "factorise": factorise, "solve": solve, "residual": residual })
}

/// CPU time of the process in ms, all threads together, and what the work gave.
fn timed<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let now = || {
        let time = clock_gettime(ClockId::ProcessCPUTime);
        time.tv_sec as f64 * 1e3 + 1e-6 * time.tv_nsec as f64
    };
    let start = now();
    let done = work();
    (now() - start, done)
}
