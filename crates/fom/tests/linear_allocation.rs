//! After the first system the linear solvers allocate nothing.

#[path = "../../fem/tests/counting/mod.rs"]
mod counting;

use counting::allocations;
use faer::Par;
use lumley_fom::linear::{
    Analysis, CellUnknowns, DelayedUnknowns, GmresLimits, LaggedSolver, Multifrontal, RenewalPolicy,
};
use std::error::Error;
use std::sync::Arc;

/// Three unknowns at each node of a square grid of bilinear cells, so that the upper fronts are large.
fn grid(cells: usize) -> (Arc<Analysis>, Vec<f64>) {
    let (mut lists, mut centroids) = (Vec::new(), Vec::new());
    for (i, j) in (0..cells).flat_map(|i| (0..cells).map(move |j| (i, j))) {
        let node = |a, b| (i + a) * (cells + 1) + j + b;
        let corners = [node(0, 0), node(0, 1), node(1, 0), node(1, 1)];
        lists.push(corners.into_iter().flat_map(|n| (0..3).map(move |k| 3 * n + k)).collect());
        centroids.push([i as f64, j as f64]);
    }
    let unknowns = CellUnknowns::new(3 * (cells + 1) * (cells + 1), &lists as &[Vec<usize>]);
    let unknowns = unknowns.expect("a sound numbering");
    let entry = |k: usize| if (k % 144).is_multiple_of(13) { 9.0 } else { (k as f64).sin() / 2.0 };
    let matrices = (0..unknowns.matrix_len()).map(entry).collect();
    (Analysis::new(unknowns, &centroids, &DelayedUnknowns::default()), matrices)
}

#[test]
fn only_the_first_system_allocates() -> Result<(), Box<dyn Error>> {
    let start = allocations();
    let (analysis, mut matrices) = grid(24);
    let count = analysis.cells().count();
    let mut lu = Multifrontal::<f64>::new(analysis.clone(), Par::Seq);
    let (limits, policy) = (GmresLimits::default(), RenewalPolicy::new(6.0));
    let mut lagged = LaggedSolver::new(analysis, limits, policy, Par::Seq);
    let (b, mut x) = (vec![1.0; count], vec![0.0; count]);
    let mut built = 0;
    for step in 0..20 {
        lu.factorise(&matrices)?;
        x.copy_from_slice(&b);
        lu.solve(&mut x);
        x.fill(0.0);
        if step % 5 == 0 {
            lagged.forget();
        }
        lagged.solve(&matrices, &b, &mut x)?;
        matrices.iter_mut().step_by(13).for_each(|a| *a *= 1.001);
        if step == 0 {
            built = allocations();
            assert!(built > start, "the counter counts");
        }
    }
    assert_eq!(allocations(), built);
    Ok(())
}
