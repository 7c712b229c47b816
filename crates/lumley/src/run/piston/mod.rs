//! The run of a piston: full-order model, record, POD, reduced models, what they cost, report.

mod compare;
mod cost;
mod decompose;
mod ground;
mod probes;
mod reduce;
mod report;
mod rerun;
mod simulate;
mod transfer;

pub(super) use report::report;
pub use rerun::rerun;
pub use simulate::full_order;

use super::decompose::{Decomposed, OnGrid, headline, warnings, whole};
use super::stages::{CASE, Kept, begin, finish};
use super::{Task, Work};
use crate::Error;
use crate::case::{InitialFlowSection, PistonCase};
use crate::directory::Workplace;
use crate::manifest::Manifest;
use crate::progress::Progress;
use crate::record::Record;
use crate::summary::{FullOrder, Projection, Snapshots, Summary};
use decompose::{Decompositions, decompose};
use ground::Ground;
use lumley_fom::InitialFlow;
use reduce::reduce;
use simulate::simulate;
use std::path::PathBuf;

/// Name of the initial flow's table, where the case has one.
const INITIAL_FLOW: &str = "initial_flow.csv";

/// Does every stage of `case`: full-order model, record, POD, reduced models, summary, report. Returns
/// where the run is, and its summary.
///
/// # Errors
/// Whatever ends it; what was done so far stays in `TARGET.partial`.
pub(super) fn run(
    case: &PistonCase,
    task: &Task,
    progress: &mut Progress,
) -> Result<(PathBuf, Summary), Error> {
    // What the models do not accept is said before anything is written.
    full_order(case)?;
    let place = Workplace::claim(&task.target, task.existing)?;
    let mut manifest = begin(&case.name, &kept(case), task, &place)?;
    let work = simulate(case, task, &place, progress)?;
    let (steps, us) = (work.steps, work.step_us().unwrap_or_default());
    manifest.stage("full-order model", progress.end(&format!("{steps} steps of {us:.1} µs")));

    let record = Record::open(place.path().join("record"))?;
    progress.begin("pod", 1);
    let found = decompose(case, &record, &place, task.threads)?;
    manifest.stage("pod", progress.end(&headline(&found.fixed.pod.basis, found.fixed.pod.chosen)));

    let full = whole(&record.frame("fixed")?)?;
    let ground = Ground::new(case, place.path(), Some(full), found.fixed.pod.chosen)?;
    let mut summary = summarise(&ground, &record, &found)?;
    reduced_models(&ground, &place, task, &mut summary, &mut manifest, progress)?;
    full_order_cost(&ground, &work, &mut summary, &mut manifest, progress)?;
    finish(&place, manifest, &summary, progress)?;
    Ok((place.finish()?, summary))
}

/// The files that the run directory keeps: the resolved case, and the table of its initial flow, if it has
/// one.
fn kept(case: &PistonCase) -> Vec<Kept> {
    let InitialFlow::Table(rows) = &case.piston.initial_flow else {
        return vec![Kept::new(CASE, case.to_toml())];
    };
    let mut case = case.clone();
    case.file.piston.initial_flow = InitialFlowSection::Table(INITIAL_FLOW.into());
    let rows = rows.iter().map(|(x, u)| format!("{x:?},{u:?}\n"));
    let table: String = std::iter::once("x,u\n".to_owned()).chain(rows).collect();
    vec![Kept::new(CASE, case.to_toml()), Kept::new(INITIAL_FLOW, table)]
}

/// What the run is and what its decomposition found.
fn summarise(ground: &Ground, record: &Record, found: &Decompositions) -> Result<Summary, Error> {
    let case = ground.case;
    let OnGrid { pod, res_percent, every } = &found.fixed;
    Ok(Summary {
        case: case.name.clone(),
        record: snapshots(ground),
        transfer: Some(transfer::summary(record.series("transfer")?)),
        pod: pod.summary(),
        pod_every: every.clone(),
        pod_reference: found.reference.as_ref().map(Decomposed::summary),
        projection: Projection { res_percent: res_percent.clone() },
        probes: probes::probes(record)?,
        warnings: warnings(&pod.basis, &case.pod),
        ..Summary::default()
    })
}

fn snapshots(ground: &Ground) -> Snapshots {
    let Some(full) = &ground.full else { return Snapshots::default() };
    let (unknowns, snapshots) = full.velocities.shape();
    Snapshots { snapshots, unknowns, max_norm: Some(full.largest) }
}

/// Runs the reduced models into the summary.
fn reduced_models(
    ground: &Ground,
    place: &Workplace,
    task: &Task,
    summary: &mut Summary,
    manifest: &mut Manifest,
    progress: &mut Progress,
) -> Result<(), Error> {
    summary.directory = task.target.display().to_string();
    summary.rom = reduce(ground, place, task.threads, progress)?;
    let (models, runs) =
        (summary.rom.len(), summary.rom.iter().map(|m| m.modes.len()).sum::<usize>());
    let warnings =
        summary.rom.iter().filter_map(|model| model.warnings(ground.case.rom_schedule.step));
    summary.warnings.extend(warnings.collect::<Vec<_>>());
    progress.warn(&summary.warnings);
    manifest.stage("reduced models", progress.end(&format!("{models} models, {runs} runs")));
    Ok(())
}

/// Adds what the full-order model cost, and what coarser ones would.
fn full_order_cost(
    ground: &Ground,
    work: &Work,
    summary: &mut Summary,
    manifest: &mut Manifest,
    progress: &mut Progress,
) -> Result<(), Error> {
    let variants = cost::variants(ground, work, &summary.rom, progress)?;
    for (choice, model) in ground.case.models.iter().zip(&mut summary.rom) {
        model.speedup = cost::speedup(ground, choice, model, &variants)?;
    }
    let beside = format!("{} coarser full-order models beside", variants.len());
    summary.fom = Some(FullOrder { variants, ..FullOrder::new(ground.unknowns(), work) });
    manifest.stage("cost", progress.end(&beside));
    Ok(())
}
