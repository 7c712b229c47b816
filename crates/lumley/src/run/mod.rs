//! Running a case: one loop for every model, and the stages from the full-order model to the report.
//!
//! What every run has in common stands here; what is a piston's in `piston/`, what is a flow's in `flow/`,
//! the decomposition of snapshots alone in `pod/`.

mod advance;
mod basis;
mod checkpoint;
mod decompose;
mod flow;
mod interrupt;
mod keeper;
mod modes;
mod parallel;
mod piston;
mod pod;
mod recorder;
mod report;
mod scratch;
mod stages;
mod task;

pub use advance::{Stops, Work, advance};
pub use basis::BasisFile;
pub use decompose::grid_product;
pub(crate) use flow::coupling;
pub use flow::planar_flow;
pub use interrupt::{Held, INTERRUPTED, Interrupt};
pub use modes::FileModes;
pub use piston::{full_order, rerun};
pub use pod::{PodInput, decompose_snapshots};
pub use recorder::{Gauge, Plan, Recorder};
pub use report::write as write_report;
pub use stages::read_summary;
pub use task::Task;

use crate::Error;
use crate::case::Case;
use crate::progress::Progress;
use crate::summary::Summary;
use std::path::PathBuf;

/// Does every stage of `case`. Returns where the run is, and its summary.
///
/// # Errors
/// Whatever ends it; what was done so far stays in `TARGET.partial`.
pub fn run(case: &Case, task: &Task, progress: &mut Progress) -> Result<(PathBuf, Summary), Error> {
    match case {
        Case::Piston(case) => piston::run(case, task, progress),
        Case::Flow(case) => flow::run(case, task, progress),
    }
}
