//! Cases of a flow in the plane, on a mesh that may move.

mod bodies;
mod boundaries;
mod check;
mod explain;
mod fields;
mod kept;
mod mesh;
mod periodic;
mod raw;
mod recording;
mod time;

pub use bodies::{BodiesChoice, BodyProbes};
pub use kept::{InputFile, Kept};
pub use raw::{
    BoundaryKind, BoundarySection, FlowFile, FlowSection, InitialSection, MeshSection,
    PressureDifferenceSection, ProbeSection, ProfileShape, RampShape, ReferenceSection,
    SteadySection, TimeSection,
};
pub use recording::{BodyProbesSection, GridSection, MotionSection, OutputSection, RecordSection};
pub use time::{Instants, TimeChoice};

pub(super) use check::check;

use super::PodChoice;
use lumley_fem::transfer::Transfer;
use lumley_fem::{PlanarMesh, Point, UniformGrid};
use lumley_fom::flow::{Condition, FlowParameters, Load, SteadyLimits, VectorField};
use std::fmt;
use std::path::PathBuf;
use std::sync::Arc;

/// A checked case of a flow: everything `lumley run` needs, in SI units.
///
/// ```
/// use lumley::case::{Case, March};
/// let text = lumley::cases::find("cylinder-2d2").expect("a case of lumley's own").text;
/// let Case::Flow(case) = Case::parse("cylinder-2d2/case.toml".as_ref(), text, true, &[])? else {
///     panic!("it has a [flow]");
/// };
/// assert_eq!(case.parameters.density, 1.0);
/// assert_eq!(case.conditions.len(), case.mesh.topology().boundaries().len());
/// assert!(matches!(case.march, March::Unsteady(_)));
/// # Ok::<(), lumley::case::CaseError>(())
/// ```
#[derive(Clone)]
pub struct FlowCase {
    /// Name of the runs: the folder of a `case.toml`, the stem of any other file.
    pub name: String,
    /// The fluid and how it is stepped.
    pub parameters: FlowParameters,
    /// The mesh, checked, where it is when nothing has moved.
    pub mesh: PlanarMesh,
    /// One condition for every boundary, in the order of the mesh's boundaries.
    pub conditions: Vec<(String, Condition)>,
    /// The flow at the start.
    pub start: Start,
    /// The rigid bodies, and what goes with them.
    pub bodies: Option<BodiesChoice>,
    /// Through time, or to the steady flow.
    pub march: March,
    /// What coefficients are made with; without it they are null.
    pub reference: Option<Reference>,
    /// The points of the pressure difference, in m: first less second.
    pub pressure_difference: Option<[Point; 2]>,
    /// Where velocity and pressure are measured.
    pub probes: Vec<Probe>,
    /// Snapshots on the fixed grid.
    pub record: Option<RecordChoice>,
    /// When files for ParaView are written; without it, at the end alone.
    pub paraview: Option<Instants>,
    /// Steps between rows of loads and probes.
    pub loads_every: usize,
    /// The decomposition of the record.
    pub pod: Option<PodChoice>,
    /// What the files that the case names are relative to; [`kept`](Self::kept) lists them.
    pub folder: PathBuf,
    /// The file, resolved: all defaults and overrides in it.
    pub file: FlowFile,
}

/// The flow at the start of a run.
///
/// ```
/// use lumley::case::Start;
/// assert!(matches!(Start::default(), Start::Rest));
/// ```
#[derive(Clone, Default)]
pub enum Start {
    /// At rest.
    #[default]
    Rest,
    /// The creeping flow with the same boundary conditions.
    Stokes,
    /// This velocity, in m/s, at t = 0.
    Velocity(Arc<dyn VectorField>),
    /// The end of the run in this directory.
    Run(PathBuf),
}

/// How a case goes on from its start.
///
/// ```
/// use lumley::case::March;
/// let march = March::Steady(lumley_fom::flow::SteadyLimits::default());
/// assert!(march.unsteady().is_none());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum March {
    /// To the steady flow.
    Steady(SteadyLimits),
    /// Step by step through time.
    Unsteady(TimeChoice),
}

impl March {
    /// The steps through time, if it is not a steady case.
    pub fn unsteady(&self) -> Option<&TimeChoice> {
        match self {
            Self::Unsteady(time) => Some(time),
            Self::Steady(_) => None,
        }
    }
}

/// What force coefficients `2 F/(ρ U² L)` are made with.
///
/// ```
/// let reference = lumley::case::Reference { velocity: 0.2, length: 0.1, density: 1.0 };
/// let [drag, _] = reference.coefficients([1e-3, 0.0]);
/// assert!((drag - 0.5).abs() < 1e-15);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reference {
    /// U, in m/s.
    pub velocity: f64,
    /// L, in m.
    pub length: f64,
    /// ρ, in kg/m³.
    pub density: f64,
}

impl Reference {
    /// The coefficients of a force, in N for each m of span.
    pub fn coefficients(&self, force: Point) -> Point {
        let load = Load { force, moment: 0.0 };
        load.coefficients(self.density, self.velocity, self.length)
    }
}

/// A point at which velocity and pressure are measured.
///
/// ```
/// let probe = lumley::case::Probe { name: "wake".into(), at: [0.4, 0.2] };
/// assert_eq!(probe.at[0], 0.4);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Probe {
    /// Its name in the results.
    pub name: String,
    /// Where it stands, in m.
    pub at: Point,
}

/// Snapshots of the velocity on a fixed grid.
///
/// ```
/// use lumley::case::{Instants, RecordChoice};
/// use lumley_fem::{UniformGrid, transfer::Transfer};
/// let grid = UniformGrid::rectangle([0.0, 0.0], [2.2, 0.41], [441, 83]);
/// let when = Instants { start: 4.0, interval: 0.05, count: 81 };
/// let inverse_distance = Transfer::InverseDistance { power: 2.0, neighbours: 4 };
/// let transfer = Transfer::FiniteElement {};
/// let record = RecordChoice { grid, transfer, inverse_distance, when };
/// assert_eq!(record.when.time(80), 8.0);
/// ```
#[derive(Debug, Clone)]
pub struct RecordChoice {
    /// The grid.
    pub grid: UniformGrid,
    /// How the mesh's field comes to it.
    pub transfer: Transfer,
    /// The paper's way there, which is measured beside finite-element evaluation.
    pub inverse_distance: Transfer,
    /// When.
    pub when: Instants,
}

impl fmt::Debug for FlowCase {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FlowCase").field("name", &self.name).finish_non_exhaustive()
    }
}
