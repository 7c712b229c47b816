//! Case files: TOML, strict, every error with the place and what to do.
//!
//! What was written ([`PistonFile`], [`FlowFile`]) becomes what is meant ([`PistonCase`], [`FlowCase`]); only
//! the second is computed with.

mod ask;
mod document;
mod error;
mod flow;
pub mod formula;
mod piston;
mod schedule;
mod sections;
mod suggest;
mod term;

pub use error::{CaseError, Place};
pub use flow::{
    BodiesChoice, BodyProbes, BodyProbesSection, BoundaryKind, BoundarySection, FlowCase, FlowFile,
    FlowSection, GridSection, InitialSection, InputFile, Instants, Kept, March, MeshSection,
    MotionSection, OutputSection, PressureDifferenceSection, Probe, ProbeSection, ProfileShape,
    RampShape, RecordChoice, RecordSection, Reference, ReferenceSection, Start, SteadySection,
    TimeChoice, TimeSection,
};
pub use piston::{
    InitialFlowSection, LineGridSection, LineMeshSection, PistonCase, PistonFile,
    PistonRecordSection, PistonSection, PistonTimeSection, RomSection,
};
pub use schedule::Schedule;
pub use sections::{PodSection, TransferMethod, TransferSection};
pub use term::Term;

use document::{Document, Kind};
use lumley_pod::Truncation;
use std::path::{Path, PathBuf};

/// Largest case file that is read, in bytes.
const LARGEST_FILE: u64 = 1 << 20;

/// A checked case: everything `lumley run` needs, in SI units.
///
/// ```
/// use lumley::case::Case;
/// let text = lumley::cases::find("piston").expect("a case of lumley's own").text;
/// let case = Case::parse("piston/case.toml".as_ref(), text, false, &["piston.mass=0.6".into()])?;
/// assert_eq!(case.name(), "piston");
/// assert_eq!(case.piston()?.piston.joint.mass, 0.6);
/// # Ok::<(), lumley::case::CaseError>(())
/// ```
#[derive(Debug, Clone)]
pub enum Case {
    /// The section `[piston]`: the paper's section 4, in one dimension.
    Piston(Box<PistonCase>),
    /// The section `[flow]`: in the plane.
    Flow(Box<FlowCase>),
}

/// What the case asks of POD.
///
/// ```
/// use lumley::case::PodChoice;
/// use lumley_pod::Truncation;
/// let truncation = Truncation::Energy(0.9999);
/// let pod = PodChoice { method: "auto".into(), truncation, center: false, every: Some(5) };
/// assert_eq!(pod.method, "auto");
/// ```
#[derive(Debug, Clone)]
pub struct PodChoice {
    /// Name of the algorithm, or `auto`.
    pub method: String,
    /// How many modes are kept.
    pub truncation: Truncation,
    /// Whether the mean is subtracted.
    pub center: bool,
    /// Whether a second POD is made, of every so many snapshots alone.
    pub every: Option<usize>,
}

impl Case {
    /// Reads and checks the case file at `path`.
    ///
    /// `quick` lays the file's `[quick]` table over it, then come `settings`, each `key=value`.
    ///
    /// # Errors
    /// [`CaseError`]: the file cannot be read, is not TOML, has a key that does not exist or a value that
    /// cannot be computed with.
    pub fn load(path: &Path, quick: bool, settings: &[String]) -> Result<Self, CaseError> {
        let unreadable = |source| CaseError::Read { path: path.to_owned(), source };
        let about = std::fs::metadata(path).map_err(unreadable)?;
        if !about.is_file() || about.len() > LARGEST_FILE {
            return Err(CaseError::NotAFile { path: path.to_owned() });
        }
        let text = std::fs::read_to_string(path).map_err(unreadable)?;
        Self::parse(path, &text, quick, settings)
    }

    /// Checks the case file `text`, which stands at `path`: names and files in it are relative to that.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn parse(
        path: &Path,
        text: &str,
        quick: bool,
        settings: &[String],
    ) -> Result<Self, CaseError> {
        let document = Document::new(path, text.to_owned(), quick, settings)?;
        let (name, folder) = (name(path), folder(path));
        Ok(match document.kind()? {
            Kind::Piston => {
                let case = piston::check(&document, document.case_file()?, &name, &folder)?;
                Self::Piston(Box::new(case))
            }
            Kind::Flow => {
                let case = flow::check(&document, document.case_file()?, &name, &folder)?;
                Self::Flow(Box::new(case))
            }
        })
    }

    /// Name of the runs: the folder of a `case.toml`, the stem of any other file.
    pub fn name(&self) -> &str {
        match self {
            Self::Piston(case) => &case.name,
            Self::Flow(case) => &case.name,
        }
    }

    /// The piston's case.
    ///
    /// # Errors
    /// [`CaseError::OtherKind`]
    pub fn piston(self) -> Result<PistonCase, CaseError> {
        match self {
            Self::Piston(case) => Ok(*case),
            Self::Flow(case) => {
                Err(CaseError::OtherKind { name: case.name, found: "flow", needed: "piston" })
            }
        }
    }
}

fn name(path: &Path) -> String {
    let stem = path.file_stem().map_or("run".into(), |s| s.to_string_lossy().into_owned());
    // `case.toml` in the working directory has that directory's name.
    let whole = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let folder = whole.parent().and_then(Path::file_name);
    match folder {
        Some(folder) if stem == "case" => folder.to_string_lossy().into_owned(),
        _ => stem,
    }
}

fn folder(path: &Path) -> PathBuf {
    path.parent().map_or_else(PathBuf::new, Path::to_owned)
}
