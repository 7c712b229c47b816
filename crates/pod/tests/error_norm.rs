//! Res(N), paper eq. (32).

mod common;

use common::{inner, products, snapshots, with_singular_values};
use faer::{Mat, Scale};
use lumley_pod::{
    Identity, InnerProduct, MemorySnapshots, Options, PodError, Truncation, method_of_snapshots,
    projection_residuals, svd, trajectory_residual,
};

const N: usize = 90;
const M: usize = 70;

fn norms(w: &dyn InnerProduct, u: &Mat<f64>) -> f64 {
    let squares = inner(w, u.as_ref(), u.as_ref());
    (0..u.ncols()).map(|j| squares[(j, j)].sqrt()).fold(0.0, f64::max)
}

fn basis_of(x: &Mat<f64>, w: &dyn InnerProduct, center: bool) -> lumley_pod::ReducedBasis {
    let options = Options { truncation: Truncation::Modes(20), center, ..Options::default() };
    svd(&snapshots(x.clone()), w, &options).expect("a decomposition")
}

/// Against u - u_N formed for each N, with errors from 1 down to 1e-12.
#[test]
fn projection_residuals_are_those_of_the_projected_fields() {
    let sigma: Vec<f64> = (0..25).map(|k| 10_f64.powf(-0.6 * f64::from(k))).collect();
    for (product, w) in products(N) {
        for center in [false, true] {
            let x = with_singular_values(&sigma, (N, M), &*w, 5);
            let basis = basis_of(&x, &*w, center);
            let res = projection_residuals(&basis, &snapshots(x.clone()), &*w).expect("residuals");
            assert_eq!(res.len(), 20);
            assert!(res[19] < 1e-11, "{:e}", res[19]);
            for (modes, res) in (1..).zip(&res) {
                let u_n = basis.reconstruct(basis.coefficients.subrows(0, modes));
                let direct = norms(&*w, &(&x - u_n)) / norms(&*w, &x);
                let gap = (res - direct).abs();
                assert!(gap < 1e-6 * direct + 2e-15, "{product}, {modes}: {res:e}, {direct:e}");
            }
        }
    }
}

/// The projection, not the coefficients of the basis, decides: fields that the basis never saw.
#[test]
fn residuals_of_other_snapshots() {
    let w = Identity::new(N);
    let x = with_singular_values(&[1.0, 0.5, 0.25], (N, M), &w, 5);
    let options = Options { truncation: Truncation::Modes(3), ..Options::default() };
    let basis = method_of_snapshots(&snapshots(x), &w, &options).expect("a decomposition");
    let inside = snapshots(basis.modes.col(1).as_mat() * Scale(-4.0));
    let res = projection_residuals(&basis, &inside, &w).expect("residuals");
    assert!((res[0] - 1.0).abs() < 1e-14 && res[1] < 1e-15, "{res:?}");
}

#[test]
fn trajectories_are_compared_by_their_largest_distance() {
    let w = Identity::new(2);
    let u = MemorySnapshots::new(faer::mat![[3.0, 0.0], [4.0, 1.0]], vec![0.0, 1.0]);
    let v = MemorySnapshots::new(faer::mat![[3.0, 0.3], [4.0, 1.4]], vec![0.0, 1.0]);
    let res = trajectory_residual(&u, &v, &w).expect("two trajectories");
    assert!((res - 0.1).abs() < 1e-15, "{res}");

    let short = MemorySnapshots::new(faer::mat![[1.0], [1.0]], vec![0.0]);
    let error = trajectory_residual(&u, &short, &w).expect_err("one snapshot is missing");
    assert!(matches!(error, PodError::Trajectories { snapshots: 2, other_snapshots: 1, .. }));
    let zero = MemorySnapshots::new(Mat::zeros(2, 2), vec![0.0, 1.0]);
    let error = trajectory_residual(&zero, &u, &w).expect_err("no reference");
    assert!(matches!(error, PodError::NoEnergy { .. }));
}

#[test]
fn trajectories_at_other_times_are_refused() {
    let w = Identity::new(1);
    let at = |times: [f64; 3]| MemorySnapshots::new(faer::mat![[1.0, 2.0, 3.0]], times.to_vec());
    let u = at([0.0, 0.1, 0.2]);
    assert!(trajectory_residual(&u, &at([0.0, 0.1, 0.1 + 0.1 + 1e-12]), &w).is_ok());
    for (snapshot, other) in [(1, [0.0, 0.11, 0.2]), (2, [0.0, 0.1, f64::NAN])] {
        let error = trajectory_residual(&u, &at(other), &w).expect_err("other times");
        let named = matches!(error, PodError::Times { snapshot: k, .. } if k == snapshot);
        assert!(named, "{error}");
    }
    let error = trajectory_residual(&u, &at([0.0, 0.11, 0.2]), &w).expect_err("other times");
    assert!(error.to_string().contains("0.1 s in one") && error.to_string().contains("0.11 s"));
}

#[test]
fn residuals_that_cannot_be_computed_are_errors() {
    let w = Identity::new(N);
    let basis = basis_of(&with_singular_values(&[1.0], (N, M), &w, 5), &w, false);
    let mut large = common::random_matrix(N, 4, 1);
    large[(3, 2)] = 1e200;
    let large = snapshots(large);
    let error = projection_residuals(&basis, &large, &w).expect_err("1e400 is no number");
    assert!(matches!(error, PodError::Overflow), "{error}");
    let error = trajectory_residual(&snapshots(Mat::ones(N, 4)), &large, &w).expect_err("1e400");
    assert!(matches!(error, PodError::Overflow), "{error}");

    let short = snapshots(common::random_matrix(7, 3, 1));
    let error = projection_residuals(&basis, &short, &Identity::new(7)).expect_err("7 unknowns");
    assert!(matches!(error, PodError::Modes { unknowns: 7, modes: N }), "{error}");
}
