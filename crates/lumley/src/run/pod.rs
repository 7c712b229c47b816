use super::basis::BasisFile;
use super::decompose::{Decomposed, SWEEP};
use super::ground::grid_product;
use super::pipeline::Task;
use super::report::{columns, provenance, save};
use crate::Error;
use crate::case::PodChoice;
use crate::directory::{DirectoryError, Workplace};
use crate::format::npy::{NpySnapshots, SnapshotLayout, read_vector};
use crate::manifest::{Input, MANIFEST, Manifest};
use crate::progress::Progress;
use crate::record::{Record, Support};
use crate::report::{FieldGrid, PodReport};
use crate::summary::{Projection, SUMMARY, Snapshots, Summary};
use lumley_pod::time_weights::trapezoid;
use lumley_pod::{Diagonal, Identity, InnerProduct, SnapshotSource, projection_residuals};
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
    /// Whether the times are the snapshots' own and not their numbers.
    timed: bool,
    /// Weights of the snapshots, where their times are given and unequal.
    time_weights: Option<Vec<f64>>,
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
    // Nothing of this is worth going on with: what fails is not left behind.
    match decompose_into(input, &opened, task, &place, progress) {
        Ok(summary) => Ok((place.finish()?, summary)),
        Err(error) => {
            place.abandon()?;
            Err(error)
        }
    }
}

fn decompose_into(
    input: &PodInput,
    opened: &Opened,
    task: &Task,
    place: &Workplace,
    progress: &mut Progress,
) -> Result<Summary, Error> {
    let mut manifest = Manifest::new(&input.path.display().to_string(), &task.command);
    manifest.inputs = input.inputs()?;
    place.write(MANIFEST, manifest.to_json().as_bytes())?;
    progress.begin("pod", 1);
    let (x, w) = (opened.snapshots.as_ref(), opened.product.as_ref());
    let weights = opened.time_weights.clone();
    let found = Decomposed::exactly(x, w, weights, &input.choice, task.threads);
    let found = found.map_err(Error::pod(&input.path))?;
    let warnings: Vec<String> = found.warnings(&input.choice);
    progress.warn(&warnings);
    BasisFile::save(&place.path().join("pod.npz"), &found.basis)?;
    manifest.stage("pod", progress.end(&found.headline()));

    let mut summary = summarise(input, opened, &found, warnings)?;
    summary.directory = task.target.display().to_string();
    place.write(SUMMARY, summary.to_json().as_bytes())?;
    let report = input.report(opened, &found, &summary, &manifest);
    save(place.path(), &report.render())?;
    manifest.complete = true;
    place.write(MANIFEST, manifest.to_json().as_bytes())?;
    Ok(summary)
}

impl PodInput {
    fn open(&self) -> Result<Opened, Error> {
        let inner = self.path.join("record");
        let record = if inner.is_dir() { &inner } else { &self.path };
        if record.join("zarr.json").is_file() { self.open_record(record) } else { self.open_npy() }
    }

    /// The files that were read, by name, length and, where that is quick, checksum.
    fn inputs(&self) -> Result<Vec<Input>, Error> {
        let files = [Some(&self.path), self.weights.as_ref(), self.times.as_ref()];
        let files = files.into_iter().flatten().filter(|path| path.is_file());
        let input = |path: &PathBuf| {
            let failed = |source| DirectoryError::Io { action: "read", path: path.clone(), source };
            Ok(Input::of_file(path).map_err(failed)?)
        };
        files.map(input).collect()
    }

    fn open_npy(&self) -> Result<Opened, Error> {
        let mut snapshots = NpySnapshots::open(&self.path, self.layout)?;
        if let Some(times) = &self.times {
            snapshots = snapshots.with_times(read_vector(times)?)?;
        }
        let unknowns = snapshots.dim();
        if self.components == 0 || unknowns % self.components != 0 {
            return Err(Error::Argument {
                argument: "--components",
                value: self.components.to_string(),
                expected: format!("a divisor of the {unknowns} numbers of a snapshot"),
            });
        }
        if let Some(grid) = self.grid.filter(|grid| numbers(grid) != Some(unknowns)) {
            let [nx, ny, nz] = grid.nodes;
            return Err(Error::Argument {
                argument: "--grid",
                value: format!("{nx},{ny},{nz} with {} components", grid.components),
                expected: format!("as many numbers as a snapshot has: {unknowns}"),
            });
        }
        let (product, inner_product) = self.product(unknowns, self.components)?;
        let time_weights = match &self.times {
            Some(_) => unequal(snapshots.times()),
            None => None,
        };
        let snapshots = Box::new(snapshots);
        let (timed, grid) = (self.times.is_some(), self.grid);
        Ok(Opened { snapshots, timed, time_weights, product, inner_product, grid })
    }

    fn open_record(&self, path: &Path) -> Result<Opened, Error> {
        let given = [("--times", self.times.is_some()), ("--grid", self.grid.is_some())];
        let others = [
            ("--snapshots columns", self.layout == SnapshotLayout::Columns),
            ("--components", self.components != 1),
        ];
        if let Some((argument, _)) = given.into_iter().chain(others).find(|(_, given)| *given) {
            return Err(Error::Argument {
                argument,
                value: format!("with the record {}", path.display()),
                expected: "an NPY file; a record knows its times, its grid and its components"
                    .into(),
            });
        }
        let record = Record::open(path)?;
        let frame = &record.description().frames[0];
        let snapshots = record.frame(&frame.name)?;
        let unknowns = snapshots.dim();
        let components = frame.components.len();
        let (mut product, mut inner_product) = self.product(unknowns, components)?;
        let mut field_grid = None;
        if let Support::Grid(grid) = &frame.support {
            let [nx, ny] = grid.nodes();
            field_grid = Some(FieldGrid { nodes: [nx, ny, 1], components });
            if self.weights.is_none() {
                product = Box::new(grid_product(grid, components));
                inner_product = "L2, the mass matrix of the grid".into();
            }
        }
        let time_weights = unequal(snapshots.times());
        let snapshots = Box::new(snapshots);
        let (timed, grid) = (true, field_grid);
        Ok(Opened { snapshots, timed, time_weights, product, inner_product, grid })
    }

    /// The weights' inner product, each node's repeated for its components; without weights, identity.
    fn product(
        &self,
        unknowns: usize,
        components: usize,
    ) -> Result<(Box<dyn InnerProduct>, String), Error> {
        let Some(path) = &self.weights else {
            return Ok((Box::new(Identity::new(unknowns)), "identity".into()));
        };
        let weights = read_vector(path)?;
        let repeated = match weights.len() {
            n if n == unknowns => weights,
            n if n.checked_mul(components) == Some(unknowns) => weights.repeat(components),
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
            times: if opened.timed { basis.times.clone() } else { Vec::new() },
            grid: opened.grid,
            warnings: summary.warnings.clone(),
            provenance: provenance(manifest, String::new()),
        }
    }
}

/// Weights of the trapezoid rule where the steps between `times` differ; equal steps weigh all alike.
fn unequal(times: &[f64]) -> Option<Vec<f64>> {
    let mean = (times.last()? - times.first()?) / (times.len() - 1).max(1) as f64;
    let differ = times.windows(2).any(|pair| (pair[1] - pair[0] - mean).abs() > 1e-6 * mean);
    if differ { trapezoid(times).ok() } else { None }
}

/// Numbers in a snapshot on `grid`, if they can be counted.
fn numbers(grid: &FieldGrid) -> Option<usize> {
    grid.nodes.iter().try_fold(grid.components, |product, n| product.checked_mul(*n))
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
