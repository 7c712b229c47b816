use super::lift::lift;
use super::snapshots::correlation_in_time;
use super::svd::bi_orthogonal;
use crate::ensemble::Ensemble;
use crate::product::Columns;
use crate::spectrum::Spectrum;
use crate::{Choice, InnerProduct, Note, Options, PodError, ReducedBasis, SnapshotSource};

/// The cheapest algorithm that is exact for the modes asked for.
///
/// Exact: every singular value asked for is right to 1e-6 relative to itself. The Gram matrix of
/// [`method_of_snapshots`](crate::method_of_snapshots) is formed first, and its own eigenvalues tell whether it reaches that;
/// otherwise, or where there are fewer unknowns than snapshots, [`svd`](crate::svd) does. The first of the
/// [`notes`](ReducedBasis::notes) says which was taken and why.
///
/// # Errors
/// Those of the two algorithms.
pub fn auto(
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
) -> Result<ReducedBasis, PodError> {
    let ensemble = Ensemble::new(x, w, options)?;
    let (unknowns, snapshots) = ensemble.shape();
    if unknowns < snapshots {
        return by_svd(&ensemble, Choice::SvdFewUnknowns { unknowns, snapshots });
    }
    let gram = correlation_in_time(&ensemble)?;
    let smallest = smallest_asked(&gram.spectrum, options);
    let bound = exact_down_to(snapshots);
    if smallest < bound {
        return by_svd(&ensemble, Choice::SvdBelowBound { smallest, bound });
    }
    Ok(chosen(lift("snapshots", &ensemble, gram)?, Choice::Snapshots { smallest, bound }))
}

fn by_svd(ensemble: &Ensemble<'_>, choice: Choice) -> Result<ReducedBasis, PodError> {
    Ok(chosen(lift("svd", ensemble, bi_orthogonal(ensemble)?)?, choice))
}

fn chosen(mut basis: ReducedBasis, choice: Choice) -> ReducedBasis {
    basis.notes.insert(0, Note::Chosen(choice));
    basis
}

/// Least eigenvalue asked for, relative to the first; zero where more are asked for than exist.
fn smallest_asked(spectrum: &Spectrum, options: &Options) -> f64 {
    let asked = spectrum.asked(options.truncation);
    spectrum.values.get(asked - 1).map_or(0.0, |l| l / spectrum.values[0])
}

/// Least eigenvalue, relative to the first, whose root a Gram matrix gives to 1e-6: its error
/// is `M eps lambda_1`, and half of that relative to the root.
fn exact_down_to(snapshots: usize) -> f64 {
    const TOLERANCE: f64 = 1e-6;
    snapshots as f64 * f64::EPSILON / (2.0 * TOLERANCE)
}
