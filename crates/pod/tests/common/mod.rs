//! Snapshots with known answers, shared by the tests.

#![allow(dead_code, reason = "each test file takes what it needs")]

use faer::{Mat, MatMut, MatRef, Par};
use lumley_pod::{
    Diagonal, Identity, InnerProduct, Kronecker, MemorySnapshots, SnapshotSource, SparseSpd,
    Tridiagonal,
};
use std::io;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Numbers in (-1, 1) from a linear congruential generator.
pub fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

pub fn random_matrix(rows: usize, columns: usize, seed: u64) -> Mat<f64> {
    let mut next = random(seed);
    Mat::from_fn(rows, columns, |_, _| next())
}

/// Orthonormal columns, at random.
pub fn orthonormal(rows: usize, columns: usize, seed: u64) -> Mat<f64> {
    random_matrix(rows, columns, seed).qr().compute_thin_Q()
}

/// Snapshots whose `W^(1/2) X` has these singular values.
pub fn with_singular_values(
    sigma: &[f64],
    shape: (usize, usize),
    w: &dyn InnerProduct,
    seed: u64,
) -> Mat<f64> {
    let (n, m) = shape;
    let mut u = orthonormal(n, sigma.len(), seed);
    w.unfactor(u.as_mut()).expect("weights in memory");
    let v = orthonormal(m, sigma.len(), seed + 1);
    let sigma_vt = Mat::from_fn(sigma.len(), m, |k, j| sigma[k] * v[(j, k)]);
    let mut x = Mat::zeros(n, m);
    faer::linalg::matmul::matmul(&mut x, faer::Accum::Replace, &u, &sigma_vt, 1.0, Par::Seq);
    x
}

/// The mass matrix of a uniform grid, in two directions where n is even.
pub fn grid(n: usize) -> Kronecker {
    let line = |n: usize| {
        let inner = |k: usize| if k == 0 || k == n - 1 { 2.0 } else { 4.0 };
        let diagonal: Vec<f64> = (0..n).map(inner).collect();
        Tridiagonal::new(&diagonal, &vec![1.0; n - 1]).expect("a mass matrix is positive definite")
    };
    let directions = if n.is_multiple_of(2) { vec![line(n / 2), line(2)] } else { vec![line(n)] };
    Kronecker::new(directions, 1)
}

/// The mass matrix of linear elements of unequal lengths on a line.
pub fn mass_matrix(n: usize) -> SparseSpd {
    let mut next = random(5);
    let of_cell = |k: usize| {
        let h = (1.5 + next()) / 6.0;
        [(k, k, 2.0 * h), (k, k + 1, h), (k + 1, k, h), (k + 1, k + 1, 2.0 * h)]
    };
    let entries: Vec<_> = (0..n - 1).flat_map(of_cell).collect();
    SparseSpd::from_triplets(n, &entries).expect("a mass matrix is positive definite")
}

/// Mass and stiffness matrix of equal linear elements on a line of length 1: the product of H¹.
pub fn h1(n: usize) -> SparseSpd {
    let h = 1.0 / (n - 1) as f64;
    let (diagonal, other) = (h / 3.0 + 1.0 / h, h / 6.0 - 1.0 / h);
    let of_cell = |k: usize| {
        [(k, k, diagonal), (k, k + 1, other), (k + 1, k, other), (k + 1, k + 1, diagonal)]
    };
    let entries: Vec<_> = (0..n - 1).flat_map(of_cell).collect();
    SparseSpd::from_triplets(n, &entries).expect("positive definite")
}

/// An inner product of each kind.
pub fn products(n: usize) -> [(&'static str, Box<dyn InnerProduct>); 5] {
    let mut next = random(3);
    let weights = (0..n).map(|_| 1.5 + next()).collect();
    [
        ("identity", Box::new(Identity::new(n))),
        ("diagonal", Box::new(Diagonal::new(weights).expect("positive"))),
        ("grid", Box::new(grid(n))),
        ("sparse", Box::new(mass_matrix(n))),
        ("H1", Box::new(h1(n))),
    ]
}

/// Unequal times, in s.
pub fn times(m: usize) -> Vec<f64> {
    let mut next = random(9);
    (0..m).map(|j| j as f64 + 0.4 * next()).collect()
}

pub fn snapshots(x: Mat<f64>) -> MemorySnapshots {
    let times = times(x.ncols());
    MemorySnapshots::new(x, times)
}

struct Seen<'a, S> {
    x: &'a MemorySnapshots,
    see: S,
}

impl<S: Fn(&Range<usize>, &Range<usize>) -> io::Result<()> + Sync> SnapshotSource for Seen<'_, S> {
    fn dim(&self) -> usize {
        self.x.dim()
    }

    fn times(&self) -> &[f64] {
        self.x.times()
    }

    fn block(
        &self,
        rows: Range<usize>,
        cols: Range<usize>,
        out: MatMut<'_, f64>,
    ) -> io::Result<()> {
        (self.see)(&rows, &cols)?;
        self.x.block(rows, cols, out)
    }
}

/// `x`, read in blocks alone, whose rows and columns `see` is told first: it may refuse them.
pub fn seen(
    x: &MemorySnapshots,
    see: impl Fn(&Range<usize>, &Range<usize>) -> io::Result<()> + Sync,
) -> impl SnapshotSource {
    Seen { x, see }
}

/// What `work` makes of `x`, how many numbers it reads, and the most of them at once.
pub fn counted<T>(
    x: &MemorySnapshots,
    work: impl FnOnce(&dyn SnapshotSource) -> T,
) -> (T, usize, usize) {
    let (numbers, largest) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let made = work(&seen(x, |rows, cols| {
        let size = rows.len() * cols.len();
        numbers.fetch_add(size, Ordering::Relaxed);
        largest.fetch_max(size, Ordering::Relaxed);
        Ok(())
    }));
    (made, numbers.into_inner(), largest.into_inner())
}

/// `Aᵀ W B`.
pub fn inner(w: &dyn InnerProduct, a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    let mut weighted = b.to_owned();
    w.apply(weighted.as_mut()).expect("weights in memory");
    a.transpose() * weighted
}

pub fn largest(a: impl IntoIterator<Item = f64>) -> f64 {
    a.into_iter().map(f64::abs).fold(0.0, f64::max)
}
