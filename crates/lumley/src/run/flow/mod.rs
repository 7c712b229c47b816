//! The run of a flow: full-order model, record, POD, report. Its directory holds, beside what every run has:
//!
//! | file | content |
//! |---|---|
//! | `mesh.npz` | the mesh when nothing has moved: `points` (n x 2, in m), `triangles` (6 nodes each) and `quadrilaterals` (9), `boundaries/NAME` (two ends and middle of each edge) |
//! | `loads.csv` | `time`, and for each boundary `NAME.fx`, `NAME.fy` in N/m, `NAME.moment` in N about the centre of mass of a body that moves, else about the origin, with a reference also `NAME.cd`, `NAME.cl` |
//! | `bodies.csv` | where there are `[[bodies]]`: `time`, for each coordinate its label, such as `bar.angle`, in m or rad and `bar.angle'` in m/s or rad/s, then for each body `NAME.centre_x`, `NAME.centre_y`, the centre of mass in m, and `NAME.orientation`, its angle in rad: a row at the start, then as often as in `loads.csv` |
//! | `probes.csv` | `time`, for each probe `NAME.u`, `NAME.v`, `NAME.p`, and `pressure_difference`; NaN where a body covers the probe |
//! | `steps.csv` | `time`, `step` in s, `cfl`, `iterations`, `renewals`, `error`: a row as often as in `loads.csv` |
//! | `residuals.csv` | of a steady flow: `iteration` and `change` |
//! | `paraview/flow.pvd` | the series of VTU files: velocity, pressure, vorticity, `mesh_velocity` |
//! | `record` | where the case has `[record]`: frame `fixed` (u, v) and the series of `pictures` |
//! | `pictures` | a record for the report: frame `picture` (u, v, p, vorticity; zero in bodies but for the velocity) at up to 100 times, and the series `loads-NAME` (fx, fy, moment), `cfl`, `iterations`, and for each of the `[[bodies]]`, in their order, `position-NAME` (x, y, angle: displacement of its pivot in m and turn in rad from the mesh as given), for each of their coordinates `body-LABEL` (position, velocity), with `_` for the dot |
//! | `end.npz` | the last state, from which another run can start: `points` (in m), `velocity` at its dofs (in m/s), `pressure` (three coefficients for each cell), `time` |
//!
//! Its `summary.json` has, beside what every run has ([`Summary`]):
//!
//! | key | content |
//! |---|---|
//! | `loads.NAME` | of each boundary: drag and lift over the last full periods |
//! | `bodies.NAME` | of each of the `[[bodies]]`: amplitude and frequency of the centre of mass over the last full periods and in each of them, the last state, and its coordinates |
//! | `probes` | what `[output.probes]` asks for: `time`, the coordinates by the names given to them, `fx` and `fy` in N/m, `mg`, the moment about the centre of mass, in N; between two rows of `bodies.csv` and `loads.csv`, on the straight line through them |
//! | `transfer` | where the case has `[record]`: `finite-element` and `inverse-distance`, each with the errors `l2`, `max` and `nodes` of the last state on the grid, relative, and `ms` for a snapshot |
//! | `pod.divergence`, `pod.snapshot_divergence` | the norm of the divergence over that of the gradient, of each mode and of the snapshots, where no body ever was |
//! | `pod_every` | with `pod.every`: the POD of every so many snapshots alone |

mod archive;
mod bodies;
mod columns;
pub(crate) mod coupling;
mod decompose;
mod fluid;
mod instruments;
mod outputs;
mod paraview;
mod picture;
mod points;
mod series;
mod snapshots;
mod start;
mod statistics;
mod steady;
mod timeline;
mod transfer;

pub use start::planar_flow;

use super::stages::{CASE, Kept, begin, finish};
use super::{Task, Work, checkpoint, keeper};
use crate::Error;
use crate::case::{FlowCase, March, RecordChoice};
use crate::directory::{DirectoryError, Workplace};
use crate::format::mesh;
use crate::manifest::memory_peak;
use crate::model::{FlowModel, StepError};
use crate::progress::Progress;
use crate::summary::{FullOrder, Summary};
use decompose::decompose;
use lumley_fem::UniformGrid;
use lumley_fem::transfer::Transfer;
use outputs::FlowOutputs;
use points::Points;
use std::fs;
use std::path::PathBuf;
use timeline::Timeline;

/// Does every stage of `case`: full-order model, record, POD, summary, report. Returns where the run is, and
/// its summary.
///
/// # Errors
/// Whatever ends it; what was done so far stays in `TARGET.partial`.
pub(super) fn run(
    case: &FlowCase,
    task: &Task,
    progress: &mut Progress,
) -> Result<(PathBuf, Summary), Error> {
    // What the model does not accept is said before anything is written.
    let mut model = planar_flow(case, task.threads)?;
    let plan = Plan::new(case, &mut model)?;
    let kept = kept(case)?;
    let place = Workplace::claim(&task.target, task.existing)?;
    let mut manifest = begin(&case.name, &kept, task, &place)?;
    mesh::write(&place.path().join(archive::MESH), &case.mesh)?;
    progress.warn(&plan.warnings);

    let work = match &case.march {
        March::Steady(choice) => {
            steady::settle(&plan, &mut model, *choice, (task, &place), progress)
        }
        March::Unsteady(_) => simulate(&plan, &mut model, (task, &place), progress),
    }?;
    archive::write_end(&place.path().join(archive::END), &model)?;
    let (steps, ms) = (work.steps, 1e-3 * work.step_us().unwrap_or_default());
    manifest.stage("full-order model", progress.end(&format!("{steps} steps of {ms:.2} ms")));

    let mut summary = summarise(&plan, &model, &work, (task, &place))?;
    if let Some(record) = &case.record {
        let files = (&mut summary, &mut manifest);
        decompose((case, record), &model, (task, &place), files, progress)?;
    }
    finish(&place, manifest, &summary, progress)?;
    Ok((place.finish()?, summary))
}

/// What the run was, and what was measured.
fn summarise(
    Plan { case, warnings, .. }: &Plan,
    model: &FlowModel,
    work: &Work,
    (task, place): (&Task, &Workplace),
) -> Result<Summary, Error> {
    let folder = place.path();
    Ok(Summary {
        case: case.name.clone(),
        directory: task.target.display().to_string(),
        fom: Some(FullOrder {
            renewals: Some(work.renewals),
            memory_bytes: memory_peak(),
            residuals: statistics::residuals(folder)?,
            ..FullOrder::new(model.flow().unknowns(), work)
        }),
        probes: bodies::probes(case.bodies.as_ref(), folder)?,
        bodies: bodies::motions(model, folder)?,
        loads: statistics::loads(case, model, folder)?,
        pressure_difference: statistics::pressure_difference(folder)?,
        warnings: warnings.clone(),
        ..Summary::default()
    })
}

/// What is written of a run, and when.
struct Plan<'a> {
    case: &'a FlowCase,
    timeline: Timeline,
    /// Where pictures are taken.
    picture: UniformGrid,
    /// Where velocity and pressure are measured.
    points: Points,
    /// What the reader should know, in sentences.
    warnings: Vec<String>,
}

impl<'a> Plan<'a> {
    /// Makes the grids of the record and of the pictures known to the model.
    fn new(case: &'a FlowCase, model: &mut FlowModel) -> Result<Self, Error> {
        let timeline = Timeline::new(case);
        let picture = picture::grid(case, timeline.pictures());
        let mut warnings = Vec::new();
        if let Some(RecordChoice { grid, transfer, .. }) = &case.record {
            let coverage = model.add_grid(grid.clone(), *transfer, false);
            let outside = coverage.map_err(StepError::from)?.outside;
            if outside > 0 {
                let all = grid.len();
                warnings.push(format!(
                    "{outside} of the {all} nodes of the fixed grid are outside of the mesh: the record has zero there"
                ));
            }
        }
        let method = Transfer::FiniteElement {};
        model.add_grid(picture.clone(), method, true).map_err(StepError::from)?;
        warnings.extend(model.flow().added_mass_share().and_then(coupling::warning));
        if model.flow().has_level_pressure() {
            let what = "no boundary is traction-free, so that the pressure is known up to a constant: its mean is zero";
            warnings.push(what.into());
        }
        let points = Points::new(case, model.flow().mesh())?;
        Ok(Self { case, timeline, picture, points, warnings })
    }
}

/// Runs the model through time into its files, from the checkpoint when there is one.
fn simulate(
    plan: &Plan,
    model: &mut FlowModel,
    (task, place): (&Task, &Workplace),
    progress: &mut Progress,
) -> Result<Work, Error> {
    progress.begin("full-order model", 1);
    let before = checkpoint::restore(place, model)?;
    let mut outputs = match &before {
        Some(before) => FlowOutputs::resume(plan, model, place, before)?,
        None => FlowOutputs::create(plan, model, place)?,
    };
    keeper::simulate(model, &plan.timeline, &mut outputs, before, (task, place), progress)
}

/// The files that the run directory keeps: the resolved case, and copies of the files that it names.
fn kept(case: &FlowCase) -> Result<Vec<Kept>, Error> {
    let resolved = case.kept();
    let mut kept = vec![Kept::new(CASE, resolved.case)];
    for input in resolved.inputs {
        let path = input.path;
        let content = fs::read(&path);
        let content = content.map_err(|source| DirectoryError::Io { action: "read", path, source });
        kept.push(Kept::new(&input.name, content?));
    }
    Ok(kept)
}
