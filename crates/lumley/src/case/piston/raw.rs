//! A piston's case file as it is written: keys and types, before anything is checked.

use crate::case::sections::{PodSection, TransferSection};
use lumley_fom::TimeScheme;
use lumley_rom::{Integrator, ModelChoice};
use serde::{Deserialize, Serialize};

/// The whole file. Without its `[quick]` table, which is an overlay and gone by now.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PistonFile {
    /// One line for people.
    #[serde(default)]
    pub title: String,
    /// The flow and the body.
    pub piston: PistonSection,
    /// Time integration of the full-order model.
    pub time: PistonTimeSection,
    /// Mesh of the full-order model.
    #[serde(default)]
    pub mesh: LineMeshSection,
    /// The fixed grid on which POD is done.
    #[serde(default)]
    pub grid: LineGridSection,
    /// When snapshots are taken.
    #[serde(default)]
    pub record: PistonRecordSection,
    /// How the moving mesh's field comes to the fixed grid.
    #[serde(default)]
    pub transfer: TransferSection,
    /// The decomposition.
    #[serde(default)]
    pub pod: PodSection,
    /// The reduced models.
    #[serde(default)]
    pub rom: RomSection,
    /// The overlay of `--quick`: read apart, accepted and ignored here.
    #[serde(default, skip_serializing)]
    pub quick: Option<toml::Table>,
}

/// `[piston]`: paper eqs. (33) and (34).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PistonSection {
    /// Kinematic viscosity nu, in m²/s.
    pub viscosity: f64,
    /// Position x0 at which the spring is slack, in m.
    pub spring_length: f64,
    /// Spring stiffness K, in N/m.
    pub stiffness: f64,
    /// Damping constant b, in N s/m.
    #[serde(default)]
    pub damping: f64,
    /// Mass m of the block, in kg.
    pub mass: f64,
    /// c_F, in kg/m: the load is -c_F nu u_x; 0 leaves the body alone.
    #[serde(default = "one")]
    pub force_factor: f64,
    /// X(0), in m.
    pub initial_position: f64,
    /// X'(0), in m/s.
    #[serde(default)]
    pub initial_velocity: f64,
    /// u(x, 0).
    #[serde(default)]
    pub initial_flow: InitialFlowSection,
    /// Length L of the fixed domain, in m.
    pub domain_length: f64,
}

/// `piston.initial_flow`: a word, or a table of one key.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum InitialFlowSection {
    /// At rest.
    #[default]
    Zero,
    /// X'(0) x / X(0).
    Linear,
    /// The linear flow and a sine of this amplitude, in m/s.
    Sine(f64),
    /// Rows of x in m and u in m/s in a CSV file, beside the case file.
    Table(String),
}

/// `[time]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PistonTimeSection {
    /// End of the run T, in s.
    pub end: f64,
    /// Time step, in s.
    pub step: f64,
    /// `implicit-euler` (the paper), `crank-nicolson` or `bdf2`.
    #[serde(default)]
    pub scheme: TimeScheme,
}

/// `[mesh]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct LineMeshSection {
    /// Cells of the fluid's mesh.
    pub cells: usize,
    /// Degree of the finite elements, 1 or 2.
    pub degree: usize,
}

impl Default for LineMeshSection {
    fn default() -> Self {
        Self { cells: 800, degree: 1 }
    }
}

/// `[grid]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct LineGridSection {
    /// Nodes of the uniform grid on (0, L), ends included.
    pub nodes: usize,
}

impl Default for LineGridSection {
    fn default() -> Self {
        Self { nodes: 401 }
    }
}

/// `[record]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PistonRecordSection {
    /// Time between snapshots, in s; a whole number of time steps.
    pub interval: f64,
}

impl Default for PistonRecordSection {
    fn default() -> Self {
        Self { interval: 0.01 }
    }
}

/// `[rom]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RomSection {
    /// Time step, in s; the record's interval is a whole number of them.
    pub step: f64,
    /// How the reduced equations are integrated.
    pub integrator: Integrator,
    /// The reduced models, one table each.
    pub models: Vec<ModelChoice>,
}

impl Default for RomSection {
    fn default() -> Self {
        Self { step: 2.5e-4, integrator: Integrator::default(), models: Vec::new() }
    }
}

fn one() -> f64 {
    1.0
}
