//! `manifest.json`: what made a run directory, on what, and how long it took.

use serde::{Deserialize, Serialize};
use std::fmt;

/// Name of the file in a run directory; its presence is what makes a directory a run.
pub const MANIFEST: &str = "manifest.json";

/// Provenance of a run.
///
/// ```
/// use lumley::manifest::Manifest;
/// let manifest = Manifest::new("piston", b"[piston]");
/// assert_eq!(manifest.program, "lumley");
/// assert_eq!(manifest.inputs[0].crc32c.len(), 8);
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Always `lumley`.
    pub program: String,
    /// Its version.
    pub version: String,
    /// Name of the case.
    pub case: String,
    /// The inputs and their checksums.
    pub inputs: Vec<Input>,
    /// The machine.
    pub machine: Machine,
    /// The stages and their wall-clock times, in order.
    pub stages: Vec<Stage>,
    /// Whether the run is complete.
    pub complete: bool,
}

/// One input of a run.
///
/// ```
/// let input = lumley::manifest::Input::new("case.toml", b"");
/// assert_eq!(input.crc32c, "00000000");
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Input {
    /// Its name.
    pub name: String,
    /// Its length in bytes.
    pub bytes: u64,
    /// CRC-32C of its bytes, in hexadecimal.
    pub crc32c: String,
}

impl Input {
    /// The input called `name` with this content.
    pub fn new(name: &str, content: &[u8]) -> Self {
        let crc32c = format!("{:08x}", crc32c::crc32c(content));
        Self { name: name.to_owned(), bytes: content.len() as u64, crc32c }
    }
}

/// The machine that a run was made on.
///
/// ```
/// assert!(lumley::manifest::Machine::this().threads >= 1);
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Machine {
    /// Operating system and architecture.
    pub system: String,
    /// Processor, where the system tells.
    pub processor: String,
    /// Hardware threads.
    pub threads: usize,
}

impl Machine {
    /// This machine.
    pub fn this() -> Self {
        let cpuinfo = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        let model = cpuinfo.lines().find_map(|line| line.strip_prefix("model name"));
        Self {
            system: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
            processor: model
                .and_then(|m| m.split_once(':'))
                .map_or_else(|| "unknown".to_owned(), |(_, name)| name.trim().to_owned()),
            threads: std::thread::available_parallelism().map_or(1, usize::from),
        }
    }
}

impl fmt::Display for Machine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {} threads, {}", self.processor, self.threads, self.system)
    }
}

/// One stage of a run.
///
/// ```
/// let stage = lumley::manifest::Stage { name: "pod".into(), seconds: 0.1 };
/// assert_eq!(stage.name, "pod");
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Stage {
    /// Its name.
    pub name: String,
    /// Its wall-clock time, in s.
    pub seconds: f64,
}

impl Manifest {
    /// The manifest of a run that begins, of the case `case` with this resolved file.
    pub fn new(case: &str, resolved: &[u8]) -> Self {
        Self {
            program: "lumley".into(),
            version: env!("CARGO_PKG_VERSION").into(),
            case: case.to_owned(),
            inputs: vec![Input::new("case.toml", resolved)],
            machine: Machine::this(),
            stages: Vec::new(),
            complete: false,
        }
    }

    /// Notes that the stage `name` took `seconds`.
    pub fn stage(&mut self, name: &str, seconds: f64) {
        self.stages.push(Stage { name: name.to_owned(), seconds });
    }

    /// The manifest as JSON, indented.
    ///
    /// # Panics
    /// Never: it is plain data.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a manifest is plain data")
    }
}
