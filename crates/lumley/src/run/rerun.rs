use super::basis::BasisFile;
use super::decompose::whole;
use super::ground::{Ground, is_mapped};
use super::pipeline::{CASE, Task, begin, finish, full_order_cost, reduced_models, snapshots};
use super::simulate::simulate;
use super::{probes, report};
use crate::Error;
use crate::case::Case;
use crate::directory::{DirectoryError, Workplace};
use crate::progress::Progress;
use crate::record::Record;
use crate::summary::Summary;
use std::fs;
use std::path::{Path, PathBuf};

/// Runs the reduced models of the complete run in `source` again, with `settings` laid over its case: other
/// parameters or a longer time.
///
/// With `compare`, the full-order model runs with the same settings beside them. Without, they are compared
/// with the run's own record as far as it goes, unless the physics changed.
///
/// # Errors
/// Settings that would need another basis, and whatever ends a run.
pub fn rerun(
    source: &Path,
    settings: &[String],
    compare: bool,
    task: &Task,
    progress: &mut Progress,
) -> Result<(PathBuf, Summary), Error> {
    let path = source.join(CASE);
    let (before, case) = (Case::load(&path, false, &[])?, Case::load(&path, false, settings)?);
    check_basis_fits(source, &before, &case)?;
    let (_, old) = report::read_summary(source)?;
    let place = Workplace::claim(&task.target, task.existing)?;
    let mut manifest = begin(&case, &place)?;
    copy_bases(source, &place)?;

    let mut work = None;
    let mut record = None;
    if compare {
        work = Some(simulate(&case, &place, task.checkpoint, progress)?);
        manifest.stage("full-order model", progress.end("beside the reduced models"));
        record = Some(Record::open(place.path().join("record"))?);
    } else if before.piston == case.piston && before.schedule.interval == case.schedule.interval {
        record = Some(Record::open(source.join("record"))?);
    }
    let full = record.as_ref().map(|record| whole(&record.frame("fixed")?)).transpose()?;
    let shown = case.file.pod.modes.unwrap_or(old.pod.modes);
    let ground = Ground::new(&case, place.path(), full, shown)?;
    let mut summary = Summary {
        case: case.name.clone(),
        record: snapshots(&ground),
        pod: old.pod,
        pod_reference: old.pod_reference,
        probes: record.as_ref().map_or_else(|| Ok(Vec::new()), probes::probes)?,
        ..Summary::default()
    };
    reduced_models(&ground, &place, task, &mut summary, &mut manifest, progress)?;
    if let Some(work) = work {
        full_order_cost(&ground, &work, &mut summary, &mut manifest, progress)?;
    }
    finish(&place, manifest, &summary, progress)?;
    Ok((place.finish()?, summary))
}

/// A basis belongs to its mesh, its grid and its domain.
fn check_basis_fits(source: &Path, before: &Case, case: &Case) -> Result<(), Error> {
    let grid = |case: &Case| (case.cells, case.degree, case.grid.clone());
    if case.models.is_empty() {
        return Err(Error::NothingToDo { what: "the case of this run has no rom.models" });
    }
    let missing = case.models.iter().any(is_mapped) && !before.models.iter().any(is_mapped);
    if grid(before) == grid(case) && !missing {
        return Ok(());
    }
    Err(Error::OtherBasis { path: source.to_owned() })
}

/// The new run stands on its own: it has its bases with it.
fn copy_bases(source: &Path, place: &Workplace) -> Result<(), Error> {
    let folder = place.fresh_folder("basis")?;
    for name in ["fixed.npz", "reference.npz"] {
        let (from, to) = (source.join("basis").join(name), folder.join(name));
        if from.exists() {
            BasisFile::load(&from)?;
            fs::copy(&from, &to).map_err(|source| DirectoryError::Io {
                action: "write",
                path: to,
                source,
            })?;
        }
    }
    Ok(())
}
