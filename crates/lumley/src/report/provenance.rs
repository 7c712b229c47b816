//! Where the numbers of a report come from.

use super::html::{Section, Table};
use super::number::duration;
use super::{escape, literal};
use crate::manifest::Manifest;

/// Where the numbers come from.
///
/// ```
/// use lumley::report::Provenance;
///
/// let from = Provenance { command: "lumley run case.toml".into(), ..Provenance::default() };
/// assert!(from.stages.is_empty());
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Provenance {
    /// Version of lumley.
    pub version: String,
    /// What to type to get this report again.
    pub command: String,
    /// Processor, cores, system.
    pub machine: String,
    /// Name and duration in s of each stage.
    pub stages: Vec<(String, f64)>,
    /// The resolved case file, verbatim; empty where there is none.
    pub case_file: String,
}

impl Provenance {
    /// What the manifest of a run says, and its case file.
    pub fn of(manifest: &Manifest, case_file: String) -> Self {
        Self {
            version: manifest.version.clone(),
            command: manifest.command.clone(),
            machine: manifest.machine.to_string(),
            stages: manifest.stages.iter().map(|s| (s.name.clone(), s.seconds)).collect(),
            case_file,
        }
    }

    /// Time of all stages, in s.
    pub fn seconds(&self) -> f64 {
        self.stages.iter().map(|(_, seconds)| seconds).sum()
    }

    pub(super) fn section(&self) -> Section {
        let stages = self.stages.iter().map(|(name, s)| vec![literal(name), duration(*s)]);
        let total = ["all".to_string(), duration(self.seconds())];
        let section = Section::new("Provenance")
            .paragraph(&format!(
                "lumley {}, on {}.",
                literal(&self.version),
                literal(&self.machine)
            ))
            .raw(&format!("<p>To reproduce: <code>{}</code></p>", escape(&self.command)));
        let section = match self.stages.as_slice() {
            [] => section,
            _ => section.table(&Table::new(&["stage", "time"]).rows(stages).row(total)),
        };
        match self.case_file.as_str() {
            "" => section,
            text => section.details("The case, resolved", text),
        }
    }
}
