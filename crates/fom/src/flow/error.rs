use crate::linear::LaggedError;
use crate::motion::{MotionError, rounded};
use lumley_body::{DynamicsError, TreeError};
use lumley_fem::Point;
use lumley_fem::transfer::BodyError;
use thiserror::Error;

/// Why a flow cannot be set up or go on.
///
/// ```
/// use lumley_fom::flow::FlowError;
/// let error = FlowError::NoCondition { boundary: "inlet".into() };
/// assert!(error.to_string().contains("inlet"));
/// ```
#[derive(Debug, Error)]
pub enum FlowError {
    /// A parameter cannot be computed with.
    #[error("{name} = {value:?} {unit}: expected a positive, finite number")]
    Parameter {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// The time scheme does not damp, which a flow that starts impulsively needs.
    #[error(
        "the flow takes implicit-euler or bdf2, not crank-nicolson, which does not damp an impulsive start"
    )]
    Scheme,
    /// A boundary of the mesh has no condition.
    #[error(
        "boundary `{boundary}` has no condition: say velocity, no-slip, slip, traction-free or periodic"
    )]
    NoCondition {
        /// The boundary.
        boundary: String,
    },
    /// A condition, or a motion, is for a boundary that the mesh does not have.
    #[error("the mesh has no boundary `{boundary}`; it has {known}")]
    UnknownBoundary {
        /// The boundary asked for.
        boundary: String,
        /// Those that are there.
        known: String,
    },
    /// A boundary has two conditions.
    #[error("boundary `{boundary}` has two conditions: leave one")]
    TwoConditions {
        /// The boundary.
        boundary: String,
    },
    /// Two boundaries do not make a periodic pair.
    #[error("boundaries `{one}` and `{other}` are not periodic: {why}")]
    NotPeriodic {
        /// One.
        one: String,
        /// The other.
        other: String,
        /// What is wrong.
        why: &'static str,
    },
    /// A boundary that moves has another condition than no slip.
    #[error(
        "boundary `{boundary}` moves, but its condition is {condition}: a moving boundary is no-slip"
    )]
    MovingBoundary {
        /// The boundary.
        boundary: String,
        /// Its condition.
        condition: &'static str,
    },
    /// The mesh falls apart, and a part of it has no outlet.
    #[error(
        "the mesh falls into {parts} parts that share no edge, and the one with cell {cell} has no traction-free boundary: \
         join the parts, give each an outlet, or run them one by one"
    )]
    Parts {
        /// Number of parts.
        parts: usize,
        /// A cell of the one without outlet.
        cell: usize,
    },
    /// More comes in than goes out, and there is no outlet.
    #[error(
        "at t = {time} s the given velocities let {flux:e} m2/s out of the domain ({share:.2} % of the speed along its \
         boundaries) and no boundary is traction-free: make one the outlet, or give velocities whose flux is zero",
        time = rounded(*time)
    )]
    Flux {
        /// When, in s.
        time: f64,
        /// Net outflow, in m²/s.
        flux: f64,
        /// Its share of the speed along all boundaries, in percent.
        share: f64,
    },
    /// A given value is not a number.
    #[error("{what} at ({}, {}) m and t = {time} s is ({}, {}): expected finite numbers", place[0], place[1], value[0], value[1], time = rounded(*time))]
    NotFinite {
        /// What was given.
        what: String,
        /// Where, in m.
        place: Point,
        /// When, in s.
        time: f64,
        /// What came.
        value: Point,
    },
    /// A step that is not a positive time.
    #[error("a step of {dt:?} s: expected a positive, finite number")]
    Step {
        /// The step, in s.
        dt: f64,
    },
    /// An adaptive step is too long and may not be shorter.
    #[error(
        "at t = {time} s the velocity is {error:.1e} of its largest value from the extrapolated one, wanted {tolerance:.1e}, and \
         the step is the shortest, {shortest:e} s: allow shorter steps or a larger tolerance",
        time = rounded(*time)
    )]
    ShortestStep {
        /// When, in s.
        time: f64,
        /// The shortest step, in s.
        shortest: f64,
        /// The error found.
        error: f64,
        /// The error wanted.
        tolerance: f64,
    },
    /// The mesh could not follow its boundaries.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The bodies make no tree.
    #[error(transparent)]
    Bodies(#[from] TreeError),
    /// A boundary of a body is not its outline.
    #[error(transparent)]
    Outline(#[from] BodyError),
    /// The bodies do not move by themselves as they should.
    #[error(transparent)]
    Dynamics(#[from] DynamicsError),
    /// Bodies of which none is in the fluid.
    #[error(
        "no body has a boundary: name for at least one the boundary of the mesh through which the fluid acts on it"
    )]
    DryBodies,
    /// A coordinate without inertia along which no fluid gives any.
    #[error(
        "{coordinate} moves no mass, and no boundary that would take fluid with it: give its body a mass or inertia, or the \
         boundary of a hole in the mesh"
    )]
    Massless {
        /// The coordinate.
        coordinate: String,
    },
    /// A body has met another or a wall, or left the domain.
    #[error(
        "at t = {time} s the body with boundary `{body}` meets `{with}`: bodies must keep clear of each other and within the \
         domain; start farther away, hold it with a stiffer spring, or end the run before",
        time = rounded(*time)
    )]
    Collision {
        /// When, in s.
        time: f64,
        /// Its boundary.
        body: String,
        /// The other boundary.
        with: String,
    },
    /// An error that explicit coupling leads to.
    #[error(
        "{source}. But with explicit coupling no step may be small enough here: the fluid that the bodies take with them weighs about \
         {share:.3} of what they weigh, and where that nears 1 they undo every change of their velocity: take the monolithic coupling"
    )]
    AddedMass {
        /// Added mass over that of the bodies, estimated.
        share: f64,
        /// What went wrong.
        source: Box<FlowError>,
    },
    /// The cells between a body and another boundary did not survive.
    #[error(
        "{source}. There the boundary `{body}` is {gap:.2e} m from `{with}`: bodies must keep clear of each other and of walls; hold \
         them with stiffer springs, make the cells between them finer, or end the run before"
    )]
    Squeezed {
        /// The boundary of the body.
        body: String,
        /// The other boundary.
        with: String,
        /// Between nearest nodes, in m.
        gap: f64,
        /// What happened to the mesh.
        source: Box<MotionError>,
    },
    /// A step that does not find where the bodies are.
    #[error(
        "at t = {time} s the bodies are still {apart:.1e} of their size from where the mesh has them after {iterations} \
         iterations, wanted {wanted:.1e}: take a smaller step",
        time = rounded(*time)
    )]
    NotPlaced {
        /// When, in s.
        time: f64,
        /// Iterations made.
        iterations: usize,
        /// Largest distance, over the radius of the body.
        apart: f64,
        /// What was wanted.
        wanted: f64,
    },
    /// The linear system was not solved.
    #[error("at t = {time} s: {source}; {}", .source.remedy(), time = rounded(*time))]
    Linear {
        /// When, in s.
        time: f64,
        /// Why.
        source: LaggedError,
    },
    /// Newton's method did not converge.
    #[error(
        "at t = {time} s the velocity still changes by {change:.1e} of its largest value after {iterations} iterations, \
         wanted {wanted:.1e}: {remedy}",
        time = rounded(*time)
    )]
    NoConvergence {
        /// When, in s.
        time: f64,
        /// Iterations made.
        iterations: usize,
        /// Largest change over the largest velocity.
        change: f64,
        /// What was wanted.
        wanted: f64,
        /// What to do.
        remedy: &'static str,
    },
    /// The velocity is not a number any more.
    #[error(
        "at t = {time} s the velocity is not finite: take a smaller step, a finer mesh or the linearisation newton",
        time = rounded(*time)
    )]
    Diverged {
        /// When, in s.
        time: f64,
    },
    /// The velocity grows, and no step foresees the next.
    #[error(
        "at t = {time} s the flow is unstable: in {steps} steps its largest velocity grew {growth:.1e}-fold, and no step was \
         foreseen by those before it: take a smaller step, a motion and velocities that start smoothly, or the linearisation newton",
        time = rounded(*time)
    )]
    Unstable {
        /// When, in s.
        time: f64,
        /// Steps that were not foreseen, one after another.
        steps: usize,
        /// Largest velocity over that after the first of them.
        growth: f64,
    },
}
