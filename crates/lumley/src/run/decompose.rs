use super::basis::BasisFile;
use crate::Error;
use crate::case::PodChoice;
use crate::directory::Workplace;
use crate::record::{FrameReader, Record};
use crate::summary::{Decomposition, PodEvery};
use faer::{Mat, Par};
use lumley_fem::UniformGrid;
use lumley_pod::{
    ALGORITHMS, APPROXIMATIONS, Algorithm, Decomposition as Found, InnerProduct, Kronecker, Note,
    Options, PodError, ReducedBasis, Selection, SnapshotSource, Tridiagonal, Truncation,
    projection_residuals,
};
use std::num::NonZero;

/// Errors and models are shown for this many modes at least.
pub(super) const SWEEP: usize = 10;

/// A basis with what the summary says of it.
pub(super) struct Decomposed {
    pub basis: ReducedBasis,
    /// Modes that the case asks for; the basis may have more.
    pub chosen: usize,
}

impl Decomposed {
    /// POD of `x` as `choice` says, with at least [`SWEEP`] modes where the rank allows.
    pub(super) fn with_sweep(
        x: &dyn SnapshotSource,
        product: &dyn InnerProduct,
        choice: &PodChoice,
        threads: usize,
    ) -> Result<Self, PodError> {
        let decompose = |truncation| pod(x, product, None, choice, truncation, threads);
        match choice.truncation {
            Truncation::Modes(modes) => {
                let basis = decompose(Truncation::Modes(modes.max(SWEEP)))?;
                let chosen = modes.min(basis.size());
                Ok(Self { basis, chosen })
            }
            Truncation::Energy(share) => {
                let basis = decompose(Truncation::Modes(SWEEP))?;
                match basis.cumulative_percent().iter().position(|e| *e >= 100.0 * share) {
                    Some(last) => Ok(Self { basis, chosen: last + 1 }),
                    None => Self::exactly(x, product, None, choice, threads),
                }
            }
        }
    }

    /// POD of `x` with the modes that `choice` asks for and no more.
    pub(super) fn exactly(
        x: &dyn SnapshotSource,
        product: &dyn InnerProduct,
        time_weights: Option<Vec<f64>>,
        choice: &PodChoice,
        threads: usize,
    ) -> Result<Self, PodError> {
        let basis = pod(x, product, time_weights, choice, choice.truncation, threads)?;
        let chosen = basis.size();
        Ok(Self { basis, chosen })
    }

    pub(super) fn summary(&self) -> Decomposition {
        summary_of(&self.basis, self.chosen)
    }
}

/// A decomposition as the summary tells it, of which `chosen` modes were asked for.
pub(super) fn summary_of(found: &Found, chosen: usize) -> Decomposition {
    let reason = found.notes.iter().find(|note| !note.is_warning());
    Decomposition {
        method: found.algorithm.to_owned(),
        reason: reason.map(ToString::to_string).unwrap_or_default(),
        modes: chosen,
        passes: found.passes,
        total_energy: found.total_energy,
        error_bound: found.error_bound,
        eigenvalues: found.eigenvalues.clone(),
        singular_values: found.singular_values.clone(),
        energy_percent: found.energy_percent(),
        cumulative_percent: found.cumulative_percent(),
        rms_error_percent: found.rms_projection_error().iter().map(|e| 100.0 * e).collect(),
        ..Decomposition::default()
    }
}

/// One line for people.
pub(super) fn headline(found: &Found, chosen: usize) -> String {
    let energy = found.cumulative_percent()[chosen - 1];
    format!("{chosen} modes hold {energy:.4} % of the energy ({})", found.algorithm)
}

/// What the reader should know: the basis has less than was asked for.
pub(super) fn warnings(found: &Found, choice: &PodChoice) -> Vec<String> {
    let asked = match choice.truncation {
        Truncation::Modes(modes) => modes,
        Truncation::Energy(_) => 1,
    };
    let notes = found.notes.iter().filter(|note| note.is_warning());
    notes.filter(|_| found.size() < asked).map(Note::to_string).collect()
}

/// The algorithm of this name, which was checked.
pub(super) fn algorithm(name: &str) -> &'static Algorithm {
    let known = ALGORITHMS.iter().chain(APPROXIMATIONS).find(|algorithm| algorithm.name == name);
    known.expect("the choice names a known method")
}

fn pod(
    x: &dyn SnapshotSource,
    product: &dyn InnerProduct,
    time_weights: Option<Vec<f64>>,
    choice: &PodChoice,
    truncation: Truncation,
    threads: usize,
) -> Result<ReducedBasis, PodError> {
    let par = NonZero::new(threads).filter(|n| n.get() > 1).map_or(Par::Seq, Par::Rayon);
    let center = choice.center;
    let options = Options { truncation, center, time_weights, par, ..Options::default() };
    (algorithm(&choice.method).run)(x, product, &options)
}

/// What POD of the velocity on the fixed grid found.
pub(super) struct OnGrid {
    pub pod: Decomposed,
    /// Res(N) (32) of the projection on the first modes, in percent.
    pub res_percent: Vec<f64>,
    /// The same of some of the snapshots, where the case asks for that.
    pub every: Option<PodEvery>,
}

/// POD of the velocity on the fixed grid; the basis is written to `basis/fixed.npz`.
pub(super) fn on_fixed_grid(
    grid: &UniformGrid,
    choice: &PodChoice,
    record: &Record,
    place: &Workplace,
    threads: usize,
) -> Result<OnGrid, Error> {
    let product = grid_product(grid, grid.dimension());
    let velocities = record.frame("fixed")?;
    let path = place.path().join("record");
    let (pod, res_percent) =
        projected(&velocities, &product, choice, threads).map_err(Error::pod(&path))?;
    let every = choice.every.map(|every| some(every, &velocities, &product, choice, threads));
    let every = every.transpose().map_err(Error::pod(&path))?;
    let folder = place.fresh_folder("basis")?;
    BasisFile::save(&folder.join("fixed.npz"), &pod.basis)?;
    Ok(OnGrid { pod, res_percent, every })
}

/// POD with the sweep's modes, and what projection on the first of them loses, in percent.
fn projected(
    x: &dyn SnapshotSource,
    product: &dyn InnerProduct,
    choice: &PodChoice,
    threads: usize,
) -> Result<(Decomposed, Vec<f64>), PodError> {
    let found = Decomposed::with_sweep(x, product, choice, threads)?;
    let residuals = projection_residuals(&found.basis, x, product)?;
    Ok((found, residuals.iter().take(SWEEP).map(|res| 100.0 * res).collect()))
}

/// POD of every so many snapshots, the last of each so many.
fn some(
    every: usize,
    x: &dyn SnapshotSource,
    product: &dyn InnerProduct,
    choice: &PodChoice,
    threads: usize,
) -> Result<PodEvery, PodError> {
    let taken = Selection::new(x, (every - 1..x.times().len()).step_by(every).collect());
    let (found, res_percent) = projected(&taken, product, choice, threads)?;
    Ok(PodEvery {
        every,
        snapshots: taken.times().len(),
        eigenvalues: found.basis.eigenvalues.clone(),
        cumulative_percent: found.basis.cumulative_percent(),
        res_percent,
    })
}

/// All snapshots of a frame, in columns.
pub(super) fn whole(frame: &FrameReader) -> Result<Mat<f64>, Error> {
    let mut x = Mat::zeros(frame.dim(), frame.times().len());
    frame.read_block(0..x.nrows(), 0..x.ncols(), x.as_mut())?;
    Ok(x)
}

/// L2 of a field of several components on a grid: on a line the mass matrix of linear elements, of which the reduced
/// models are made; in the plane the trapezoid rule, with which the paper's Table 1 comes out. There linear functions
/// between the nodes would smooth what a moving body leaves: the fourth eigenvalue of the paper's case would be a tenth less.
///
/// ```
/// use lumley_fem::UniformGrid;
/// use lumley_pod::InnerProduct;
/// let grid = UniformGrid::rectangle([0.0, 0.0], [1.0, 2.0], [3, 5]);
/// let mut ones = faer::Mat::from_fn(15, 1, |_, _| 1.0);
/// lumley::run::grid_product(&grid, 1).apply(ones.as_mut());
/// let weights = grid.trapezoid_weights();
/// assert!((0..15).all(|k| (ones[(k, 0)] - weights[k]).abs() < 1e-14));
/// ```
///
/// # Panics
/// Never: a mass matrix is positive definite, and the weights are positive.
pub fn grid_product(grid: &UniformGrid, components: usize) -> Kronecker {
    let factor = |diagonal: &[f64], beside: &[f64]| {
        Tridiagonal::new(diagonal, beside).expect("a factor is positive definite")
    };
    let factors = match grid.dimension() {
        1 => grid.mass_factors().map(|(diagonal, beside)| factor(&diagonal, &beside)),
        _ => {
            grid.trapezoid_factors().map(|weights| factor(&weights, &vec![0.0; weights.len() - 1]))
        }
    };
    Kronecker::new(factors.into(), components)
}
