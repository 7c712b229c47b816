use super::direct::{correlation_in_space, finish_in_space};
use super::lift::lift;
use super::snapshots::correlation_in_time;
use super::svd::bi_orthogonal;
use crate::ensemble::Ensemble;
use crate::product::Columns;
use crate::spectrum::Spectrum;
use crate::{InnerProduct, Note, Options, PodError, ReducedBasis, SnapshotSource};

/// The cheapest algorithm that is exact for the modes asked for.
///
/// Exact: every singular value asked for is right to 1e-6 relative to itself. The smaller of the
/// two correlation matrices is formed first, in time
/// ([`method_of_snapshots`](crate::method_of_snapshots)) or, where there are fewer unknowns than
/// snapshots, in space ([`direct`](crate::direct)), and its own eigenvalues tell whether it reaches
/// that; otherwise [`svd`](crate::svd) does. The first of the [`notes`](ReducedBasis::notes) says
/// which was taken and why.
///
/// # Errors
/// Those of the algorithms it takes.
pub fn auto(
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
) -> Result<ReducedBasis, PodError> {
    let ensemble = Ensemble::new(x, w, options)?;
    let (unknowns, snapshots) = ensemble.shape();
    let bound = exact_down_to(unknowns.min(snapshots));
    let smallest;
    let mut basis = if unknowns < snapshots {
        let spatial = correlation_in_space(&ensemble)?;
        smallest = smallest_asked(&spatial.spectrum, options);
        if smallest < bound { by_svd(&ensemble) } else { finish_in_space(&ensemble, spatial) }
    } else {
        let temporal = correlation_in_time(&ensemble)?;
        smallest = smallest_asked(&temporal.spectrum, options);
        if smallest < bound { by_svd(&ensemble) } else { lift("snapshots", &ensemble, temporal) }
    }?;
    basis.notes.insert(0, Note::Chosen { algorithm: basis.algorithm, smallest, bound });
    Ok(basis)
}

fn by_svd(ensemble: &Ensemble<'_>) -> Result<ReducedBasis, PodError> {
    lift("svd", ensemble, bi_orthogonal(ensemble)?)
}

/// Least eigenvalue asked for, relative to the first; zero where more are asked for than exist.
fn smallest_asked(spectrum: &Spectrum, options: &Options) -> f64 {
    let asked = spectrum.asked(options.truncation);
    spectrum.values.get(asked - 1).map_or(0.0, |l| l / spectrum.values[0])
}

/// Least eigenvalue, relative to the first, whose root a correlation matrix of this size gives to
/// 1e-6: its error is `size eps lambda_1`, and half of that relative to the root.
fn exact_down_to(size: usize) -> f64 {
    const TOLERANCE: f64 = 1e-6;
    size as f64 * f64::EPSILON / (2.0 * TOLERANCE)
}
