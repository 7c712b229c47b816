//! Cases of the piston, the paper's section 4.

mod check;
mod raw;

pub use raw::{
    InitialFlowSection, LineGridSection, LineMeshSection, PistonFile, PistonRecordSection,
    PistonSection, PistonTimeSection, RomSection,
};

pub(super) use check::check;

use super::{Case, CaseError, PodChoice, Schedule};
use lumley_fem::UniformGrid;
use lumley_fem::transfer::Transfer;
use lumley_fom::{PistonParameters, TimeScheme};
use lumley_rom::{Integrator, ModelChoice};
use std::path::Path;

/// A checked case of the piston, in SI units.
///
/// ```
/// use lumley::case::PistonCase;
/// let text = lumley::cases::find("piston").expect("a case of lumley's own").text;
/// let case = PistonCase::parse("piston/case.toml".as_ref(), text, false, &["piston.mass=0.6".into()])?;
/// assert_eq!(case.name, "piston");
/// assert_eq!(case.piston.joint.mass, 0.6);
/// assert_eq!(case.schedule.snapshots(), 201);
/// # Ok::<(), lumley::case::CaseError>(())
/// ```
#[derive(Debug, Clone)]
pub struct PistonCase {
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
    pub file: PistonFile,
}

impl PistonCase {
    /// Reads and checks the case file at `path`, as [`Case::load`] does.
    ///
    /// # Errors
    /// As [`Case::load`], and where it is not a piston's.
    pub fn load(path: &Path, quick: bool, settings: &[String]) -> Result<Self, CaseError> {
        Case::load(path, quick, settings)?.piston()
    }

    /// Checks the case file `text`, which stands at `path`, as [`Case::parse`] does.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn parse(
        path: &Path,
        text: &str,
        quick: bool,
        settings: &[String],
    ) -> Result<Self, CaseError> {
        Case::parse(path, text, quick, settings)?.piston()
    }

    /// The case as a file that gives it again, all defaults and overrides written out.
    ///
    /// # Panics
    /// Never: every checked case is a TOML document.
    pub fn to_toml(&self) -> String {
        toml::to_string(&self.file).expect("a checked case is plain TOML")
    }
}
