use super::basis::BasisFile;
use super::ground::{grid_product, is_mapped};
use crate::Error;
use crate::case::{PistonCase, PodChoice};
use crate::directory::Workplace;
use crate::record::{FrameReader, Record};
use crate::summary::Decomposition;
use faer::{Mat, Par};
use lumley_fem::LineMesh;
use lumley_fem::element::{P1, P2};
use lumley_pod::{
    ALGORITHMS, APPROXIMATIONS, Algorithm, Decomposition as Found, InnerProduct, MemorySnapshots,
    Note, Options, PodError, ReducedBasis, SnapshotSource, SparseSpd, Truncation,
    projection_residuals,
};
use std::num::NonZero;
use std::path::Path;

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

/// The decompositions of a run, and what projection on the first modes loses.
pub(super) struct Decompositions {
    pub fixed: Decomposed,
    pub reference: Option<Decomposed>,
    pub projection_percent: Vec<f64>,
}

/// POD of the record's frames; the bases are written to `basis/`.
pub(super) fn decompose(
    case: &PistonCase,
    record: &Record,
    place: &Workplace,
    threads: usize,
) -> Result<Decompositions, Error> {
    let product = grid_product(&case.grid, 1);
    let velocities = record.frame("fixed")?;
    let path = place.path().join("record");
    let fixed = Decomposed::with_sweep(&velocities, &product, &case.pod, threads);
    let fixed = fixed.map_err(Error::pod(&path))?;
    let residuals = projection_residuals(&fixed.basis, &velocities, &product);
    let residuals = residuals.map_err(Error::pod(&path))?;
    let folder = place.fresh_folder("basis")?;
    BasisFile::save(&folder.join("fixed.npz"), &fixed.basis)?;
    let mapped = case.models.iter().any(is_mapped);
    let reference = if mapped { Some(reference(case, record, &path, threads)?) } else { None };
    if let Some(reference) = &reference {
        BasisFile::save(&folder.join("reference.npz"), &reference.basis)?;
    }
    let projection_percent = residuals.iter().take(SWEEP).map(|res| 100.0 * res).collect();
    Ok(Decompositions { fixed, reference, projection_percent })
}

/// All snapshots of a frame, in columns.
pub(super) fn whole(frame: &FrameReader) -> Result<Mat<f64>, Error> {
    let mut x = Mat::zeros(frame.dim(), frame.times().len());
    frame.read_block(0..x.nrows(), 0..x.ncols(), x.as_mut())?;
    Ok(x)
}

/// POD of u - X' xi in L2(0, 1). It vanishes at both ends, and so do the modes, to the last bit: the end
/// nodes are no unknowns.
fn reference(
    case: &PistonCase,
    record: &Record,
    path: &Path,
    threads: usize,
) -> Result<Decomposed, Error> {
    let mesh = LineMesh::new(case.cells, if case.degree == 1 { &P1 } else { &P2 });
    let nodes = mesh.uniform(0.0, 1.0);
    let xi: Vec<f64> = mesh.left_to_right().map(|node| nodes[node]).collect();
    let u = record.frame("reference")?;
    let velocities = record.series("velocity")?;
    let mut x = whole(&u)?;
    for (k, column) in x.col_iter_mut().enumerate() {
        for (u, xi) in column.iter_mut().zip(&xi) {
            *u -= velocities.at(k)[0] * xi;
        }
    }
    let inside = x.subrows(1, x.nrows() - 2).to_owned();
    let x = MemorySnapshots::new(inside, u.times().to_vec());
    let found = Decomposed::with_sweep(&x, &inner_mass(&mesh, &nodes), &case.pod, threads);
    let mut found = found.map_err(Error::pod(path))?;
    let modes = &found.basis.modes;
    let mut padded = Mat::zeros(xi.len(), modes.ncols());
    padded.subrows_mut(1, modes.nrows()).copy_from(modes);
    found.basis.modes = padded;
    if let Some(mean) = &mut found.basis.mean {
        mean.insert(0, 0.0);
        mean.push(0.0);
    }
    Ok(found)
}

/// The mass matrix of all nodes but the first and the last, from left to right.
fn inner_mass(mesh: &LineMesh, nodes: &[f64]) -> SparseSpd {
    // Records list the nodes from left to right, meshes their vertices first.
    let mut place = vec![0; mesh.nodes()];
    mesh.left_to_right().enumerate().for_each(|(k, node)| place[node] = k);
    let inner = mesh.nodes() - 2;
    let inside = |node: usize| place[node].checked_sub(1).filter(|k| *k < inner);
    let mass = mesh.mass_matrix(nodes).into_iter();
    let mass = mass.filter_map(|(i, j, m)| Some((inside(i)?, inside(j)?, m)));
    let product = SparseSpd::from_triplets(inner, &mass.collect::<Vec<_>>());
    product.expect("a mass matrix is symmetric positive definite")
}
