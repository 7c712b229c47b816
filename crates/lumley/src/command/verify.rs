use super::say;
use crate::Error;
use crate::case::Case;
use crate::cases;
use crate::directory::Existing;
use crate::progress::Progress;
use crate::run::{self, Task};
use crate::verify::{CASES, Row, rows};
use clap::Args;

#[derive(Args)]
pub(super) struct Arguments {
    /// Add what takes minutes: time accuracy of the schemes, long runs, changed parameters
    #[arg(long)]
    full: bool,
}

impl Arguments {
    pub(super) fn execute(&self, progress: &mut Progress) -> Result<(), Error> {
        let text = cases::find("piston").map_or("", |case| case.text);
        let mut all: Vec<Row> = Vec::new();
        say(&Row::heading());
        for (k, (name, settings)) in CASES.iter().enumerate() {
            let settings: Vec<String> = settings.iter().map(|&s| s.to_owned()).collect();
            let case = Case::parse("piston/case.toml".as_ref(), text, false, &settings)?;
            let scratch = Scratch::new(name);
            let task = Task::new(scratch.0.clone(), Existing { replace: true, resume: false });
            let (_, summary) = run::run(&case, &task, progress)?;
            let rows = rows(k, &summary);
            rows.iter().for_each(|row| say(&row.line()));
            all.extend(rows);
        }
        let failed = all.iter().filter(|row| !row.passes()).count();
        let rows = all.len();
        if failed > 0 {
            return Err(Error::Verification { failed, rows });
        }
        say(&format!("all {rows} reference numbers reproduced"));
        Ok(())
    }
}

/// A directory of this process alone, removed when done.
struct Scratch(std::path::PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let unique = format!("lumley-verify-{}-{name}", std::process::id());
        Self(std::env::temp_dir().join(unique))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // What cannot be removed is the temporary directory's business.
        let _ = std::fs::remove_dir_all(&self.0);
        let _ = std::fs::remove_dir_all(crate::directory::partial(&self.0));
    }
}
