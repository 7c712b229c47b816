use super::Plan;
use super::outputs::FlowOutputs;
use crate::directory::Workplace;
use crate::error::{Error, Kept};
use crate::format::table::GrowingTable;
use crate::model::{FlowModel, Observer, StepError, Stop};
use crate::progress::Progress;
use crate::run::keeper::Outputs;
use crate::run::{Task, Work};
use lumley_fom::flow::SteadyLimits;
use std::time::Instant;

/// The table of the changes.
pub(super) const RESIDUALS: &str = "residuals.csv";
/// Its column of them.
pub(super) const CHANGE: &str = "change";

/// Finds the steady flow and writes it. A run that was stopped begins again.
pub(super) fn settle(
    plan: &Plan,
    model: &mut FlowModel,
    limits: SteadyLimits,
    (task, place): (&Task, &Workplace),
    progress: &mut Progress,
) -> Result<Work, Error> {
    progress.begin("full-order model", limits.iterations);
    let headers = ["iteration", CHANGE].map(str::to_owned);
    let mut residuals = GrowingTable::create(&place.path().join(RESIDUALS), &headers)?;
    let mut outputs = FlowOutputs::create(plan, model, place)?;
    let started = Instant::now();
    let mut written = Ok(());
    let settled = model.flow_mut().settle(limits, |n, change| {
        progress.advance(n, &format!("change {change:.1e}"));
        if written.is_ok() {
            written = residuals.row(&[n as f64, change]);
        }
    });
    let time = started.elapsed();
    written.and_then(|()| residuals.sync())?;
    let report = settled.map_err(|e| {
        let (path, command) = (place.path().to_owned(), task.command.clone());
        let kept = Kept { path, checkpoint: None, command };
        Error::Stopped { source: Box::new(Error::Step(StepError::from(e))), kept }
    })?;
    let work = Work {
        steps: report.changes.len(),
        iterations: report.work.iterations,
        renewals: report.work.renewals,
        time,
    };
    outputs.instruments.measure(model, 0.0)?;
    outputs.observe(model, Stop { number: 0, time: 0.0 }, &work)?;
    outputs.flush()?;
    Ok(work)
}
