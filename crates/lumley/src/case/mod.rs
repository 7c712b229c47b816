//! Case files: TOML, strict, every error with the place and what to do.
//!
//! What was written ([`CaseFile`]) becomes what is meant ([`Case`]); only the second is computed with.

mod check;
mod document;
mod error;
mod raw;
mod schedule;
mod suggest;

pub use error::{CaseError, Place};
pub use raw::{
    CaseFile, FlowSection, GridSection, MeshSection, PistonSection, PodSection, RecordSection,
    RomSection, TimeSection, TransferMethod, TransferSection,
};
pub use schedule::Schedule;

use document::Document;
use lumley_fem::UniformGrid;
use lumley_fem::transfer::Transfer;
use lumley_fom::{PistonParameters, TimeScheme};
use lumley_pod::Truncation;
use lumley_rom::{Integrator, ModelChoice};
use std::path::{Path, PathBuf};

/// Largest case file that is read, in bytes.
const LARGEST_FILE: u64 = 1 << 20;

/// A checked case: everything `lumley run` needs, in SI units.
///
/// ```
/// use lumley::case::Case;
/// let text = lumley::cases::find("piston").expect("a case of lumley's own").text;
/// let case = Case::parse("piston/case.toml".as_ref(), text, false, &["piston.mass=0.6".into()])?;
/// assert_eq!(case.name, "piston");
/// assert_eq!(case.piston.joint.mass, 0.6);
/// assert_eq!(case.schedule.snapshots(), 201);
/// # Ok::<(), lumley::case::CaseError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Case {
    /// Name of the runs: the folder of a `case.toml`, the stem of any other file.
    pub name: String,
    /// The flow and the body.
    pub piston: PistonParameters,
    /// Time scheme of the full-order model.
    pub scheme: TimeScheme,
    /// Cells of the fluid's mesh.
    pub cells: usize,
    /// Degree of its finite elements.
    pub degree: usize,
    /// Steps and snapshots of the full-order model.
    pub schedule: Schedule,
    /// The fixed grid on (0, L).
    pub grid: UniformGrid,
    /// How the moving mesh's field comes to the grid.
    pub transfer: Transfer,
    /// The paper's way there, measured beside it.
    pub inverse_distance: Transfer,
    /// The decomposition.
    pub pod: PodChoice,
    /// Step of the reduced models, in s, and how many make an interval of the record.
    pub rom_schedule: Schedule,
    /// How the reduced equations are integrated.
    pub integrator: Integrator,
    /// The reduced models.
    pub models: Vec<ModelChoice>,
    /// The file, resolved: all defaults and overrides in it.
    pub file: CaseFile,
}

/// What the case asks of POD.
///
/// ```
/// use lumley::case::PodChoice;
/// use lumley_pod::Truncation;
/// let pod = PodChoice { method: "auto".into(), truncation: Truncation::Energy(0.9999), center: false };
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
        let file = document.case_file()?;
        check::check(&document, file, &name(path), &folder(path))
    }

    /// The case as a file that gives it again, all defaults and overrides written out.
    ///
    /// # Panics
    /// Never: every checked case is a TOML document.
    pub fn to_toml(&self) -> String {
        toml::to_string(&self.file).expect("a checked case is plain TOML")
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
