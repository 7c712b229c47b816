//! POD of 20000 x 200 weighted snapshots, 20 modes, one thread: every algorithm that can.

use criterion::{Criterion, criterion_group, criterion_main};
use faer::Mat;
use lumley_pod::{
    ALGORITHMS, Diagonal, MemorySnapshots, Options, Truncation, projection_residuals, svd,
};
use std::hint::black_box;

/// Travelling waves whose energies fall by 4 from one to the next, and a little noise.
fn snapshots(n: usize, m: usize) -> MemorySnapshots {
    let mut noise = 1_u64;
    let x = Mat::from_fn(n, m, |i, j| {
        noise = noise.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        let (x, t) = (i as f64 / n as f64, j as f64 / m as f64);
        let wave = |k: i32| (f64::from(k) * (9.0 * x - 4.0 * t)).sin() * 0.5_f64.powi(k);
        (1..=12).map(wave).sum::<f64>() + 1e-6 * (noise >> 11) as f64 / (1_u64 << 53) as f64
    });
    MemorySnapshots::new(x, (0..m).map(|j| j as f64).collect())
}

fn weights(n: usize) -> Diagonal {
    let weight = |i: usize| 1.0 + (i % 7) as f64;
    Diagonal::new((0..n).map(weight).collect()).expect("positive weights")
}

fn algorithms(c: &mut Criterion) {
    let options = Options { truncation: Truncation::Modes(20), ..Options::default() };
    let mut group = c.benchmark_group("pod");
    group.sample_size(10);
    // The n x n problem of the direct method is for few unknowns.
    for (n, m, names) in
        [(20_000, 200, &["auto", "snapshots", "svd"][..]), (1000, 2000, &["auto", "direct"])]
    {
        let (x, w) = (snapshots(n, m), weights(n));
        for algorithm in ALGORITHMS.iter().filter(|a| names.contains(&a.name)) {
            group.bench_function(format!("{} {n} x {m}", algorithm.name), |b| {
                b.iter(|| (algorithm.run)(black_box(&x), &w, &options).expect("a basis"));
            });
        }
    }
    group.finish();
}

fn residuals(c: &mut Criterion) {
    let (n, m) = (20_000, 200);
    let (x, w) = (snapshots(n, m), weights(n));
    let options = Options { truncation: Truncation::Modes(20), ..Options::default() };
    let basis = svd(&x, &w, &options).expect("a basis");
    let mut group = c.benchmark_group("Res(N)");
    group.sample_size(10);
    group.bench_function("projection, N = 1..20", |b| {
        b.iter(|| projection_residuals(&basis, black_box(&x), &w).expect("residuals"));
    });
    group.finish();
}

criterion_group!(benches, algorithms, residuals);
criterion_main!(benches);
