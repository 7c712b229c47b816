//! A flow's case file as it is written: keys and types, before anything is checked.

use super::recording::{GridSection, MotionSection, OutputSection, RecordSection};
use crate::case::sections::{PodSection, TransferSection};
use crate::case::term::Term;
use lumley_body::RigidBody;
use lumley_fem::Point;
use lumley_fem::generate::{Body, Rectangle};
use lumley_fom::TimeScheme;
use lumley_fom::flow::{Linearisation, SteadyLimits, StepControl, ViscousForm};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The whole file. Without its `[quick]` table, which is an overlay and gone by now.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FlowFile {
    /// One line for people.
    #[serde(default)]
    pub title: String,
    /// The fluid, its boundaries, and what is measured.
    pub flow: FlowSection,
    /// The mesh.
    pub mesh: MeshSection,
    /// Rigid bodies that the flow moves, or that move in it as they are told to.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bodies: Vec<RigidBody>,
    /// How flow and mesh go with them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<MotionSection>,
    /// Time integration; either this or `[steady]`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<TimeSection>,
    /// The steady flow is sought.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steady: Option<SteadySection>,
    /// The fixed grid on which snapshots are recorded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grid: Option<GridSection>,
    /// When snapshots are taken; without it, none are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub record: Option<RecordSection>,
    /// What is written beside the record.
    #[serde(default)]
    pub output: OutputSection,
    /// How the mesh's field comes to the fixed grid.
    #[serde(default)]
    pub transfer: TransferSection,
    /// The decomposition; without it, none is made.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pod: Option<PodSection>,
    /// The overlay of `--quick`: read apart, accepted and ignored here.
    #[serde(default, skip_serializing)]
    pub quick: Option<toml::Table>,
}

/// `[flow]`: paper eqs. (11) and (12).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FlowSection {
    /// Density, in kg/m³.
    pub density: f64,
    /// Dynamic viscosity, in Pa s.
    pub viscosity: f64,
    /// `stress` (the paper's) or `laplacian`.
    #[serde(default)]
    pub viscous_form: ViscousForm,
    /// `tangent`, `extrapolation` (the paper's) or `newton`.
    #[serde(default)]
    pub linearisation: Linearisation,
    /// Force for each kg of fluid, in m/s²: numbers or formulas of x, y, t.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body_force: Option<[Term; 2]>,
    /// The flow at the start.
    #[serde(default)]
    pub initial: InitialSection,
    /// What holds on each boundary of the mesh, by its name.
    #[serde(default)]
    pub boundaries: BTreeMap<String, BoundarySection>,
    /// What coefficients are made dimensionless with; without it there are none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference: Option<ReferenceSection>,
    /// Two points between which the pressure difference is measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pressure_difference: Option<PressureDifferenceSection>,
    /// Points at which velocity and pressure are measured.
    #[serde(default)]
    pub probes: Vec<ProbeSection>,
}

/// `flow.initial`: a word, or a table of one key.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum InitialSection {
    /// At rest.
    #[default]
    Rest,
    /// The creeping flow with the same boundary conditions.
    Stokes,
    /// This velocity, in m/s: numbers or formulas of x and y.
    Velocity([Term; 2]),
    /// The end of the run in this directory, relative to the case file.
    Run(String),
}

/// `[flow.boundaries.NAME]`: a kind, and what that kind needs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BoundarySection {
    /// `velocity`, `no-slip`, `slip`, `traction-free` or `periodic`.
    pub kind: BoundaryKind,
    /// The velocity, in m/s: numbers or formulas of x, y, t.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity: Option<[Term; 2]>,
    /// The shape of the velocity along a straight boundary, zero at its ends; needs `peak`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<ProfileShape>,
    /// Largest velocity of the profile, in m/s; positive into the domain.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub peak: Option<f64>,
    /// A CSV file of t in s, u and v in m/s, beside the case file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub table: Option<String>,
    /// Time in which the velocity grows from zero, in s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ramp: Option<f64>,
    /// How it grows: `smooth` or `linear`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ramp_shape: Option<RampShape>,
    /// The other boundary of a periodic pair.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub with: Option<String>,
}

/// `flow.boundaries.NAME.kind`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BoundaryKind {
    /// The velocity is given.
    Velocity,
    /// The fluid sticks to it.
    NoSlip,
    /// Nothing flows through it, nothing sticks to it: a line of symmetry.
    Slip,
    /// Nothing pushes on it: an outlet.
    TractionFree,
    /// The flow goes on at another boundary.
    Periodic,
}

/// `flow.boundaries.NAME.profile`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ProfileShape {
    /// `4 s (1 − s)` along the boundary.
    Parabolic,
}

/// `flow.boundaries.NAME.ramp_shape`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RampShape {
    /// `(1 − cos(π t/T))/2`: starts and ends without a kink.
    #[default]
    Smooth,
    /// `t/T`.
    Linear,
}

/// `[flow.reference]`: coefficients are `2 F/(ρ U² L)`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReferenceSection {
    /// U, in m/s.
    pub velocity: f64,
    /// L, in m.
    pub length: f64,
    /// ρ, in kg/m³; by default that of the flow.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub density: Option<f64>,
}

/// `[flow.pressure_difference]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PressureDifferenceSection {
    /// The pressure at the first less that at the second, in m.
    pub points: [Point; 2],
}

/// `[[flow.probes]]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProbeSection {
    /// Its name in the results.
    pub name: String,
    /// Where it stands, in m.
    pub at: Point,
}

/// `[mesh]`: a file; or the keys of a channel with bodies; or a rectangle of rows and columns.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeshSection {
    /// A `.msh` file of gmsh, relative to the case file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// x of the left and right sides, in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x: Option<[f64; 2]>,
    /// y of bottom and top, in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y: Option<[f64; 2]>,
    /// Channel: largest size of a cell, in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size: Option<f64>,
    /// Channel: growth of the cells' size with the distance from the bodies, in m per m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub growth: Option<f64>,
    /// Channel: where the triangles are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub triangles: Option<Rectangle>,
    /// Channel: the bodies in it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bodies: Vec<Body>,
    /// Channel: most cells that may be made.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limit: Option<usize>,
    /// Rectangle: columns and rows of quadrilaterals.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cells: Option<[usize; 2]>,
    /// Rectangle: how much the cells are pressed towards the sides in x and y; 0 is even.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub clustering: Option<[f64; 2]>,
    /// Rectangle: each quadrilateral cut into two triangles.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cut: Option<bool>,
}

/// `[time]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TimeSection {
    /// End of the run T, in s.
    pub end: f64,
    /// Time step, in s; with `adaptive` the first.
    pub step: f64,
    /// `implicit-euler` (the paper's) or `bdf2`.
    #[serde(default)]
    pub scheme: TimeScheme,
    /// The step follows the error.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub adaptive: Option<StepControl>,
}

/// `[steady]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SteadySection {
    /// Largest change of the last iteration, relative to the largest velocity.
    pub tolerance: f64,
    /// Most iterations.
    pub iterations: usize,
}

impl Default for SteadySection {
    fn default() -> Self {
        let SteadyLimits { tolerance, iterations } = SteadyLimits::default();
        Self { tolerance, iterations }
    }
}
