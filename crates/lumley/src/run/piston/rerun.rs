use super::ground::{Ground, is_mapped};
use super::simulate::{full_order, simulate};
use super::{full_order_cost, kept, probes, reduced_models, snapshots};
use crate::Error;
use crate::case::{PistonCase, PistonFile, PodSection};
use crate::directory::{DirectoryError, Workplace};
use crate::progress::Progress;
use crate::record::Record;
use crate::run::decompose::whole;
use crate::run::stages::{CASE, begin, check_is_of_a_case, finish, read_summary};
use crate::run::{BasisFile, Task};
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
    if task.target.canonicalize().is_ok_and(|to| source.canonicalize().is_ok_and(|s| s == to)) {
        return Err(Error::OntoItself { path: source.to_owned() });
    }
    check_is_of_a_case(source)?;
    let path = source.join(CASE);
    let (before, mut case) =
        (PistonCase::load(&path, false, &[])?, PistonCase::load(&path, false, settings)?);
    check_basis_fits(source, &before, &case)?;
    let (made_by, old) = read_summary(source)?;
    case.name = made_by.case;
    full_order(&case)?;
    let place = Workplace::claim(&task.target, task.existing)?;
    let mut manifest = begin(&case.name, &kept(&case), task, &place)?;
    copy_bases(source, &place)?;

    let mut work = None;
    let mut record = None;
    if compare {
        work = Some(simulate(&case, task, &place, progress)?);
        manifest.stage("full-order model", progress.end("beside the reduced models"));
        record = Some(Record::open(place.path().join("record"))?);
    } else if is_same_flow(&before, &case) && source.join("record").exists() {
        record = Some(Record::open(source.join("record"))?);
    }
    let full = record.as_ref().map(|record| whole(&record.frame("fixed")?)).transpose()?;
    let snapshots_to_compare = case.schedule.snapshots();
    let full = full.map(|x| x.subcols(0, x.ncols().min(snapshots_to_compare)).to_owned());
    let shown = case.file.pod.modes.unwrap_or(old.pod.modes);
    let ground = Ground::new(&case, place.path(), full, shown)?;
    let mut summary = Summary {
        case: case.name.clone(),
        record: snapshots(&ground),
        pod: old.pod,
        pod_reference: old.pod_reference,
        probes: if compare {
            record.as_ref().map_or(Ok(Vec::new()), probes::probes)?
        } else {
            Vec::new()
        },
        basis: Some(source.display().to_string()),
        warnings: window(&case, &ground).into_iter().collect(),
        ..Summary::default()
    };
    reduced_models(&ground, &place, task, &mut summary, &mut manifest, progress)?;
    if let Some(work) = work {
        full_order_cost(&ground, &work, &mut summary, &mut manifest, progress)?;
    }
    finish(&place, manifest, &summary, progress)?;
    Ok((place.finish()?, summary))
}

/// Whether both cases have the same solution at the same times, as far as both go.
fn is_same_flow(before: &PistonCase, case: &PistonCase) -> bool {
    before.piston == case.piston && before.schedule.interval == case.schedule.interval
}

/// Over which time the models are compared, where that is not the whole of it.
fn window(case: &PistonCase, ground: &Ground) -> Option<String> {
    let compared = ground.full.as_ref()?.velocities.ncols();
    let end = case.schedule.time(compared - 1);
    let all = compared == case.schedule.snapshots();
    (!all).then(|| format!("Res is that of the first {end} s, for which the run has a record"))
}

/// A basis belongs to its mesh, its grid, its domain and its decomposition.
fn check_basis_fits(source: &Path, before: &PistonCase, case: &PistonCase) -> Result<(), Error> {
    if case.models.is_empty() {
        return Err(Error::NothingToDo { what: "the case of this run has no rom.models" });
    }
    let (old, new) = (&before.file, &case.file);
    let pod = |file: &PistonFile| PodSection { modes: None, ..file.pod.clone() };
    let changed = [
        ("mesh", old.mesh != new.mesh),
        ("grid", old.grid != new.grid),
        ("transfer", old.transfer != new.transfer),
        ("piston.domain_length", old.piston.domain_length != new.piston.domain_length),
        ("pod", pod(old) != pod(new)),
        ("rom.models", case.models.iter().any(is_mapped) && !before.models.iter().any(is_mapped)),
    ];
    match changed.into_iter().find(|(_, changed)| *changed) {
        Some((key, _)) => Err(Error::OtherBasis { path: source.to_owned(), key }),
        None => Ok(()),
    }
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
