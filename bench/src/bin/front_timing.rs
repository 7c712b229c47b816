//! Times the multifrontal factorisation of condensed Oseen problems beside faer's sparse LU.
//!
//! ```text
//! front_timing REPEATS
//! ```
//!
//! Rings of cells round a cylinder, Q2 velocities and discontinuous linear pressures, about 10, 40 and 150
//! thousand unknowns before the interior ones are eliminated. Prints a line of JSON for each: CPU
//! times in ms (medians), one thread; residuals relative to the right-hand side.

#[expect(dead_code, reason = "the tests use more of it")]
#[path = "../../../crates/fom/tests/linear/oseen/mod.rs"]
mod oseen;

use faer::Par;
use faer::prelude::Solve;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{SparseColMat, Triplet};
use lumley_fom::linear::{
    Analysis, GmresLimits, LaggedSolver, Multifrontal, RenewalPolicy, Scalar,
};
use oseen::{Grid, Oseen, System, relative_residual};
use rustix::time::{ClockId, clock_gettime};
use serde_json::{Value, json};
use std::env;
use std::error::Error;
use std::sync::Arc;

/// Cells round the cylinder and across the ring.
const RINGS: [[usize; 2]; 3] = [[44, 22], [88, 42], [168, 82]];
const STEPS: usize = 100;

fn main() -> Result<(), Box<dyn Error>> {
    let repeats = env::args().nth(1).ok_or("front_timing REPEATS")?.parse()?;
    for cells in RINGS {
        println!("{}", time(cells, repeats)?);
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
    let centroids = &system.centroids;
    let mut analysis = None;
    let analysed = median(repeats, || {
        analysis = Some(Analysis::new(system.unknowns.clone(), centroids, &system.delay()));
    });
    let analysis = analysis.ok_or("at least one repeat")?;
    Ok(json!({
        "unknowns": system.whole,
        "condensed": system.unknowns.count(),
        "entries": analysis.entries(),
        "operations": analysis.operations(),
        "analysis": analysed,
        "f64": own::<f64>(&system, &analysis, repeats)?,
        "f32": own::<f32>(&system, &analysis, repeats)?,
        "lagged": lagged(cells, &system, &analysis)?,
        "faer": faer(&system, repeats)?,
    }))
}

fn own<T: Scalar>(
    system: &System,
    analysis: &Arc<Analysis>,
    repeats: usize,
) -> Result<Value, Box<dyn Error>> {
    let mut lu = Multifrontal::<T>::new(analysis.clone(), Par::Seq);
    lu.factorise(&system.matrices)?;
    let factorise = median(repeats, || lu.factorise(&system.matrices).expect("done before"));
    let mut x = system.rhs.clone();
    let solve = median(repeats, || {
        x.copy_from_slice(&system.rhs);
        lu.solve(&mut x);
    });
    let residual = relative_residual(system, &x, &system.rhs);
    Ok(json!({ "factorise": factorise, "solve": solve, "residual": residual }))
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
        let start = cpu_ms();
        let done = solver.solve(&system.matrices, &system.rhs, &mut x)?;
        spent += cpu_ms() - start;
        iterations += done.iterations;
        renewals += usize::from(done.renewed);
    }
    Ok(json!({
        "step": spent / STEPS as f64,
        "iterations": iterations as f64 / STEPS as f64,
        "renewals": renewals,
    }))
}

fn faer(system: &System, repeats: usize) -> Result<Value, Box<dyn Error>> {
    faer::set_global_parallelism(Par::Seq);
    let mut triplets = Vec::new();
    for cell in 0..system.unknowns.cells() {
        let unknowns = system.unknowns.of(cell);
        let matrix = &system.matrices[system.unknowns.matrix(cell)];
        for (column, &j) in matrix.chunks_exact(unknowns.len()).zip(unknowns) {
            let entry = |(&i, &a): (&u32, &f64)| Triplet::new(i as usize, j as usize, a);
            triplets.extend(unknowns.iter().zip(column).map(entry));
        }
    }
    let n = system.unknowns.count();
    let matrix = SparseColMat::<usize, f64>::try_new_from_triplets(n, n, &triplets)?;
    let symbolic = SymbolicLu::try_new(matrix.symbolic())?;
    let mut lu = None;
    let factorise = median(repeats.min(3), || {
        lu = Some(Lu::try_new_with_symbolic(symbolic.clone(), matrix.as_ref()));
    });
    let lu = lu.ok_or("at least one repeat")??;
    let b = faer::Col::from_fn(n, |i| system.rhs[i]);
    let mut x = Vec::new();
    let solve = median(repeats, || x = lu.solve(&b).iter().copied().collect());
    let residual = relative_residual(system, &x, &system.rhs);
    Ok(json!({ "factorise": factorise, "solve": solve, "residual": residual }))
}

/// Median CPU time in ms.
fn median(repeats: usize, mut work: impl FnMut()) -> f64 {
    let once = |_| {
        let start = cpu_ms();
        work();
        cpu_ms() - start
    };
    let mut times: Vec<f64> = (0..repeats).map(once).collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// CPU time of the process in ms, all threads together.
fn cpu_ms() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 * 1e3 + 1e-6 * time.tv_nsec as f64
}
