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
/// Exact: every singular value asked for is right to 1e-6 relative to itself, or to the accuracy
/// of [`svd`](crate::svd), a few `eps sigma_1`, where that is more. The smaller of the two correlation matrices is formed first, in time
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
    let (smallest, bound);
    let mut basis = if unknowns < snapshots {
        let spatial = correlation_in_space(&ensemble)?;
        (smallest, bound) =
            (smallest_asked(&spatial.spectrum, options), exact_down_to(&spatial.spectrum));
        if smallest < bound { by_svd(&ensemble) } else { finish_in_space(&ensemble, spatial) }
    } else {
        let temporal = correlation_in_time(&ensemble)?;
        (smallest, bound) =
            (smallest_asked(&temporal.spectrum, options), exact_down_to(&temporal.spectrum));
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

/// Least eigenvalue, relative to the first, whose root a correlation matrix gives to 1e-6: half of
/// what squaring loses, relative to the root.
fn exact_down_to(spectrum: &Spectrum) -> f64 {
    const TOLERANCE: f64 = 1e-6;
    spectrum.squaring.unwrap_or(0.0) / spectrum.values[0] / (2.0 * TOLERANCE)
}
