//! `lumley pod`: the decomposition of snapshots by themselves, of any size, by any number of machines.

mod inputs;
mod journal;
mod old;
mod open;
mod place;
mod watch;

use super::Task;
use super::decompose::{algorithm, headline, summary_of, warnings};
use super::modes::{FileModes, drawn};
use super::report::{columns, save};
use crate::Error;
use crate::case::PodChoice;
use crate::directory;
use crate::format::npy::SnapshotLayout;
use crate::manifest::{MANIFEST, Manifest, memory};
use crate::progress::Progress;
use crate::ranks::together;
use crate::report::{FieldGrid, PodReport, Provenance};
use crate::summary::{Projection, SUMMARY, Snapshots, Summary};
use journal::FileJournal;
use lumley_pod::{
    Decomposition, Execution, Options, Ranks, Selection, SnapshotSource, finite_snapshots,
};
use old::OldFile;
use open::{Opened, unequal};
use place::WORK;
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
///     choice: PodChoice {
///         method: "auto".into(),
///         truncation: Truncation::Modes(6),
///         center: false,
///         every: None,
///     },
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
    /// Most memory that this process may take for the decomposition, in bytes; by default a quarter of the
    /// machine's, shared with its neighbours.
    pub memory: Option<u64>,
    /// Whether snapshots that hold NaN or infinity are left out; else they are an error.
    pub skip_non_finite: bool,
    /// A `pod.npz`, or a directory with one, that the snapshots update: what comes of it is the POD of
    /// those it was made of and of these. The method is `incremental` then.
    pub update: Option<PathBuf>,
}

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
    let opened = together(ranks, input.open(&task.target, ranks))?;
    let is_first = ranks.rank() == 0;
    let place = if is_first { place::claim(input, task).map(Some) } else { Ok(None) };
    let place = together(ranks, place)?;
    let done = match place::complete(ranks, place.as_ref())? {
        Some(summary) => Ok(summary),
        None => together(ranks, decompose_into(input, &opened, task, ranks, progress)),
    };
    let left = place.map_or(Ok(()), |place| place::leave(place, &done));
    let left = together(ranks, left);
    // What failed first is said first.
    let summary = done?;
    left?;
    Ok((task.target.clone(), summary))
}

fn decompose_into(
    input: &PodInput,
    opened: &Opened,
    task: &Task,
    ranks: &dyn Ranks,
    progress: &mut Progress,
) -> Result<Summary, Error> {
    progress.begin("pod", 1);
    let folder = &directory::partial(&task.target);
    let modes = FileModes::new(folder);
    let journal = FileJournal::new(&folder.join(WORK), task.checkpoint, task.existing.resume);
    let execution = Execution { ranks, journal: &journal, ..Execution::default() };
    let mut options = Options { residuals: true, ..input.options(opened, task) };
    let selection = input.selection(opened, &mut options, execution, progress)?;
    let x = selection.as_ref().map_or(opened.snapshots.as_ref(), |some| some);
    let before = usize::from(selection.is_some());
    let watch = Passes::new(progress, before);
    let execution = Execution { watch: &watch, ..execution };
    let mut found = input.stream(x, opened, &options, execution, &modes)?;
    found.passes += before;
    modes.finish(ranks, &found)?;
    let seconds =
        progress.end(&format!("{} in {} passes", headline(&found, found.size()), found.passes));
    let mut summary = input.summary(opened, &found);
    summary.warnings.extend(left_out(opened, &found));
    summary.directory = task.target.display().to_string();
    progress.warn(&summary.warnings);
    if ranks.rank() == 0 {
        input.write(folder, opened, &found, &summary, seconds)?;
    }
    Ok(summary)
}

impl PodInput {
    fn options(&self, opened: &Opened, task: &Task) -> Options {
        let threads = std::num::NonZero::new(task.threads).filter(|n| n.get() > 1);
        let par = threads.map_or(faer::Par::Seq, faer::Par::Rayon);
        let quarter = memory() / 4.0 / task.neighbours as f64;
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

    /// Where some snapshots may have to be left out, those that stay, found in one pass; they are weighed
    /// anew.
    fn selection<'o>(
        &self,
        opened: &'o Opened,
        options: &mut Options,
        execution: Execution<'_>,
        progress: &mut Progress,
    ) -> Result<Option<Selection<'o>>, Error> {
        if !self.skip_non_finite {
            return Ok(None);
        }
        let x = opened.snapshots.as_ref();
        let watch = Passes::new(progress, 0);
        let execution = Execution { watch: &watch, ..execution };
        let finite = finite_snapshots(x, options, execution).map_err(Error::pod(&self.path))?;
        let selection = Selection::new(x, finite);
        if opened.timed && selection.times().len() < x.times().len() {
            options.time_weights = unequal(selection.times());
        }
        Ok(Some(selection))
    }

    /// The decomposition of `x`, and of the old snapshots where there are some.
    fn stream(
        &self,
        x: &dyn SnapshotSource,
        opened: &Opened,
        options: &Options,
        execution: Execution<'_>,
        modes: &FileModes,
    ) -> Result<Decomposition, Error> {
        let found = if let Some(old) = &opened.old {
            old.updated(x, opened, options, execution, modes)
        } else {
            let stream = algorithm(&self.choice.method).stream;
            stream(x, opened.product.as_ref(), options, execution, modes)
        };
        found.map_err(Error::pod(&self.path))
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
            provenance: Provenance::of(&manifest, String::new()),
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
