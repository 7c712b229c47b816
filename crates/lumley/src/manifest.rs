//! `manifest.json`: what made a run directory, on what, and how long it took.

use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::fmt;
use std::fs::{self, File};
use std::io::{self, Read as _, Seek as _};
use std::path::{Path, PathBuf};

/// Name of the file in a run directory; that it says `lumley` is what makes a directory a run.
pub const MANIFEST: &str = "manifest.json";
const PROGRAM: &str = "lumley";

/// Why there is no manifest to be had from a directory.
///
/// ```
/// use lumley::manifest::{Manifest, ManifestError};
/// let error = Manifest::read("no/such/run".as_ref()).unwrap_err();
/// assert!(matches!(error, ManifestError::Missing { .. }));
/// ```
#[derive(Debug, thiserror::Error)]
pub enum ManifestError {
    /// There is no such file.
    #[error("{} is missing\n  help: give the directory that `lumley run` or `lumley pod` printed", path.display())]
    Missing {
        /// The manifest.
        path: PathBuf,
    },
    /// The system refused.
    #[error("cannot read {}: {source}\n  help: check the path and its permissions", path.display())]
    Read {
        /// The manifest.
        path: PathBuf,
        /// The system's answer.
        source: io::Error,
    },
    /// Not a manifest of any program.
    #[error("{} is not JSON: {source}\n  help: give the directory that `lumley run` or `lumley pod` printed", path.display())]
    NotJson {
        /// The file.
        path: PathBuf,
        /// Where it is wrong.
        source: serde_json::Error,
    },
    /// The manifest of something else.
    #[error("{} was not written by lumley\n  help: give the directory that `lumley run` or `lumley pod` printed", path.display())]
    OtherProgram {
        /// The file.
        path: PathBuf,
    },
    /// Written by lumley, and changed, or of another version.
    #[error("{}: {source}\n  help: it was changed or comes from another version of lumley; make the run again", path.display())]
    Damaged {
        /// The manifest.
        path: PathBuf,
        /// What is wrong.
        source: serde_json::Error,
    },
}

/// Provenance of a run.
///
/// ```
/// use lumley::manifest::Manifest;
/// let manifest = Manifest::new("piston", "lumley run piston/case.toml");
/// assert_eq!(manifest.program, "lumley");
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Always `lumley`.
    pub program: String,
    /// Its version.
    pub version: String,
    /// Name of the case.
    pub case: String,
    /// What to type to get it again.
    pub command: String,
    /// The inputs and their checksums.
    pub inputs: Vec<Input>,
    /// What a command that goes on with an unfinished run must agree with, beside the inputs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub settings: Vec<String>,
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
    /// CRC-32C of its bytes, in hexadecimal; of a file over 64 MiB that of its first and last MiB, which
    /// it says, so that provenance costs no pass over the data.
    pub crc32c: String,
}

impl Input {
    /// The file at `path`.
    ///
    /// # Errors
    /// The failure of the medium.
    pub fn of_file(path: &Path) -> io::Result<Self> {
        const LONG: u64 = 64 << 20;
        let mut file = File::open(path)?;
        let bytes = file.metadata()?.len();
        let mut crc = 0;
        if bytes > LONG {
            let mut end = vec![0; 1 << 20];
            for place in [io::SeekFrom::Start(0), io::SeekFrom::End(-(1 << 20))] {
                file.seek(place)?;
                file.read_exact(&mut end)?;
                crc = crc32c::crc32c_append(crc, &end);
            }
        } else {
            let mut content = Vec::new();
            file.read_to_end(&mut content)?;
            crc = crc32c::crc32c(&content);
        }
        let name = path.display().to_string();
        let of = if bytes > LONG { " of the first and last MiB" } else { "" };
        Ok(Self { name, bytes, crc32c: format!("{crc:08x}{of}") })
    }

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
    /// The manifest of a run of `case` that begins with this command.
    pub fn new(case: &str, command: &str) -> Self {
        Self {
            program: PROGRAM.into(),
            version: env!("CARGO_PKG_VERSION").into(),
            case: case.to_owned(),
            command: command.to_owned(),
            inputs: Vec::new(),
            settings: Vec::new(),
            machine: Machine::this(),
            stages: Vec::new(),
            complete: false,
        }
    }

    /// The manifest of the run in `folder`.
    ///
    /// # Errors
    /// [`ManifestError`] when there is none, or not one of lumley.
    pub fn read(folder: &Path) -> Result<Self, ManifestError> {
        let path = folder.join(MANIFEST);
        if !path.is_file() {
            return Err(ManifestError::Missing { path });
        }
        let bytes = match fs::read(&path) {
            Ok(bytes) => bytes,
            Err(source) => return Err(ManifestError::Read { path, source }),
        };
        match serde_json::from_slice::<Value>(&bytes) {
            Err(source) => Err(ManifestError::NotJson { path, source }),
            Ok(value) if value["program"] != PROGRAM => Err(ManifestError::OtherProgram { path }),
            Ok(value) => serde_json::from_value(value)
                .map_err(|source| ManifestError::Damaged { path, source }),
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

/// Most memory that this process ever had, in bytes, where the system tells.
pub(crate) fn memory_peak() -> Option<f64> {
    kilobytes("/proc/self/status", "VmHWM:").map(|kb| kb * 1024.0)
}

/// A number that the system gives in kB.
fn kilobytes(path: &str, key: &str) -> Option<f64> {
    let text = fs::read_to_string(path).ok()?;
    let number = text.lines().find_map(|line| line.strip_prefix(key))?;
    number.trim().trim_end_matches("kB").trim().parse().ok()
}

/// Memory of this machine in bytes, as far as the system tells; else 16 GB.
pub(crate) fn memory() -> f64 {
    kilobytes("/proc/meminfo", "MemTotal:").map_or(16e9, |kb| kb * 1024.0)
}
