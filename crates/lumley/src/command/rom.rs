use super::{Output, say};
use crate::Error;
use crate::directory::{completed, default_target};
use crate::progress::Progress;
use crate::run::{self, Task};
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
pub(super) struct Arguments {
    /// A complete run
    #[arg(value_name = "DIR")]
    run: PathBuf,
    /// Change a key of its case, such as piston.stiffness=45 or time.end=10
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Run the full-order model with the same changes and compare
    #[arg(long)]
    compare: bool,
    /// Threads; by default all
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    #[command(flatten)]
    output: Output,
}

impl Arguments {
    pub(super) fn execute(&self, progress: &mut Progress) -> Result<(), Error> {
        let source = completed(&self.run)?;
        let name = source.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let named = self.output.directory.clone();
        let target = named.unwrap_or_else(|| default_target(&format!("{name}-rom"), false));
        let mut task = Task::new(&target, self.output.existing(false));
        task.threads = self.threads.map_or(task.threads, usize::from);
        let (directory, summary) = run::rerun(source, &self.set, self.compare, &task, progress)?;
        if self.output.json {
            say(&summary.to_json())?;
        } else {
            super::run::headline(&summary)?;
            say(&format!("{}", directory.join("report.html").display()))?;
        }
        Ok(())
    }
}
