use super::decompose::{Decomposed, Decompositions, decompose, headline, warnings, whole};
use super::ground::Ground;
use super::reduce::reduce;
use super::simulate::{full_order, simulate};
use super::{Work, checkpoint, cost, probes, report, transfer};
use crate::Error;
use crate::case::{InitialFlowSection, PistonCase};
use crate::directory::{Existing, Workplace};
use crate::manifest::{Input, MANIFEST, Manifest};
use crate::progress::Progress;
use crate::record::Record;
use crate::summary::{FullOrder, Projection, SUMMARY, Snapshots, Summary};
use lumley_fom::InitialFlow;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Name of the resolved case file in a run directory.
pub const CASE: &str = "case.toml";
/// Name of the initial flow's table, where the case has one.
const INITIAL_FLOW: &str = "initial_flow.csv";

/// Where a run goes and with how many threads.
///
/// ```
/// use lumley::{directory::Existing, run::Task};
/// let task = Task::new("runs/piston".as_ref(), Existing::default());
/// assert!(task.threads >= 1);
/// ```
#[derive(Debug, Clone)]
pub struct Task {
    /// The run directory.
    pub target: PathBuf,
    /// What may be replaced or resumed.
    pub existing: Existing,
    /// Threads of the decomposition and of the reduced models.
    pub threads: usize,
    /// Processes, this one among them, that share the work and this machine's memory.
    pub neighbours: usize,
    /// Least time between checkpoints of the full-order model, or between notes of how far a decomposition
    /// of snapshots alone is.
    pub checkpoint: Duration,
    /// What to type to get this again, for the manifest.
    pub command: String,
}

impl Task {
    /// A run into `target` by this process alone, with all threads of this machine and a checkpoint every
    /// five seconds.
    pub fn new(target: &Path, existing: Existing) -> Self {
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let command: Vec<String> = std::env::args().skip(1).collect();
        let command = format!("lumley {}", command.join(" "));
        let target = target.components().collect();
        let checkpoint = Duration::from_secs(5);
        Self { target, existing, threads, neighbours: 1, checkpoint, command }
    }
}

/// Does every stage of `case`: full-order model, record, POD, reduced models, summary, report. Returns
/// where the run is, and its summary.
///
/// # Errors
/// Whatever ends it; what was done so far stays in `TARGET.partial`.
pub fn run(
    case: &PistonCase,
    task: &Task,
    progress: &mut Progress,
) -> Result<(PathBuf, Summary), Error> {
    // What the models do not accept is said before anything is written.
    full_order(case)?;
    let place = Workplace::claim(&task.target, task.existing)?;
    let mut manifest = begin(case, task, &place)?;
    let work = simulate(case, &place, task.checkpoint, progress)?;
    let (steps, us) = (work.steps, work.step_us().unwrap_or_default());
    manifest.stage("full-order model", progress.end(&format!("{steps} steps of {us:.1} µs")));

    let record = Record::open(place.path().join("record"))?;
    progress.begin("pod", 1);
    let found = decompose(case, &record, &place, task.threads)?;
    manifest.stage("pod", progress.end(&headline(&found.fixed.basis, found.fixed.chosen)));

    let full = whole(&record.frame("fixed")?)?;
    let ground = Ground::new(case, place.path(), Some(full), found.fixed.chosen)?;
    let mut summary = summarise(&ground, &record, &found)?;
    reduced_models(&ground, &place, task, &mut summary, &mut manifest, progress)?;
    full_order_cost(&ground, &work, &mut summary, &mut manifest, progress)?;
    finish(&place, manifest, &summary, progress)?;
    Ok((place.finish()?, summary))
}

/// Writes what the run is, or checks that it goes on with the same.
pub(super) fn begin(case: &PistonCase, task: &Task, place: &Workplace) -> Result<Manifest, Error> {
    let (resolved, table) = resolved(case);
    let same = |name: &str, text: &str| {
        fs::read_to_string(place.path().join(name)).is_ok_and(|begun| begun == text)
    };
    let table_is_same = table.as_ref().is_none_or(|table| same(INITIAL_FLOW, table));
    if place.resumed() && !(same(CASE, &resolved) && table_is_same) {
        return Err(Error::OtherCase { path: place.path().to_owned() });
    }
    let mut manifest = Manifest::new(&case.name, &task.command);
    manifest.inputs.push(Input::new(CASE, resolved.as_bytes()));
    if let Some(table) = &table {
        manifest.inputs.push(Input::new(INITIAL_FLOW, table.as_bytes()));
    }
    // First of all: by its manifest a directory is known as lumley's.
    place.write(MANIFEST, manifest.to_json().as_bytes())?;
    if let Some(table) = &table {
        place.write(INITIAL_FLOW, table.as_bytes())?;
    }
    place.write(CASE, resolved.as_bytes())?;
    Ok(manifest)
}

/// The case as the run directory keeps it, and the table of its initial flow, if it has one.
fn resolved(case: &PistonCase) -> (String, Option<String>) {
    let InitialFlow::Table(rows) = &case.piston.initial_flow else { return (case.to_toml(), None) };
    let mut case = case.clone();
    case.file.piston.initial_flow = InitialFlowSection::Table(INITIAL_FLOW.into());
    let rows = rows.iter().map(|(x, u)| format!("{x:?},{u:?}\n"));
    (case.to_toml(), Some(std::iter::once("x,u\n".to_owned()).chain(rows).collect()))
}

/// Writes summary, report and, last, that the run is complete but for its name.
pub(super) fn finish(
    place: &Workplace,
    mut manifest: Manifest,
    summary: &Summary,
    progress: &mut Progress,
) -> Result<(), Error> {
    place.write(SUMMARY, summary.to_json().as_bytes())?;
    place.write(MANIFEST, manifest.to_json().as_bytes())?;
    progress.begin("report", 1);
    report::write(place.path())?;
    manifest.stage("report", progress.end("report.html"));
    checkpoint::remove(place)?;
    manifest.complete = true;
    place.write(MANIFEST, manifest.to_json().as_bytes())?;
    Ok(())
}

/// What the run is and what its decomposition found.
fn summarise(ground: &Ground, record: &Record, found: &Decompositions) -> Result<Summary, Error> {
    let case = ground.case;
    Ok(Summary {
        case: case.name.clone(),
        record: snapshots(ground),
        transfer: Some(transfer::summary(record.series("transfer")?)),
        pod: found.fixed.summary(),
        pod_reference: found.reference.as_ref().map(Decomposed::summary),
        projection: Projection { res_percent: found.projection_percent.clone() },
        probes: probes::probes(record)?,
        warnings: warnings(&found.fixed.basis, &case.pod),
        ..Summary::default()
    })
}

pub(super) fn snapshots(ground: &Ground) -> Snapshots {
    let Some(full) = &ground.full else { return Snapshots::default() };
    let (unknowns, snapshots) = full.velocities.shape();
    Snapshots { snapshots, unknowns, max_norm: Some(full.largest) }
}

/// Runs the reduced models into the summary.
pub(super) fn reduced_models(
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
pub(super) fn full_order_cost(
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
    summary.fom = Some(FullOrder {
        steps: ground.case.schedule.steps(),
        step_us: work.step_us().unwrap_or_default(),
        unknowns: ground.unknowns(),
        iterations_mean: work.iterations as f64 / work.steps.max(1) as f64,
        variants,
    });
    manifest.stage("cost", progress.end(&beside));
    Ok(())
}
