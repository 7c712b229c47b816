//! Incompressible flow on a planar mesh that may move, paper eqs. (11)-(15).
//!
//! ```text
//! ρ (∂u/∂t|_X + ((u − w)·∇) u) − ∇·σ = ρ f,   ∇·u = 0,   σ = −p I + μ (∇u + ∇uᵀ)
//! ```
//!
//! with the mesh velocity w. The rate is that of a node X of the mesh: the advective form, which keeps a uniform flow
//! whatever the mesh does (the geometric conservation law). Velocities are quadratic with a bubble on triangles and
//! biquadratic on quadrilaterals, pressures linear and discontinuous: the paper's Crouzeix-Raviart and Q2/P1 pairs.

mod adaptive;
mod cells;
mod checkpoint;
mod condition;
mod constraint;
mod error;
mod field;
mod given;
mod loads;
mod outlet;
mod output;
mod parameters;
mod periodic;
mod places;
mod rigid;
mod setup;
mod slip;
mod solve;
mod stability;
mod steady;
mod step;
mod system;
mod unknowns;

pub use adaptive::StepControl;
pub use condition::Condition;
pub use error::FlowError;
pub use field::VectorField;
pub use loads::Load;
pub use parameters::{FlowParameters, Linearisation, ViscousForm};
pub(crate) use setup::boundary_number;
pub use setup::{FlowMotion, FlowSetup, FlowStart};
pub use steady::{SteadyLimits, SteadyReport};
pub use step::FlowStep;

use crate::coupling::BodyMotion;
use crate::linear::{CellUnknowns, LaggedSolver};
use crate::motion::Motion;
use given::Given;
use loads::LoadDofs;
use lumley_fem::geometry::Tabulated;
use lumley_fem::space::NodalSpace;
use lumley_fem::{PlanarMesh, Point};
use places::DofPlaces;
use rigid::RigidBodies;
use slip::Slides;
use stability::Stability;
use system::System;
use unknowns::Unknowns;

/// The flow.
///
/// ```
/// use lumley_fom::TimeScheme;
/// use lumley_fom::flow::{
///     Condition, Flow, FlowMotion, FlowParameters, FlowSetup, FlowStart, Linearisation, ViscousForm,
/// };
/// use lumley_fem::{MeshDescription, PlanarMesh};
/// use std::sync::Arc;
/// // A channel 3 m long and 1 m high, in which a developed flow goes on for ever.
/// let channel = MeshDescription::structured([6, 4], |_| false, |[x, y]| [3.0 * x, y]);
/// let developed = Arc::new(|[_, y]: [f64; 2], _| [4.0 * y * (1.0 - y), 0.0]);
/// let mut flow = Flow::new(FlowSetup {
///     mesh: PlanarMesh::new(channel)?,
///     parameters: FlowParameters {
///         density: 1.0,
///         viscosity: 0.01,
///         viscous_form: ViscousForm::Laplacian,
///         linearisation: Linearisation::Tangent,
///         scheme: TimeScheme::Bdf2,
///         body_force: None,
///     },
///     conditions: vec![
///         ("left".into(), Condition::Velocity(developed.clone())),
///         ("bottom".into(), Condition::NoSlip),
///         ("top".into(), Condition::NoSlip),
///         ("right".into(), Condition::TractionFree),
///     ],
///     start: FlowStart::Velocity(developed),
///     motion: FlowMotion::Still,
///     parallel: false,
/// })?;
/// for _ in 0..3 {
///     flow.step(0.1)?;
/// }
/// // The shear of each wall is 4 μ U / H, on a length of 3 m.
/// let wall = flow.surface_load("bottom").unwrap().force[0];
/// assert!((wall - 4.0 * 0.01 * 3.0).abs() < 1e-8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Flow {
    parameters: FlowParameters,
    conditions: Vec<Condition>,
    mesh: PlanarMesh,
    space: NodalSpace,
    /// How the mesh moves, if nothing but the time tells.
    motion: Option<Box<dyn Motion>>,
    /// The bodies that move it otherwise.
    bodies: Option<BodyMotion>,
    parallel: bool,

    unknowns: Unknowns,
    pattern: CellUnknowns,
    system: System,
    solver: LaggedSolver,
    places: DofPlaces,
    slides: Slides,
    rigid: RigidBodies,
    given: Given,
    load_dofs: LoadDofs,

    time: f64,
    /// The step before, in s.
    previous: Option<f64>,
    /// Steps made.
    steps: u64,
    /// Adaptive steps in a row that were too long and could not be shorter.
    forced_steps: u32,
    stability: Stability,
    /// What an adaptive step would be, in s.
    wanted_step: Option<f64>,
    /// At the velocity dofs, now and a step before.
    velocity: [Vec<Point>; 2],
    /// By cell, now and a step before.
    pressure: [Vec<[f64; 3]>; 2],
    /// Where the geometry nodes were in the equations, now and a step before; nothing where the mesh stays.
    nodes: [Vec<Point>; 2],
    /// At the velocity dofs.
    mesh_velocity: Vec<Point>,
    loads: Vec<Load>,
    /// Pivots of the boundaries, for the moments.
    pivots: Vec<Point>,
    /// Numbers of the boundaries that move.
    moving: Vec<usize>,
    edge_rule: Vec<Tabulated<3>>,
    area_rules: (Vec<Tabulated<6>>, Vec<Tabulated<9>>),
    work: Work,
}

/// Vectors of the step, kept so that it allocates nothing.
#[derive(Debug, Clone)]
struct Work {
    wind: Vec<Point>,
    source: Vec<Point>,
    /// The velocity about which the equations are linearised, or which was extrapolated.
    base: Vec<Point>,
    dof_points: Vec<Point>,
    node_velocity: Vec<Point>,
    /// Along which dofs move that are not free: those of the slides, then those of the bodies.
    directions: Vec<Point>,
    /// Of the bodies, by coordinate.
    body_velocity: Vec<f64>,
    right: Vec<f64>,
    solution: Vec<f64>,
    new_velocity: Vec<Point>,
    new_pressure: Vec<[f64; 3]>,
}
