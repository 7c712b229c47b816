//! From the record of a flow to its POD.

use super::fluid::always_fluid;
use super::{snapshots, transfer};
use crate::Error;
use crate::case::{FlowCase, RecordChoice};
use crate::directory::Workplace;
use crate::manifest::Manifest;
use crate::model::FlowModel;
use crate::progress::Progress;
use crate::record::Record;
use crate::run::Task;
use crate::run::decompose::{OnGrid, headline, on_fixed_grid, warnings};
use crate::summary::{Decomposition, Projection, Snapshots, Summary};
use lumley_fem::GridDivergence;

/// Tells what was recorded and what the way to the grid loses, and decomposes it where the case asks for that.
pub(super) fn decompose(
    (case, choice): (&FlowCase, &RecordChoice),
    model: &FlowModel,
    (task, place): (&Task, &Workplace),
    (summary, manifest): (&mut Summary, &mut Manifest),
    progress: &mut Progress,
) -> Result<(), Error> {
    let record = Record::open(place.path().join("record"))?;
    let (frame, grid) = (record.frame("fixed")?, &choice.grid);
    let max_norm = Some(snapshots::largest_norm(&frame, grid)?);
    summary.record = Snapshots { snapshots: record.len(), unknowns: 2 * grid.len(), max_norm };
    summary.transfer = Some(transfer::errors(model, choice)?);
    let Some(asked) = &case.pod else { return Ok(()) };
    progress.begin("pod", 1);
    let OnGrid { pod, res_percent, every } =
        on_fixed_grid(grid, asked, &record, place, task.threads)?;
    let fluid = always_fluid(case, model, grid, &record)?;
    let divergence = GridDivergence::new(grid, |node| fluid[node]);
    summary.pod = Decomposition {
        divergence: snapshots::divergences(&pod.basis, &divergence),
        snapshot_divergence: snapshots::divergence(&frame, &divergence)?,
        ..pod.summary()
    };
    (summary.projection, summary.pod_every) = (Projection { res_percent }, every);
    manifest.stage("pod", progress.end(&headline(&pod.basis, pod.chosen)));
    let warnings = warnings(&pod.basis, asked);
    progress.warn(&warnings);
    summary.warnings.extend(warnings);
    Ok(())
}
