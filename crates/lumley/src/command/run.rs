use super::{CaseArguments, Output, say};
use crate::Error;
use crate::directory::default_target;
use crate::progress::Progress;
use crate::run::{self, Interrupt, Task};
use crate::summary::{LoadStatistics, Summary};
use clap::Args;
use std::time::Duration;

#[derive(Args)]
pub(super) struct Arguments {
    #[command(flatten)]
    case: CaseArguments,
    /// Continue an unfinished run
    #[arg(long)]
    resume: bool,
    /// Threads; by default all
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// Least time between checkpoints, in s
    #[arg(long, value_name = "SECONDS", default_value_t = 5)]
    checkpoint: u64,
    #[command(flatten)]
    output: Output,
}

impl Arguments {
    pub(super) fn execute(&self, progress: &mut Progress) -> Result<(), Error> {
        let case = self.case.load()?;
        let named = self.output.directory.clone();
        let target = named.unwrap_or_else(|| default_target(case.name(), self.resume));
        let mut task = Task::new(&target, self.output.existing(self.resume));
        task.threads = self.threads.map_or(task.threads, usize::from);
        task.checkpoint = Duration::from_secs(self.checkpoint);
        task.interrupt = Interrupt::listen().map_err(Error::Signals)?;
        let (directory, summary) = run::run(&case, &task, progress)?;
        if self.output.json {
            say(&summary.to_json())?;
        } else {
            headline(&summary)?;
            say(&format!("{}", directory.join("report.html").display()))?;
        }
        Ok(())
    }
}

/// What a person wants to know first.
pub(super) fn headline(summary: &Summary) -> Result<(), Error> {
    for model in &summary.rom {
        let modes = model.shown.unwrap_or_default();
        let what = match (model.shown_res(), model.shown_step_us()) {
            (Some(res), Some(us)) => format!("Res = {res:.3} %, {us:.2} µs a step"),
            (None, Some(us)) => format!("{us:.2} µs a step"),
            _ => "blew up".to_owned(),
        };
        let speedup = model.speedup.map_or(String::new(), |s| {
            format!(", {:.1} times as fast as a full model no less accurate", s.ratio)
        });
        say(&format!("{:<28} {modes} modes: {what}{speedup}", model.label))?;
    }
    let bodies = summary.loads.values().any(|load| load.is_body);
    for (name, load) in summary.loads.iter().filter(|(_, load)| load.is_body || !bodies) {
        say(&format!("{name:<28} {}", words(load)))?;
    }
    summary
        .pressure_difference
        .map_or(Ok(()), |p| say(&format!("{:<28} {p:.6} Pa", "pressure difference")))
}

/// The load on a boundary: coefficients where there are such, else forces.
fn words(load: &LoadStatistics) -> String {
    let [fx, fy] = load.force_mean;
    let coefficients = [
        ("Cd max", load.drag_coefficient_max),
        ("mean", load.drag_coefficient_mean),
        ("Cl max", load.lift_coefficient_max),
        ("rms", load.lift_coefficient_rms),
        ("St", load.strouhal),
    ];
    let known = coefficients.iter().filter_map(|(what, c)| Some(format!("{what} {:.5}", (*c)?)));
    let known: Vec<String> = known.collect();
    if known.is_empty() { format!("mean force ({fx:.4e}, {fy:.4e}) N/m") } else { known.join(", ") }
}
