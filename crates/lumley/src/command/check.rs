use super::{CaseArguments, say};
use crate::Error;
use crate::run::full_order;
use clap::Args;

/// Time of a full-order step for each unknown, in s: what the benchmark shows on one core.
const STEP_PER_UNKNOWN: f64 = 5e-8;

#[derive(Args)]
pub(super) struct Arguments {
    #[command(flatten)]
    case: CaseArguments,
}

impl Arguments {
    pub(super) fn execute(&self) -> Result<(), Error> {
        let case = self.case.load()?;
        full_order(&case)?;
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
        say(&format!("time            about {time:.1} s for the full-order model"))?;
        say(&format!("disk            about {}", bytes(record * (models + 2) / 2)))?;
        say(&format!("memory          about {}", bytes(memory)))?;
        Ok(())
    }
}

fn bytes(count: usize) -> String {
    let count = count as f64;
    match count {
        c if c >= 1e9 => format!("{:.1} GB", c / 1e9),
        c if c >= 1e6 => format!("{:.1} MB", c / 1e6),
        c => format!("{:.0} kB", c / 1e3),
    }
}
