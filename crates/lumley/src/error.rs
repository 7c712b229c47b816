use crate::case::CaseError;
use crate::directory::DirectoryError;
use crate::format::FormatError;
use crate::model::StepError;
use crate::ranks::RanksError;
use crate::record::RecordError;
use crate::run::INTERRUPTED;
use lumley_fem::Point;
use lumley_fom::PistonError;
use lumley_fom::flow::FlowError;
use lumley_pod::{Failure, PodError};
use lumley_rom::ReducedError;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Everything that can end a command, with what to do about it.
///
/// ```
/// use lumley::Error;
/// let error = Error::NothingToDo { what: "no reduced models in this case" };
/// assert_eq!(error.exit_code(), 2);
/// ```
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// Processes that were started together cannot work together.
    #[error(transparent)]
    Ranks(#[from] RanksError),
    /// Another of the processes that share the work has failed, and says why.
    #[error("{0}")]
    Elsewhere(Failure),
    /// The case file is wrong.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// The run directory cannot be used.
    #[error(transparent)]
    Directory(#[from] DirectoryError),
    /// A file is wrong.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// The record is wrong.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// A model failed.
    #[error(transparent)]
    Step(#[from] StepError),
    /// The person or the system wanted the run to stop.
    #[error("interrupted")]
    Interrupted,
    /// A flow is to start from the end of a run whose mesh does not cover it.
    #[error(transparent)]
    OtherDomain(#[from] OtherDomain),
    /// The system does not tell of Ctrl-C.
    #[error("cannot listen to Ctrl-C: {0}")]
    Signals(io::Error),
    /// A run that ended before its time, with what is kept of it.
    #[error("{source}\n  kept: {kept}")]
    Stopped {
        /// Why.
        source: Box<Error>,
        /// What there is.
        kept: Kept,
    },
    /// The decomposition failed.
    #[error("{}: {source}{}", path.display(), help(source))]
    Pod {
        /// The snapshots.
        path: PathBuf,
        /// What is wrong with them.
        source: PodError,
    },
    /// The full-order model does not accept the case.
    #[error(transparent)]
    Piston(#[from] PistonError),
    /// The flow does not accept the case.
    #[error(transparent)]
    Flow(FlowError),
    /// A reduced model cannot be built.
    #[error(transparent)]
    Reduced(#[from] ReducedError),
    /// The run that is to go on was begun with another case.
    #[error("{}: the unfinished run was begun with another case\n  help: begin again with --force, or give the case it was begun with", path.display())]
    OtherCase {
        /// The unfinished run.
        path: PathBuf,
    },
    /// The decomposition that is to go on was begun with other snapshots.
    #[error("{}: the unfinished decomposition was begun with other snapshots, weights or options: then {begun}; now {now}\n  help: begin again with --force, or give what it was begun with", path.display())]
    OtherSnapshots {
        /// The unfinished run.
        path: PathBuf,
        /// The first thing that differs, as it was.
        begun: String,
        /// As it is now.
        now: String,
    },
    /// The settings of `lumley rom` need another basis than the run has.
    #[error("{}: its modes cannot serve with another {key}\n  help: `lumley rom` changes piston (but for domain_length), time, record, rom and pod.modes; for the rest make a new run with `lumley run`", path.display())]
    OtherBasis {
        /// The run.
        path: PathBuf,
        /// What was changed.
        key: &'static str,
    },
    /// `lumley rom` was to replace the run that it reads.
    #[error("{}: a run cannot be replaced by its own reduced models\n  help: choose another directory with -o", path.display())]
    OntoItself {
        /// The run.
        path: PathBuf,
    },
    /// A directory that `lumley pod` made, where the run of a case is needed.
    #[error("{} holds the POD of snapshots and no case\n  help: `lumley pod` writes its report; `lumley report` and `lumley rom` take the directory of a `lumley run`", path.display())]
    NoCase {
        /// The directory.
        path: PathBuf,
    },
    /// The result cannot be printed.
    #[error("cannot print the result: {0}")]
    Print(#[from] io::Error),
    /// A file of a run directory is not what lumley wrote.
    #[error("{}: {message}\n  help: the file was changed or damaged; make the run again with `lumley run --force`", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        message: String,
    },
    /// Several processes were started for a command that is for one.
    #[error(
        "only `lumley pod` can share its work among processes\n  help: start this command without mpirun or srun"
    )]
    OneProcess,
    /// The command has nothing to work on.
    #[error("nothing to do: {what}")]
    NothingToDo {
        /// Why.
        what: &'static str,
    },
    /// An argument is wrong.
    #[error("{argument} {value}: expected {expected}")]
    Argument {
        /// The argument.
        argument: &'static str,
        /// What was given.
        value: String,
        /// What was expected.
        expected: String,
    },
    /// A reference number was not reproduced.
    #[error("{failed} of {rows} reference numbers are outside their tolerance")]
    Verification {
        /// Rows outside their tolerance.
        failed: usize,
        /// All rows.
        rows: usize,
    },
}

/// The run that a flow is to start from has no flow at one of its points.
///
/// ```
/// let error = lumley::OtherDomain { path: "runs/coarse".into(), point: [9.0, 0.0] };
/// assert!(error.to_string().starts_with("runs/coarse has no flow at (9, 0) m"));
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{} has no flow at ({}, {}) m, where the new mesh has a node\n  help: flow.initial names a run on the same domain, with the bodies where they are at the start of this one", path.display(), point[0], point[1])]
pub struct OtherDomain {
    /// The run.
    pub path: PathBuf,
    /// The point, in m.
    pub point: Point,
}

/// What is kept of a run that ended before its time.
///
/// ```
/// use lumley::Kept;
/// let (path, command) = ("runs/piston.partial".into(), "lumley run piston/case.toml".into());
/// let kept = Kept { path, checkpoint: Some(1.5), command };
/// assert!(kept.to_string().ends_with("case.toml --resume` goes on from t = 1.5 s"));
/// ```
#[derive(Debug, Clone)]
pub struct Kept {
    /// The unfinished run.
    pub path: PathBuf,
    /// Simulated time of its last checkpoint, in s.
    pub checkpoint: Option<f64>,
    /// The command that made it.
    pub command: String,
}

impl fmt::Display for Kept {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { path, checkpoint, command } = self;
        let resume = if command.contains(" --resume") { "" } else { " --resume" };
        write!(f, "everything up to here, in {}\n  help: `{command}{resume}` ", path.display())?;
        match checkpoint {
            Some(time) => write!(f, "goes on from t = {time} s"),
            None => write!(f, "begins again: there is no checkpoint yet"),
        }
    }
}

/// What the command can do about it.
fn help(error: &PodError) -> &'static str {
    match error {
        PodError::NonFinite { .. } => "\n  help: --skip-non-finite leaves such snapshots out",
        _ => "",
    }
}

impl From<Failure> for Error {
    fn from(failure: Failure) -> Self {
        Self::Elsewhere(failure)
    }
}

impl Error {
    /// Puts the file in front of what is wrong with its snapshots.
    pub(crate) fn pod<E: Into<PodError>>(path: &Path) -> impl Fn(E) -> Self + '_ {
        move |source| match source.into() {
            PodError::Elsewhere(failure) => Self::Elsewhere(failure),
            source => Self::Pod { path: path.to_owned(), source },
        }
    }

    /// Whether a run ended by itself or by the person's wish, so that all there is of it is on the disk.
    pub(crate) fn is_of_run(&self) -> bool {
        matches!(
            self,
            Self::Interrupted
                | Self::Step(_)
                | Self::Record(RecordError::NonFinite { .. })
                | Self::Format(FormatError::NotFinite { .. })
        )
    }

    /// Whether the machine was to blame, its disk or the memory that could be taken, and not what stood in
    /// the files.
    pub(crate) fn is_of_machine(&self) -> bool {
        match self {
            Self::Pod { source: PodError::Medium(error), .. } => {
                error.kind() != io::ErrorKind::InvalidData
            }
            Self::Pod { source: PodError::Memory { .. }, .. }
            | Self::Format(FormatError::Io { .. })
            | Self::Directory(DirectoryError::Io { .. }) => true,
            // It does not say; what may be gone on with must not be lost.
            Self::Elsewhere(failure) => !failure.of_computation,
            _ => false,
        }
    }

    /// 1 where the computation failed, 2 where the input is wrong or the system refuses, [`INTERRUPTED`]
    /// where the person wanted it.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Interrupted => INTERRUPTED,
            Self::Stopped { source, .. } => source.exit_code(),
            Self::Pod { source, .. } if source.is_of_computation() => 1,
            Self::Elsewhere(failure) if failure.of_computation => 1,
            Self::Flow(
                FlowError::Linear { .. }
                | FlowError::NoConvergence { .. }
                | FlowError::Diverged { .. }
                | FlowError::Unstable { .. },
            )
            | Self::Step(_)
            | Self::Verification { .. }
            | Self::Format(FormatError::NotFinite { .. })
            | Self::Record(RecordError::NonFinite { .. })
            | Self::Piston(PistonError::NonFinite { .. }) => 1,
            _ => 2,
        }
    }
}
