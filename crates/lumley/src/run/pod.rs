use super::basis::BasisFile;
use super::decompose::{Decomposed, SWEEP};
use super::pipeline::Task;
use super::report::{columns, save};
use crate::Error;
use crate::case::PodChoice;
use crate::directory::Workplace;
use crate::format::npy::{NpySnapshots, SnapshotLayout, read_vector};
use crate::manifest::{MANIFEST, Manifest};
use crate::progress::Progress;
use crate::record::{Record, Support};
use crate::report::{FieldGrid, PodReport, Provenance};
use crate::summary::{Projection, SUMMARY, Snapshots, Summary};
use lumley_pod::{
    Diagonal, Identity, InnerProduct, SnapshotSource, SparseSpd, projection_residuals,
};
use std::path::{Path, PathBuf};

/// Snapshots that are decomposed by themselves, and how.
///
/// ```
/// use lumley::{case::PodChoice, format::npy::SnapshotLayout, run::PodInput};
/// use lumley_pod::Truncation;
/// let input = PodInput {
///     path: "x.npy".into(),
///     weights: None,
///     layout: SnapshotLayout::Rows,
///     times: None,
///     grid: None,
///     components: 1,
///     choice: PodChoice { method: "auto".into(), truncation: Truncation::Modes(6), center: false },
/// };
/// assert_eq!(input.components, 1);
/// ```
#[derive(Debug, Clone)]
pub struct PodInput {
    /// An NPY file, a record, or a run directory with one.
    pub path: PathBuf,
    /// Weights of the inner product, one for each unknown or for each node.
    pub weights: Option<PathBuf>,
    /// Whether rows or columns of the file are snapshots.
    pub layout: SnapshotLayout,
    /// Times of the snapshots.
    pub times: Option<PathBuf>,
    /// The grid to draw the modes on.
    pub grid: Option<FieldGrid>,
    /// Components at each node.
    pub components: usize,
    /// Algorithm and number of modes.
    pub choice: PodChoice,
}

/// Snapshots, their inner product and the words for it.
struct Opened {
    snapshots: Box<dyn SnapshotSource>,
    product: Box<dyn InnerProduct>,
    inner_product: String,
    grid: Option<FieldGrid>,
}

/// POD of snapshots alone: writes `pod.npz`, `summary.json`, `report.html` and figures.
///
/// # Errors
/// Files that are missing, damaged or do not fit together; snapshots without energy.
pub fn decompose_snapshots(
    input: &PodInput,
    task: &Task,
    progress: &mut Progress,
) -> Result<(PathBuf, Summary), Error> {
    let opened = input.open()?;
    let place = Workplace::claim(&task.target, task.existing)?;
    let name = input.path.display().to_string();
    let mut manifest = Manifest::new(&name, name.as_bytes());
    place.write(MANIFEST, manifest.to_json().as_bytes())?;
    progress.begin("pod", 1);
    let (x, w) = (opened.snapshots.as_ref(), opened.product.as_ref());
    let found = Decomposed::exactly(x, w, &input.choice, task.threads);
    let found = found.map_err(Error::pod(&input.path))?;
    let warnings: Vec<String> = found.warnings(&input.choice);
    progress.warn(&warnings);
    BasisFile::save(&place.path().join("pod.npz"), &found.basis)?;
    manifest.stage("pod", progress.end(&found.headline()));

    let summary = summarise(input, &opened, &found, warnings)?;
    place.write(SUMMARY, summary.to_json().as_bytes())?;
    manifest.complete = true;
    place.write(MANIFEST, manifest.to_json().as_bytes())?;
    let report = input.report(&opened, &found, &summary, &manifest);
    save(place.path(), &report.render())?;
    Ok((place.finish()?, summary))
}

impl PodInput {
    fn open(&self) -> Result<Opened, Error> {
        let inner = self.path.join("record");
        let record = if inner.is_dir() { &inner } else { &self.path };
        if record.join("zarr.json").is_file() { self.open_record(record) } else { self.open_npy() }
    }

    fn open_npy(&self) -> Result<Opened, Error> {
        let mut snapshots = NpySnapshots::open(&self.path, self.layout)?;
        if let Some(times) = &self.times {
            snapshots = snapshots.with_times(read_vector(times)?)?;
        }
        let unknowns = snapshots.dim();
        if let Some(grid) = self.grid.filter(|grid| numbers(grid) != Some(unknowns)) {
            let [nx, ny, nz] = grid.nodes;
            return Err(Error::Argument {
                argument: "--grid",
                value: format!("{nx},{ny},{nz} with {} components", grid.components),
                expected: format!("as many numbers as a snapshot has: {unknowns}"),
            });
        }
        let (product, inner_product) = self.product(unknowns)?;
        Ok(Opened { snapshots: Box::new(snapshots), product, inner_product, grid: self.grid })
    }

    fn open_record(&self, path: &Path) -> Result<Opened, Error> {
        let record = Record::open(path)?;
        let frame = &record.description().frames[0];
        let snapshots = record.frame(&frame.name)?;
        let unknowns = snapshots.dim();
        let (mut product, mut inner_product) = self.product(unknowns)?;
        let mut field_grid = None;
        if let Support::Grid(grid) = &frame.support {
            let components = frame.components.len();
            let [nx, ny] = grid.nodes();
            field_grid = Some(FieldGrid { nodes: [nx, ny, 1], components });
            if self.weights.is_none() {
                product = Box::new(mass(grid, components));
                inner_product = "L2, the mass matrix of the grid".into();
            }
        }
        Ok(Opened { snapshots: Box::new(snapshots), product, inner_product, grid: field_grid })
    }

    /// The weights' inner product, each node's repeated for its components; without weights, identity.
    fn product(&self, unknowns: usize) -> Result<(Box<dyn InnerProduct>, String), Error> {
        let Some(path) = &self.weights else {
            return Ok((Box::new(Identity::new(unknowns)), "identity".into()));
        };
        let weights = read_vector(path)?;
        let repeated = match weights.len() {
            n if n == unknowns => weights,
            n if n.checked_mul(self.components) == Some(unknowns) => {
                weights.repeat(self.components)
            }
            n => {
                return Err(Error::Argument {
                    argument: "--weights",
                    value: format!("{} with {n} numbers", path.display()),
                    expected: format!("{unknowns} numbers, one for each unknown of a snapshot"),
                });
            }
        };
        let product = Diagonal::new(repeated)
            .map_err(|source| Error::Weights { path: path.clone(), source })?;
        Ok((Box::new(product), format!("weights of {}", path.display())))
    }

    fn report(
        &self,
        opened: &Opened,
        found: &Decomposed,
        summary: &Summary,
        manifest: &Manifest,
    ) -> PodReport {
        let basis = &found.basis;
        let drawn = basis.modes.subcols(0, basis.size().min(SWEEP));
        PodReport {
            source: self.path.display().to_string(),
            snapshots: summary.record.snapshots,
            unknowns: summary.record.unknowns,
            inner_product: opened.inner_product.clone(),
            centred: self.choice.center,
            method: summary.pod.method.clone(),
            reason: summary.pod.reason.clone(),
            eigenvalues: basis.eigenvalues.clone(),
            total_energy: basis.total_energy,
            modes: columns(drawn),
            coefficients: columns(basis.coefficients.transpose()),
            times: basis.times.clone(),
            grid: opened.grid,
            warnings: summary.warnings.clone(),
            provenance: Provenance {
                version: manifest.version.clone(),
                command: format!("lumley pod {}", self.path.display()),
                machine: manifest.machine.to_string(),
                stages: manifest.stages.iter().map(|s| (s.name.clone(), s.seconds)).collect(),
                case_file: String::new(),
            },
        }
    }
}

/// Numbers in a snapshot on `grid`, if they can be counted.
fn numbers(grid: &FieldGrid) -> Option<usize> {
    grid.nodes.iter().try_fold(grid.components, |product, n| product.checked_mul(*n))
}

/// L2 of a field of several components on a grid.
fn mass(grid: &lumley_fem::UniformGrid, components: usize) -> SparseSpd {
    let (n, entries) = (grid.len(), grid.mass_matrix());
    let block = |c: usize| entries.iter().map(move |&(i, j, m)| (c * n + i, c * n + j, m));
    let all: Vec<_> = (0..components).flat_map(block).collect();
    SparseSpd::from_triplets(components * n, &all).expect("a mass matrix is positive definite")
}

fn summarise(
    input: &PodInput,
    opened: &Opened,
    found: &Decomposed,
    warnings: Vec<String>,
) -> Result<Summary, Error> {
    let (x, w) = (opened.snapshots.as_ref(), opened.product.as_ref());
    let residuals = projection_residuals(&found.basis, x, w).map_err(Error::pod(&input.path))?;
    Ok(Summary {
        case: input.path.display().to_string(),
        record: Snapshots { snapshots: x.times().len(), unknowns: x.dim(), max_norm: None },
        pod: found.summary(),
        projection: Projection { res_percent: residuals.iter().map(|r| 100.0 * r).collect() },
        warnings,
        ..Summary::default()
    })
}
