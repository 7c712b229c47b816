use super::{bytes, duration};
use crate::Error;
use crate::case::PistonCase;
use crate::command::say;
use crate::run::full_order;

/// Time of a full-order step for each unknown, in s: what the benchmark shows on one core.
const STEP_PER_UNKNOWN: f64 = 5e-8;

/// Says what the case would do.
pub(super) fn tell(case: &PistonCase) -> Result<(), Error> {
    full_order(case)?;
    let schedule = &case.schedule;
    let unknowns = case.cells * case.degree + 1;
    let (nodes, snapshots) = (case.grid.len(), schedule.snapshots());
    let record = (nodes + unknowns) * snapshots * size_of::<f64>();
    let models = case.models.len();
    let memory = 3 * record;
    say(&format!("case            {}: {}", case.name, case.file.title))?;
    say(&format!(
        "full-order      {unknowns} unknowns, {} steps of {} s",
        schedule.steps(),
        schedule.step
    ))?;
    say(&format!("record          {snapshots} snapshots of {nodes} and {unknowns} numbers"))?;
    say(&format!("pod             {}", case.pod.method))?;
    say(&format!(
        "reduced models  {models}, {} steps of {} s each, 1 to 10 modes",
        case.rom_schedule.steps(),
        case.rom_schedule.step
    ))?;
    let time = STEP_PER_UNKNOWN * unknowns as f64 * schedule.steps() as f64;
    say(&format!("time            about {} for the full-order model", duration(time)))?;
    say(&format!("disk            about {}", bytes((record * (models + 2) / 2) as f64)))?;
    say(&format!("memory          about {}", bytes(memory as f64)))?;
    Ok(())
}
