//! Times one POD algorithm on snapshots held in memory.
//!
//! ```text
//! pod_timing DATA.npy W.npy METHOD MODES THREADS REPEATS
//! ```
//!
//! `DATA.npy` has one snapshot a row, `W.npy` one weight for each unknown. Each repeat prints a line of
//! JSON: times in s, singular values and how far the modes are from orthonormal.

use faer::{Mat, MatRef, Par};
use lumley::format::npy::{self, NpySnapshots, SnapshotLayout};
use lumley_pod::{
    ALGORITHMS, Algorithm, Diagonal, MemorySnapshots, Options, ReducedBasis, SnapshotSource,
    Truncation,
};
use rustix::time::{ClockId, clock_gettime};
use serde_json::{Value, json};
use std::error::Error;
use std::num::NonZero;
use std::time::Instant;
use std::{env, io};

const USAGE: &str = "pod_timing DATA.npy W.npy METHOD MODES THREADS REPEATS";

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [data, weights, method, modes, threads, repeats] = arguments.as_slice() else {
        return Err(USAGE.into());
    };
    let algorithm = ALGORITHMS.iter().find(|a| a.name == method).ok_or("no such METHOD")?;
    let options = Options {
        truncation: Truncation::Modes(modes.parse()?),
        par: NonZero::new(threads.parse()?).filter(|n| n.get() > 1).map_or(Par::Seq, Par::Rayon),
        ..Options::default()
    };
    let x = in_memory(&NpySnapshots::open(data, SnapshotLayout::Rows)?)?;
    let w = Diagonal::new(npy::read_vector(weights)?)?;
    for _ in 0..repeats.parse()? {
        println!("{}", time(algorithm, &x, &w, &options)?);
    }
    Ok(())
}

fn in_memory(file: &NpySnapshots) -> io::Result<MemorySnapshots> {
    let (n, times) = (file.dim(), file.times());
    let mut x = Mat::zeros(n, times.len());
    file.block(0..n, 0..times.len(), x.as_mut())?;
    Ok(MemorySnapshots::new(x, times.to_vec()))
}

fn time(
    algorithm: &Algorithm,
    x: &MemorySnapshots,
    w: &Diagonal,
    options: &Options,
) -> Result<Value, Box<dyn Error>> {
    let (cpu, wall) = (cpu_seconds(), Instant::now());
    let basis = (algorithm.run)(x, w, options)?;
    let (wall, cpu) = (wall.elapsed().as_secs_f64(), cpu_seconds() - cpu);
    Ok(json!({
        "cpu": cpu,
        "wall": wall,
        "first": basis.singular_values.first(),
        "last": basis.singular_values.last(),
        "defect": orthonormality_defect(&basis, w),
        "notes": basis.notes.iter().map(ToString::to_string).collect::<Vec<_>>(),
    }))
}

/// Largest entry of `ΦᵀWΦ - I`.
fn orthonormality_defect(basis: &ReducedBasis, w: &Diagonal) -> f64 {
    let phi: MatRef<'_, f64> = basis.modes.as_ref();
    (basis.project(phi, w).expect("weights in memory")
        - Mat::<f64>::identity(phi.ncols(), phi.ncols()))
    .norm_max()
}

/// CPU time of the process in s, all threads together.
fn cpu_seconds() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}
