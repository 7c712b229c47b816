//! `lumley pod`: the decomposition of snapshots by themselves, of any size, by any number of machines.

mod journal;
mod old;
mod open;
mod watch;

use super::decompose::{algorithm, headline, summary_of, warnings};
use super::modes::{FileModes, SCRATCH, drawn};
use super::pipeline::Task;
use super::report::{columns, provenance, save};
use crate::Error;
use crate::case::PodChoice;
use crate::directory::{self, Workplace};
use crate::format::npy::SnapshotLayout;
use crate::manifest::{MANIFEST, Manifest, ManifestError, memory};
use crate::progress::Progress;
use crate::ranks::together;
use crate::report::{FieldGrid, PodReport};
use crate::summary::{Projection, SUMMARY, Snapshots, Summary};
use journal::FileJournal;
use lumley_pod::{
    Decomposition, Execution, Options, Ranks, Selection, SnapshotSource, finite_snapshots,
};
use old::OldFile;
use open::{Opened, unequal};
use std::path::{Path, PathBuf};
use watch::Passes;

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
///     memory: None,
///     skip_non_finite: false,
///     update: None,
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
    /// Most memory that the decomposition may take, in bytes; by default a quarter of the machine's.
    pub memory: Option<u64>,
    /// Whether snapshots that hold NaN or infinity are left out; else they are an error.
    pub skip_non_finite: bool,
    /// A `pod.npz`, or a directory with one, that the snapshots update: what comes of it is the POD of
    /// those it was made of and of these. The method is `incremental` then.
    pub update: Option<PathBuf>,
}

/// Folder of a run for what a resumed decomposition needs; it goes when the run is complete.
const WORK: &str = "work";

/// POD of snapshots alone: writes `pod.npz`, `summary.json`, `report.html` and figures. Every rank calls
/// it; rank 0 writes what is not the modes, and has the summary.
///
/// # Errors
/// Files that are missing, damaged or do not fit together; snapshots without energy; a disk that
/// fails: what was done until then stays in `TARGET.partial`, and is gone on with where the task
/// resumes.
pub fn decompose_snapshots(
    input: &PodInput,
    task: &Task,
    ranks: &dyn Ranks,
    progress: &mut Progress,
) -> Result<(PathBuf, Summary), Error> {
    let opened = together(ranks, input.open(&task.target))?;
    let first = ranks.rank() == 0;
    let place = if first { claim(input, task).map(Some) } else { Ok(None) };
    let place = together(ranks, place)?;
    let folder = directory::partial(&task.target);
    let done = decompose_into(input, &opened, task, &folder, ranks, progress);
    let left = match (place, &done) {
        (Some(place), Ok(_)) => finish(place),
        (Some(place), Err(error)) if !is_worth_resuming(error, &folder) => {
            place.abandon().map_err(Error::from)
        }
        _ => Ok(()),
    };
    together(ranks, left)?;
    Ok((task.target.clone(), done?))
}

/// The run directory; one that is taken up again must have been begun with the same snapshots.
fn claim(input: &PodInput, task: &Task) -> Result<Workplace, Error> {
    let mut manifest = Manifest::new(&input.path.display().to_string(), &task.command);
    manifest.inputs = input.inputs()?;
    let place = Workplace::claim(&task.target, task.existing)?;
    manifest.settings = input.settings();
    if place.resumed() && !begun_with(&place, &manifest)? {
        return Err(Error::OtherSnapshots { path: place.path().to_owned() });
    }
    place.write(MANIFEST, manifest.to_json().as_bytes())?;
    place.folder(WORK)?;
    Ok(place)
}

/// Whether the unfinished decomposition was begun with what `manifest` says, or killed before it said.
fn begun_with(place: &Workplace, manifest: &Manifest) -> Result<bool, Error> {
    let what = |m: &Manifest| (m.version.clone(), m.inputs.clone(), m.settings.clone());
    match Manifest::read(place.path()) {
        Ok(begun) => Ok(what(&begun) == what(manifest)),
        Err(ManifestError::Missing { .. }) => Ok(true),
        Err(error) => Err(directory::DirectoryError::from(error).into()),
    }
}

/// What failed may go on where the medium was to blame and a pass was under way.
fn is_worth_resuming(error: &Error, folder: &Path) -> bool {
    let entries = std::fs::read_dir(folder.join(WORK)).into_iter().flatten().flatten();
    error.is_of_medium() && entries.count() > 0
}

/// The journal goes first: while there is one, what it counts on is there too.
fn finish(place: Workplace) -> Result<(), Error> {
    place.remove(WORK)?;
    place.remove(SCRATCH)?;
    place.finish()?;
    Ok(())
}

fn decompose_into(
    input: &PodInput,
    opened: &Opened,
    task: &Task,
    folder: &Path,
    ranks: &dyn Ranks,
    progress: &mut Progress,
) -> Result<Summary, Error> {
    progress.begin("pod", 1);
    let modes = FileModes::new(folder);
    let journal = FileJournal::new(&folder.join(WORK), task.checkpoint, task.existing.resume);
    let watch = Passes::new(progress);
    let execution = Execution { ranks, journal: &journal, watch: &watch };
    let mut options = Options { residuals: true, ..input.options(opened, task, ranks) };
    let selection = input.selection(opened, &mut options, execution)?;
    let x: &dyn SnapshotSource = &selection;
    let w = opened.product.as_ref();
    let found = match &opened.old {
        Some(old) => old.updated(x, opened, &options, execution, &modes),
        None => (algorithm(&input.choice.method).stream)(x, w, &options, execution, &modes),
    };
    let found = found.map_err(Error::pod(&input.path))?;
    modes.finish(ranks, &found)?;
    let seconds =
        progress.end(&format!("{} in {} passes", headline(&found, found.size()), found.passes));
    let mut summary = input.summary(opened, &found);
    summary.warnings.extend(left_out(opened, &found));
    summary.directory = task.target.display().to_string();
    progress.warn(&summary.warnings);
    let written = if ranks.rank() == 0 {
        input.write(folder, opened, &found, &summary, seconds)
    } else {
        Ok(())
    };
    together(ranks, written)?;
    Ok(summary)
}

impl PodInput {
    fn options(&self, opened: &Opened, task: &Task, ranks: &dyn Ranks) -> Options {
        let threads = std::num::NonZero::new(task.threads).filter(|n| n.get() > 1);
        let par = threads.map_or(faer::Par::Seq, faer::Par::Rayon);
        // Ranks of one machine share its memory; more than it has cores are on others.
        let neighbours =
            ranks.count().min(std::thread::available_parallelism().map_or(1, usize::from));
        let quarter = memory() / 4.0 / neighbours as f64;
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a positive size"
        )]
        let memory_limit = self.memory.unwrap_or(quarter as u64);
        let (truncation, center) = (self.choice.truncation, self.is_centred(opened));
        let time_weights = opened.time_weights.clone();
        Options { truncation, center, time_weights, par, memory_limit, residuals: false }
    }

    /// What must be the same for a decomposition to go on, beside its inputs.
    fn settings(&self) -> String {
        let Self { path, layout, components, choice, skip_non_finite, .. } = self;
        let modified = std::fs::metadata(path).and_then(|metadata| metadata.modified()).ok();
        format!("{layout:?} {components} {choice:?} {skip_non_finite} {modified:?}")
    }

    /// The snapshots, less those that are to be left out; the others are weighed anew.
    fn selection<'o>(
        &self,
        opened: &'o Opened,
        options: &mut Options,
        execution: Execution<'_>,
    ) -> Result<Selection<'o>, Error> {
        let x = opened.snapshots.as_ref();
        let count = x.times().len();
        if !self.skip_non_finite {
            return Ok(Selection::new(x, (0..count).collect()));
        }
        let finite = finite_snapshots(x, options, execution).map_err(Error::pod(&self.path))?;
        let selection = Selection::new(x, finite);
        if opened.timed && selection.times().len() < count {
            options.time_weights = unequal(selection.times());
        }
        Ok(selection)
    }

    fn summary(&self, opened: &Opened, found: &Decomposition) -> Summary {
        let x = opened.snapshots.as_ref();
        let percent = found.residuals.iter().map(|res| 100.0 * res).collect();
        Summary {
            case: self.path.display().to_string(),
            record: Snapshots { snapshots: found.times.len(), unknowns: x.dim(), max_norm: None },
            pod: summary_of(found, found.size()),
            projection: Projection { res_percent: percent },
            warnings: warnings(found, &self.choice),
            ..Summary::default()
        }
    }

    /// Summary, report and manifest beside the modes.
    fn write(
        &self,
        folder: &Path,
        opened: &Opened,
        found: &Decomposition,
        summary: &Summary,
        seconds: f64,
    ) -> Result<(), Error> {
        let mut manifest = Manifest::read(folder).map_err(directory::DirectoryError::from)?;
        manifest.stage("pod", seconds);
        directory::write(folder, SUMMARY, summary.to_json().as_bytes())?;
        let modes = drawn(&folder.join("pod.npz"), opened.grid)?;
        let report = PodReport {
            source: self.source(),
            snapshots: summary.record.snapshots,
            unknowns: summary.record.unknowns,
            inner_product: opened.inner_product.clone(),
            centred: self.is_centred(opened),
            method: summary.pod.method.clone(),
            reason: summary.pod.reason.clone(),
            eigenvalues: found.eigenvalues.clone(),
            total_energy: found.total_energy,
            error_bound: found.error_bound,
            modes,
            coefficients: columns(found.coefficients.transpose()),
            times: if opened.timed { found.times.clone() } else { Vec::new() },
            warnings: summary.warnings.clone(),
            provenance: provenance(&manifest, String::new()),
        };
        save(folder, &report.render())?;
        manifest.complete = true;
        directory::write(folder, MANIFEST, manifest.to_json().as_bytes())?;
        Ok(())
    }
}

/// What to know of snapshots that were left out.
fn left_out(opened: &Opened, found: &Decomposition) -> Option<String> {
    let old = opened.old.as_ref().map_or(0, OldFile::snapshots);
    let (all, used) = (opened.snapshots.times().len(), found.times.len() - old);
    let count = all.checked_sub(used).filter(|count| *count > 0)?;
    Some(format!("{count} of {all} snapshots hold NaN or infinity and were left out"))
}
