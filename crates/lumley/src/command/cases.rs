use super::say;
use crate::Error;
use crate::cases::{CASES, find};
use clap::Args;

#[derive(Args)]
pub(super) struct Arguments {
    /// The case to print, so that `lumley cases piston > case.toml` gives a start
    name: Option<String>,
}

impl Arguments {
    pub(super) fn execute(&self) -> Result<(), Error> {
        let Some(name) = &self.name else {
            let width = CASES.iter().map(|case| case.name.len()).max().unwrap_or_default();
            for case in CASES {
                say(&format!("{:<width$}  {}", case.name, case.about))?;
            }
            return Ok(());
        };
        let case = find(name).ok_or_else(|| Error::Argument {
            argument: "cases",
            value: name.clone(),
            expected: CASES.iter().map(|case| case.name).collect::<Vec<_>>().join(", "),
        })?;
        say(case.text.trim_end())?;
        Ok(())
    }
}
