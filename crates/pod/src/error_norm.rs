use crate::dense::product;
use crate::ensemble::{check_dimensions, read_checked};
use crate::mean::subtract_from_columns;
use crate::partition::Partition;
use crate::{InnerProduct, PodError, ReducedBasis, SnapshotSource};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par};
use std::io;

/// Whole columns that are read at a time: few, as they may be long, and always as many, as products of more
/// or fewer columns round differently.
const PANEL: usize = 8;

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
/// [`PodError::Dimension`], [`PodError::Modes`], [`PodError::Empty`], [`PodError::NonFinite`],
/// [`PodError::Overflow`], [`PodError::Medium`], and [`PodError::NoEnergy`] where every snapshot is
/// zero.
///
/// ```
/// use lumley_pod::{Identity, MemorySnapshots, Options, Truncation, projection_residuals, svd};
/// let (w, x) = (Identity::new(2), faer::mat![[3.0, 0.0], [0.0, 4.0]]);
/// let snapshots = MemorySnapshots::new(x, vec![0.0, 1.0]);
/// let options = Options { truncation: Truncation::Modes(2), ..Options::default() };
/// let res = projection_residuals(&svd(&snapshots, &w, &options)?, &snapshots, &w)?;
/// assert!((res[0] - 0.75).abs() < 1e-14 && res[1] < 1e-14);
/// # Ok::<(), lumley_pod::PodError>(())
/// ```
pub fn projection_residuals(
    basis: &ReducedBasis,
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
) -> Result<Vec<f64>, PodError> {
    check_dimensions(x, w)?;
    let (unknowns, length) = (x.dim(), basis.modes.nrows());
    if unknowns != length {
        return Err(PodError::Modes { unknowns, modes: length });
    }
    let mut modes = basis.modes.clone();
    w.factor(0..length, modes.as_mut())?;
    let mean = weighted_mean(basis, w)?;
    let mut largest = 0.0_f64;
    let mut errors = vec![0.0_f64; basis.size()];
    for cols in Partition::pieces(0..x.times().len(), PANEL) {
        let mut z = Mat::zeros(x.dim(), cols.len());
        read_checked(x, 0..x.dim(), cols, z.as_mut())?;
        w.factor(0..length, z.as_mut())?;
        largest = largest_norm(z.as_ref())?.max(largest);
        subtract_from_columns(&mean, z.as_mut());
        let a = product(modes.transpose(), z.as_ref());
        matmul(z.as_mut(), Accum::Add, modes.as_ref(), a.as_ref(), -1.0, Par::Seq);
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
/// [`PodError::Trajectories`] where the shapes differ, [`PodError::Times`] where the times differ
/// by more than 1e-9 of the interval, which is what adding up time steps may do, and those of
/// [`projection_residuals`].
///
/// ```
/// use lumley_pod::{Identity, MemorySnapshots, trajectory_residual};
/// let u = MemorySnapshots::new(faer::mat![[3.0, 0.0], [4.0, 1.0]], vec![0.0, 1.0]);
/// let v = MemorySnapshots::new(faer::mat![[3.0, 0.0], [4.0, 1.5]], vec![0.0, 1.0]);
/// assert!((trajectory_residual(&u, &v, &Identity::new(2))? - 0.1).abs() < 1e-15);
/// # Ok::<(), lumley_pod::PodError>(())
/// ```
pub fn trajectory_residual(
    u: &dyn SnapshotSource,
    v: &dyn SnapshotSource,
    w: &dyn InnerProduct,
) -> Result<f64, PodError> {
    check_dimensions(u, w)?;
    check_same_samples(u, v)?;
    let (n, m) = (u.dim(), u.times().len());
    let (mut largest, mut error) = (0.0_f64, 0.0_f64);
    for cols in Partition::pieces(0..m, PANEL) {
        let (mut z, mut difference) = (Mat::zeros(n, cols.len()), Mat::zeros(n, cols.len()));
        read_checked(u, 0..n, cols.clone(), z.as_mut())?;
        read_checked(v, 0..n, cols, difference.as_mut())?;
        difference -= &z;
        w.factor(0..n, z.as_mut())?;
        w.factor(0..n, difference.as_mut())?;
        largest = largest_norm(z.as_ref())?.max(largest);
        error = largest_norm(difference.as_ref())?.max(error);
    }
    if largest > 0.0 { Ok(error / largest) } else { Err(no_energy(u)) }
}

/// F times the mean, zero where none was subtracted.
fn weighted_mean(basis: &ReducedBasis, w: &dyn InnerProduct) -> io::Result<Vec<f64>> {
    let n = basis.modes.nrows();
    let mut mean = Mat::from_fn(n, 1, |i, _| basis.mean.as_ref().map_or(0.0, |mean| mean[i]));
    w.factor(0..n, mean.as_mut())?;
    Ok(mean.col_as_slice(0).to_vec())
}

/// Two trajectories on one grid at the same times.
fn check_same_samples(u: &dyn SnapshotSource, v: &dyn SnapshotSource) -> Result<(), PodError> {
    let (unknowns, snapshots) = (u.dim(), u.times().len());
    let (other_unknowns, other_snapshots) = (v.dim(), v.times().len());
    if (unknowns, snapshots) != (other_unknowns, other_snapshots) {
        return Err(PodError::Trajectories {
            unknowns,
            snapshots,
            other_unknowns,
            other_snapshots,
        });
    }
    let interval = u.times()[snapshots - 1] - u.times()[0];
    for (snapshot, (&time, &other_time)) in u.times().iter().zip(v.times()).enumerate() {
        let round_off = 1e-9 * interval.abs() + 4.0 * f64::EPSILON * time.abs();
        let same = (time - other_time).abs() <= round_off;
        if !same {
            return Err(PodError::Times { snapshot, time, other_time });
        }
    }
    Ok(())
}

fn largest_norm(z: MatRef<'_, f64>) -> Result<f64, PodError> {
    let squares = || z.col_iter().map(|column| column.squared_norm_l2());
    if squares().all(f64::is_finite) {
        Ok(squares().fold(0.0, f64::max).sqrt())
    } else {
        Err(PodError::Overflow)
    }
}

fn no_energy(x: &dyn SnapshotSource) -> PodError {
    PodError::NoEnergy { snapshots: x.times().len(), centred: false }
}
