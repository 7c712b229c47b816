use super::decompose::{Decomposed, Decompositions, decompose, whole};
use super::ground::Ground;
use super::reduce::reduce;
use super::simulate::simulate;
use super::{Work, compare, cost, probes, report, transfer};
use crate::Error;
use crate::case::{Case, FlowSection};
use crate::directory::{Existing, Workplace};
use crate::format::csv;
use crate::manifest::{MANIFEST, Manifest};
use crate::progress::Progress;
use crate::record::Record;
use crate::summary::{FullOrder, Projection, SUMMARY, Snapshots, Summary};
use lumley_fom::InitialFlow;
use std::path::PathBuf;
use std::time::Duration;

/// Name of the resolved case file in a run directory.
pub const CASE: &str = "case.toml";
/// Name of the initial flow's table, where the case has one.
const INITIAL_FLOW: &str = "initial_flow.csv";

/// Where a run goes and with how many threads.
///
/// ```
/// use lumley::{directory::Existing, run::Task};
/// let task = Task::new("runs/piston".into(), Existing::default());
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
    /// Least time between checkpoints of the full-order model.
    pub checkpoint: Duration,
}

impl Task {
    /// A run into `target` with all threads of this machine and a checkpoint every five seconds.
    pub fn new(target: PathBuf, existing: Existing) -> Self {
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        Self { target, existing, threads, checkpoint: Duration::from_secs(5) }
    }
}

/// Does every stage of `case`: full-order model, record, POD, reduced models, summary, report. Returns
/// where the run is, and its summary.
///
/// # Errors
/// Whatever ends it; what was done so far stays in `TARGET.partial`.
pub fn run(case: &Case, task: &Task, progress: &mut Progress) -> Result<(PathBuf, Summary), Error> {
    let place = Workplace::claim(&task.target, task.existing)?;
    let mut manifest = begin(case, &place)?;
    let work = simulate(case, &place, task.checkpoint, progress)?;
    let (steps, us) = (work.steps, work.step_us().unwrap_or_default());
    manifest.stage("full-order model", progress.end(&format!("{steps} steps of {us:.1} µs")));

    let record = Record::open(place.path().join("record"))?;
    progress.begin("pod", 1);
    let found = decompose(case, &record, &place, task.threads)?;
    manifest.stage("pod", progress.end(&found.fixed.headline()));

    let full = whole(&record.frame("fixed")?)?;
    let ground = Ground::new(case, place.path(), Some(full), found.fixed.chosen)?;
    let mut summary = summarise(&ground, &record, &found)?;
    reduced_models(&ground, &place, task, &mut summary, &mut manifest, progress)?;
    full_order_cost(&ground, &work, &mut summary, &mut manifest, progress)?;
    finish(&place, manifest, &summary, progress)?;
    Ok((place.finish()?, summary))
}

/// Writes what the run is, or checks that it goes on with the same.
pub(super) fn begin(case: &Case, place: &Workplace) -> Result<Manifest, Error> {
    let mut case = case.clone();
    if let (FlowSection::Table(_), InitialFlow::Table(rows)) =
        (&case.file.piston.initial_flow, &case.piston.initial_flow)
    {
        let (x, u): (Vec<f64>, Vec<f64>) = rows.iter().copied().unzip();
        csv::write_columns(&place.path().join(INITIAL_FLOW), &[("x", &x), ("u", &u)])?;
        case.file.piston.initial_flow = FlowSection::Table(INITIAL_FLOW.into());
    }
    let resolved = case.to_toml();
    let path = place.path().join(CASE);
    if place.resumed() && std::fs::read_to_string(&path).is_ok_and(|begun| begun != resolved) {
        return Err(Error::OtherCase { path: place.path().to_owned() });
    }
    place.write(CASE, resolved.as_bytes())?;
    let manifest = Manifest::new(&case.name, resolved.as_bytes());
    place.write(MANIFEST, manifest.to_json().as_bytes())?;
    Ok(manifest)
}

/// Writes summary, manifest and report: the run is complete but for its name.
pub(super) fn finish(
    place: &Workplace,
    mut manifest: Manifest,
    summary: &Summary,
    progress: &mut Progress,
) -> Result<(), Error> {
    place.write(SUMMARY, summary.to_json().as_bytes())?;
    progress.begin("report", 1);
    manifest.complete = true;
    place.write(MANIFEST, manifest.to_json().as_bytes())?;
    report::write(place.path(), place.target())?;
    manifest.stage("report", progress.end("report.html"));
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
        warnings: found.fixed.warnings(&case.pod),
        ..Summary::default()
    })
}

pub(super) fn snapshots(ground: &Ground) -> Snapshots {
    let Some(full) = &ground.full else { return Snapshots::default() };
    let norms = compare::norms(full.as_ref(), &ground.product);
    let max_norm = norms.into_iter().reduce(f64::max);
    Snapshots { snapshots: full.ncols(), unknowns: full.nrows(), max_norm }
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
    progress.begin("cost", 1);
    let variants = cost::variants(ground, &summary.rom)?;
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
