use super::say;
use crate::Error;
use crate::progress::Progress;
use crate::verify::{Row, table};
use clap::Args;

#[derive(Args)]
pub(super) struct Arguments {
    /// Add what takes about ten minutes: time accuracy of the schemes, long runs, changed parameters, the vortex street 2D-2, bodies that a flow moves
    #[arg(long)]
    full: bool,
}

impl Arguments {
    pub(super) fn execute(&self, progress: &mut Progress) -> Result<(), Error> {
        let scratch = Scratch::new();
        say(&Row::heading())?;
        let all = table(&scratch.0, self.full, progress, |row| say(&row.line()))?;
        let failed = all.iter().filter(|row| !row.passes()).count();
        let rows = all.len();
        if failed > 0 {
            return Err(Error::Verification { failed, rows });
        }
        say(&format!("all {rows} reference numbers reproduced"))?;
        Ok(())
    }
}

/// A directory of this process alone, removed when done.
struct Scratch(std::path::PathBuf);

impl Scratch {
    fn new() -> Self {
        Self(std::env::temp_dir().join(format!("lumley-verify-{}", std::process::id())))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // What cannot be removed is the temporary directory's business.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
