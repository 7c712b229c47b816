//! What the report of a flow is made from.

use crate::report::{DrawnModes, Film};
use lumley_fem::{PlanarMesh, Point, UniformGrid};
use serde::Deserialize;

/// The fluid, what holds on its boundaries, and how it was computed; texts as a user wrote them.
///
/// ```
/// use lumley::report::{FlowReference, FlowSettings};
///
/// let settings = FlowSettings {
///     density: 1.0,
///     viscosity: 1e-3,
///     reference: Some(FlowReference { velocity: 1.0, length: 0.1, density: 1.0 }),
///     ..FlowSettings::default()
/// };
/// assert!((settings.reynolds().unwrap() - 100.0).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FlowSettings {
    /// One line about the case.
    pub title: String,
    /// ρ, in kg/m³.
    pub density: f64,
    /// μ, in Pa s.
    pub viscosity: f64,
    /// What makes coefficients.
    pub reference: Option<FlowReference>,
    /// Name of each boundary and what holds on it.
    pub boundaries: Vec<(String, String)>,
    /// Other choices: what is chosen, and what.
    pub choices: Vec<(String, String)>,
    /// Whether the steady flow was sought.
    pub steady: bool,
}

impl FlowSettings {
    /// ρ U L/μ, where there is a reference.
    pub fn reynolds(&self) -> Option<f64> {
        let FlowReference { velocity, length, .. } = self.reference?;
        Some(self.density * velocity * length / self.viscosity)
    }
}

/// What force coefficients `2 F/(ρ U² L)` are made with.
///
/// ```
/// let reference = lumley::report::FlowReference { velocity: 0.2, length: 0.1, density: 1.0 };
/// assert_eq!(reference.length, 0.1);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FlowReference {
    /// U, in m/s.
    pub velocity: f64,
    /// L, in m.
    pub length: f64,
    /// ρ, in kg/m³.
    pub density: f64,
}

/// The numbers that the summary has for a boundary; coefficients where the case has a reference.
///
/// ```
/// assert_eq!(lumley::report::LoadNumbers::default().strouhal, None);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LoadNumbers {
    /// Largest drag coefficient.
    pub drag_max: Option<f64>,
    /// Mean drag coefficient.
    pub drag_mean: Option<f64>,
    /// Largest lift coefficient.
    pub lift_max: Option<f64>,
    /// Mean lift coefficient.
    pub lift_mean: Option<f64>,
    /// Root of the mean square of the lift coefficient about its mean.
    pub lift_rms: Option<f64>,
    /// Strouhal number.
    pub strouhal: Option<f64>,
    /// Frequency of the lift, in Hz.
    pub frequency: Option<f64>,
    /// Full periods of the lift over which the numbers are taken; 0 where it has none.
    pub periods: usize,
    /// From when to when they are taken, in s.
    pub window: Option<[f64; 2]>,
    /// Mean force, in N for each m of span.
    pub force_mean: Option<Point>,
    /// How far the surface integral (17) is from the consistent force at the end, relative to it.
    pub cross_check: Option<f64>,
}

/// The loads on one boundary.
///
/// ```
/// let wall = lumley::report::BoundaryLoads { name: "bottom".into(), ..Default::default() };
/// assert!(!wall.is_body);
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct BoundaryLoads {
    /// The boundary.
    pub name: String,
    /// Whether it is that of a body in the flow.
    pub is_body: bool,
    /// What the summary says.
    pub numbers: LoadNumbers,
    /// Drag over the times: the coefficient with a reference, else the force in x, in N/m.
    pub drag: Vec<f64>,
    /// Lift over the times: the coefficient, or the force in y, in N/m.
    pub lift: Vec<f64>,
    /// Moment over the times, in N.
    pub moment: Vec<f64>,
    /// Frequencies in Hz and the amplitudes of the lift over the periods.
    pub spectrum: Option<(Vec<f64>, Vec<f64>)>,
}

/// The velocity and pressure at a point over time.
///
/// ```
/// let probe = lumley::report::ProbeSeries { name: "wake".into(), ..Default::default() };
/// assert!(probe.pressure.is_empty());
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ProbeSeries {
    /// Its name.
    pub name: String,
    /// u, in m/s.
    pub u: Vec<f64>,
    /// v, in m/s.
    pub v: Vec<f64>,
    /// p, in Pa.
    pub pressure: Vec<f64>,
}

/// What was measured over time.
///
/// ```
/// assert!(lumley::report::History::default().times.is_empty());
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct History {
    /// Times of the probes, in s.
    pub times: Vec<f64>,
    /// The probes.
    pub probes: Vec<ProbeSeries>,
    /// Pressure difference between the two points of the case, in Pa.
    pub pressure_difference: Vec<f64>,
    /// Times of what follows, in s.
    pub step_times: Vec<f64>,
    /// Courant number.
    pub cfl: Vec<f64>,
    /// Iterations of the linear solver.
    pub iterations: Vec<f64>,
    /// Residuals of the iteration to the steady flow, relative.
    pub residuals: Vec<f64>,
}

/// The work of a run.
///
/// ```
/// assert_eq!(lumley::report::FlowWork::default().steps, 0);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FlowWork {
    /// Unknowns of a step.
    pub unknowns: usize,
    /// Steps made.
    pub steps: usize,
    /// Time of one, in ms.
    pub step_ms: Option<f64>,
    /// Iterations of the linear solver in a step, in the mean.
    pub iterations: Option<f64>,
    /// Renewals of the factorisation.
    pub renewals: Option<usize>,
    /// Most memory that was taken, in bytes.
    pub memory: Option<f64>,
}

/// The decomposition of the velocity on the fixed grid.
///
/// ```
/// use lumley::report::FlowModes;
/// use lumley_fem::UniformGrid;
///
/// let grid = UniformGrid::rectangle([0.0, 0.0], [2.2, 0.41], [221, 42]);
/// let none = FlowModes {
///     grid,
///     eigenvalues: vec![],
///     total_energy: 0.0,
///     centred: true,
///     residuals: vec![],
///     modes: None,
///     times: vec![],
///     coefficients: vec![],
///     thinned: None,
///     divergence: vec![],
///     snapshot_divergence: None,
/// };
/// assert!(none.modes.is_none());
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct FlowModes {
    /// The grid.
    pub grid: UniformGrid,
    /// λ, largest first, in m⁴/s².
    pub eigenvalues: Vec<f64>,
    /// Sum of all λ, also of those not kept.
    pub total_energy: f64,
    /// Whether the mean over time was subtracted.
    pub centred: bool,
    /// Res(N) of the projection in %, N = 1, 2, ...
    pub residuals: Vec<f64>,
    /// What is drawn of the modes.
    pub modes: Option<DrawnModes>,
    /// Times of the snapshots, in s.
    pub times: Vec<f64>,
    /// `a_n(t)`, in m²/s.
    pub coefficients: Vec<Vec<f64>>,
    /// What becomes of it with fewer snapshots.
    pub thinned: Option<ThinnedModes>,
    /// Norm of the divergence of each mode over that of its gradient, where it has one.
    pub divergence: Vec<Option<f64>>,
    /// The same of the snapshots.
    pub snapshot_divergence: Option<f64>,
}

/// The decomposition of every so many snapshots.
///
/// ```
/// assert_eq!(lumley::report::ThinnedModes::default().snapshots, 0);
/// ```
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(default)]
pub struct ThinnedModes {
    /// One of so many snapshots is taken.
    pub every: usize,
    /// Snapshots taken.
    pub snapshots: usize,
    /// λ, largest first, in m⁴/s².
    pub eigenvalues: Vec<f64>,
    /// Share of the energy in the first modes, in %.
    pub cumulative_percent: Vec<f64>,
    /// Res(N) of the projection in %, N = 1, 2, ...
    pub res_percent: Vec<f64>,
}

/// A way to bring a snapshot to the fixed grid.
///
/// ```
/// let nearest = lumley::report::TransferNumbers { name: "nearest node".into(), ..Default::default() };
/// assert_eq!(nearest.milliseconds, None);
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TransferNumbers {
    /// What it is called.
    pub name: String,
    /// Its error in L2, relative to the velocity.
    pub l2: Option<f64>,
    /// Its largest error, relative to the largest velocity.
    pub largest: Option<f64>,
    /// Its error at the nodes of the grid, relative to the velocity there.
    pub nodes: Option<f64>,
    /// What a snapshot costs, in ms.
    pub milliseconds: Option<f64>,
}

/// What a flow looks like.
///
/// ```
/// assert!(lumley::report::Scene::default().mesh.is_none());
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Scene {
    /// The mesh where it was at first.
    pub mesh: Option<PlanarMesh>,
    /// The pictures.
    pub film: Option<Film>,
}
