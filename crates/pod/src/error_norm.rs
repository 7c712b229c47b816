use crate::ensemble::{check_dimensions, read_checked, subtract_from_columns};
use crate::product::{panels, product, transposed_product};
use crate::{InnerProduct, PodError, ReducedBasis, SnapshotSource};
use faer::{Mat, MatRef};

/// Error of the projection on the first N modes, N = 1..r, paper eq. (32):
/// `Res(N) = max_t |u - u_N| / max_t |u|`, a fraction.
///
/// One pass over the snapshots, whole columns at a time. With `e = u - u_r` computed as it
/// stands, `|u - u_N|² = |e|² + sum_(n > N) a_n²`: only positive numbers are added, so that errors
/// down to round-off are right.
///
/// * `x`: the snapshots, or others on the same grid
/// * `w`: the inner product in which the modes are orthonormal
///
/// # Errors
/// [`PodError::Dimension`], [`PodError::Empty`], [`PodError::NonFinite`], [`PodError::Read`],
/// and [`PodError::NoEnergy`] where every snapshot is zero.
///
/// # Panics
/// If the modes have another length than the snapshots.
pub fn projection_residuals(
    basis: &ReducedBasis,
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
) -> Result<Vec<f64>, PodError> {
    check_dimensions(x, w)?;
    assert_eq!(basis.modes.nrows(), x.dim(), "modes and snapshots have one length");
    let mut modes = basis.modes.clone();
    w.factor(0, modes.as_mut());
    let mean = weighted_mean(basis, w);
    let mut largest = 0.0_f64;
    let mut errors = vec![0.0_f64; basis.size()];
    for cols in panels(x.times().len()) {
        let mut z = Mat::zeros(x.dim(), cols.len());
        read_checked(x, 0..x.dim(), cols, z.as_mut())?;
        w.factor(0, z.as_mut());
        largest = largest_norm(z.as_ref()).max(largest);
        subtract_from_columns(&mean, z.as_mut());
        let a = transposed_product(modes.as_ref(), z.as_ref());
        z -= product(modes.as_ref(), a.as_ref());
        for (e, a) in z.col_iter().zip(a.col_iter()) {
            let mut square = e.squared_norm_l2();
            for (error, a) in errors.iter_mut().zip(a.iter()).rev() {
                *error = error.max(square.sqrt());
                square += a * a;
            }
        }
    }
    let errors = errors.into_iter().map(|e| e / largest).collect();
    if largest > 0.0 { Ok(errors) } else { Err(no_energy(x)) }
}

/// Error of a trajectory against a reference, paper eq. (32): `max_t |u - v| / max_t |u|`, a
/// fraction.
///
/// * `u`: the reference, `v`: the other, on the same grid at the same times
///
/// # Errors
/// [`PodError::Trajectories`] where the shapes differ, and those of [`projection_residuals`].
pub fn trajectory_residual(
    u: &dyn SnapshotSource,
    v: &dyn SnapshotSource,
    w: &dyn InnerProduct,
) -> Result<f64, PodError> {
    check_dimensions(u, w)?;
    let (n, m) = (u.dim(), u.times().len());
    let (other_unknowns, other_snapshots) = (v.dim(), v.times().len());
    if (n, m) != (other_unknowns, other_snapshots) {
        let (unknowns, snapshots) = (n, m);
        return Err(PodError::Trajectories {
            unknowns,
            snapshots,
            other_unknowns,
            other_snapshots,
        });
    }
    let (mut largest, mut error) = (0.0_f64, 0.0_f64);
    for cols in panels(m) {
        let (mut z, mut difference) = (Mat::zeros(n, cols.len()), Mat::zeros(n, cols.len()));
        read_checked(u, 0..n, cols.clone(), z.as_mut())?;
        read_checked(v, 0..n, cols, difference.as_mut())?;
        difference -= &z;
        w.factor(0, z.as_mut());
        w.factor(0, difference.as_mut());
        largest = largest_norm(z.as_ref()).max(largest);
        error = largest_norm(difference.as_ref()).max(error);
    }
    if largest > 0.0 { Ok(error / largest) } else { Err(no_energy(u)) }
}

/// F times the mean, zero where none was subtracted.
fn weighted_mean(basis: &ReducedBasis, w: &dyn InnerProduct) -> Vec<f64> {
    let n = basis.modes.nrows();
    let mut mean = Mat::from_fn(n, 1, |i, _| basis.mean.as_ref().map_or(0.0, |mean| mean[i]));
    w.factor(0, mean.as_mut());
    mean.col(0).iter().copied().collect()
}

fn largest_norm(z: MatRef<'_, f64>) -> f64 {
    z.col_iter().map(|column| column.norm_l2()).fold(0.0, f64::max)
}

fn no_energy(x: &dyn SnapshotSource) -> PodError {
    PodError::NoEnergy { snapshots: x.times().len(), centred: false }
}
