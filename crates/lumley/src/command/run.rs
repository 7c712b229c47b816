use super::{CaseArguments, Output, say};
use crate::Error;
use crate::directory::default_target;
use crate::progress::Progress;
use crate::run::{self, Task};
use crate::summary::Summary;
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
        let case = self.case.load()?.piston()?;
        let named = self.output.directory.clone();
        let target = named.unwrap_or_else(|| default_target(&case.name, self.resume));
        let mut task = Task::new(&target, self.output.existing(self.resume));
        task.threads = self.threads.map_or(task.threads, usize::from);
        task.checkpoint = Duration::from_secs(self.checkpoint);
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
    Ok(())
}
