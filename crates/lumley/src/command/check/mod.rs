mod bodies;
mod flow;
mod piston;

use super::CaseArguments;
use crate::Error;
use crate::case::Case;
use clap::Args;

#[derive(Args)]
pub(super) struct Arguments {
    #[command(flatten)]
    case: CaseArguments,
}

impl Arguments {
    pub(super) fn execute(&self) -> Result<(), Error> {
        match self.case.load()? {
            Case::Piston(case) => piston::tell(&case),
            Case::Flow(case) => flow::tell(&case),
        }
    }
}

fn bytes(count: f64) -> String {
    match count {
        c if c >= 1e9 => format!("{:.1} GB", c / 1e9),
        c if c >= 1e6 => format!("{:.1} MB", c / 1e6),
        c => format!("{:.0} kB", c / 1e3),
    }
}

/// A time in ms, s, min or h.
fn duration(seconds: f64) -> String {
    match seconds {
        s if s >= 7200.0 => format!("{:.1} h", s / 3600.0),
        s if s >= 120.0 => format!("{:.0} min", s / 60.0),
        s if s < 1.0 => format!("{:.0} ms", 1e3 * s),
        s => format!("{s:.1} s"),
    }
}
