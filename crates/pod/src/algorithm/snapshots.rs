use super::lift::lift;
use crate::correlation::{Correlation, correlation};
use crate::run::Run;
use crate::spectrum::Spectrum;
use crate::{
    Decomposition, Execution, InnerProduct, ModeStore, Options, PodError, ReducedBasis,
    SnapshotSource, dense,
};
use faer::{Mat, MatRef, Scale};

/// POD by the method of snapshots, paper eqs. (9)-(10) (Sirovich, 1987).
///
/// ```text
/// C_ik = (u_i, u_k)/M,   C c = lambda c,   Phi_n = sum_k c_k u_k / sqrt(M lambda_n)
/// ```
///
/// Cost n M² + M³ flops and two passes over the snapshots; where the inner product couples all
/// rows, one weighted copy of the snapshots is held in memory. The correlation matrix squares the
/// condition number: modes with `lambda <= M eps lambda_1`, or `8 eps sum_i W_ii <u_i²>` where
/// coupled rows make that larger, are noise and are left out, with a [`Note`](crate::Note). An
/// eigenvalue has an error of up to that.
///
/// # Errors
/// Every variant of [`PodError`] but those about other algorithms.
///
/// ```
/// use lumley_pod::{Identity, MemorySnapshots, Options, Truncation, method_of_snapshots};
/// let x = faer::mat![[3.0, 0.0], [0.0, 4.0]];
/// let options = Options { truncation: Truncation::Modes(1), ..Options::default() };
/// let basis = method_of_snapshots(&MemorySnapshots::new(x, vec![0.0, 1.0]), &Identity::new(2), &options)?;
/// assert!((basis.eigenvalues[0] - 8.0).abs() < 1e-14);
/// # Ok::<(), lumley_pod::PodError>(())
/// ```
pub fn method_of_snapshots(
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
) -> Result<ReducedBasis, PodError> {
    super::in_memory(stream, x, w, options)
}

pub(super) fn stream(
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
    execution: Execution<'_>,
    modes: &dyn ModeStore,
) -> Result<Decomposition, PodError> {
    super::with_rows(x, w, options, execution, modes, &|run| {
        let first = correlation(run, "correlation", None)?;
        lift("snapshots", run, eigenvectors(run, &first)?)
    })
}

/// Eigenvalues and eigenvectors of the correlation in time, or singular values and right
/// singular vectors: the same thing.
pub(crate) struct Temporal {
    pub spectrum: Spectrum,
    /// M x k, one column for each eigenvalue.
    pub vectors: Mat<f64>,
}

pub(super) fn eigenvectors(run: &Run<'_>, correlation: &Correlation) -> Result<Temporal, PodError> {
    let (n, m) = run.ensemble.shape();
    let found = run.agreed(|| {
        let matrix = &correlation.matrix * Scale(1.0 / m as f64);
        let (lambda, vectors) = dense::eigen_descending(matrix.as_ref())?;
        Ok(lambda.into_iter().chain(vectors.col_iter().flat_map(|v| v.iter().copied())).collect())
    })?;
    let (lambda, vectors) = found.split_at(m);
    let lambda = lambda[..m.min(n)].to_vec();
    let squaring = run.ensemble.squaring(&lambda);
    let spectrum = run.ensemble.spectrum(lambda, correlation.steady, Some(squaring))?;
    Ok(Temporal { spectrum, vectors: MatRef::from_column_major_slice(vectors, m, m).to_owned() })
}
