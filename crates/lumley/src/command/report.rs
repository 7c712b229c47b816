use super::say;
use crate::Error;
use crate::directory::completed;
use crate::progress::Progress;
use crate::run;
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
pub(super) struct Arguments {
    /// The run directory
    #[arg(value_name = "DIR")]
    run: PathBuf,
}

impl Arguments {
    pub(super) fn execute(&self, progress: &mut Progress) -> Result<(), Error> {
        let folder = completed(&self.run)?;
        progress.begin("report", 1);
        run::write_report(folder)?;
        progress.end("report.html");
        say(&format!("{}", folder.join("report.html").display()))?;
        Ok(())
    }
}
