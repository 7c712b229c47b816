use super::Interrupt;
use crate::directory::Existing;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Where a run goes and with how many threads.
///
/// ```
/// use lumley::{directory::Existing, run::Task};
/// let task = Task::new("runs/piston".as_ref(), Existing::default());
/// assert!(task.threads >= 1);
/// ```
#[derive(Debug, Clone)]
pub struct Task {
    /// The run directory.
    pub target: PathBuf,
    /// What may be replaced or resumed.
    pub existing: Existing,
    /// Threads of a flow, of the decomposition and of the reduced models.
    pub threads: usize,
    /// Processes, this one among them, that share the work and this machine's memory.
    pub neighbours: usize,
    /// Least time between checkpoints of the full-order model, or between notes of how far a decomposition
    /// of snapshots alone is.
    pub checkpoint: Duration,
    /// What to type to get this again, for the manifest.
    pub command: String,
    /// Whether the person wants the full-order model to stop.
    pub interrupt: Interrupt,
}

impl Task {
    /// A run into `target` by this process alone, with all threads of this machine and a checkpoint every
    /// five seconds, that nobody interrupts.
    pub fn new(target: &Path, existing: Existing) -> Self {
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let command: Vec<String> = std::env::args().skip(1).map(quoted).collect();
        let command = format!("lumley {}", command.join(" "));
        let target = target.components().collect();
        let checkpoint = Duration::from_secs(5);
        let interrupt = Interrupt::default();
        Self { target, existing, threads, neighbours: 1, checkpoint, command, interrupt }
    }
}

/// An argument as a shell takes it.
fn quoted(argument: String) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./=,:+@%".contains(c);
    if !argument.is_empty() && argument.chars().all(plain) {
        return argument;
    }
    format!("'{}'", argument.replace('\'', "'\\''"))
}
