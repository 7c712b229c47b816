use crate::ProjectionKind;
use lumley_body::joint::JointError;
use std::fmt;

/// Why a reduced model cannot be built or cannot go on.
///
/// ```
/// use lumley_rom::ReducedError;
/// let e = ReducedError::Parameter {
///     name: "viscosity",
///     value: -0.2,
///     unit: "m²/s",
///     expected: "positive and finite",
/// };
/// assert_eq!(e.to_string(), "viscosity is -0.2 m²/s, but must be positive and finite");
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReducedError {
    /// A number outside of its physical or numerical range.
    #[error("{name} is {value} {unit}, but must be {expected}")]
    Parameter {
        /// Name of the quantity.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Unit of the value.
        unit: &'static str,
        /// The range it must lie in.
        expected: &'static str,
    },
    /// The block is not a physical one.
    #[error(transparent)]
    Joint(JointError),
    /// An array of the wrong length.
    #[error("{what}: {found} given, but there must be {expected}")]
    Count {
        /// What was counted.
        what: &'static str,
        /// Number given.
        found: usize,
        /// Number needed.
        expected: usize,
    },
    /// A basis without modes.
    #[error("the basis has no mode; keep at least one")]
    NoModes,
    /// A value that is not a number or infinite.
    #[error("{what} at node {node} is {value}; all values must be finite")]
    NotFinite {
        /// Which array.
        what: &'static str,
        /// Number of the node, from 0.
        node: usize,
        /// The value there.
        value: f64,
    },
    /// Nodes of the reference frame that do not make finite elements on (0, 1).
    #[error(
        "node {node} of the reference frame lies at {position}: the nodes must grow from 0 to 1, with the \
         middle node of each cell of degree 2 in the middle"
    )]
    Node {
        /// Number of the node, from 0.
        node: usize,
        /// Its place, dimensionless.
        position: f64,
    },
    /// Modes that are not orthonormal in the L2 product of their finite elements, paper eq. (6).
    #[error(
        "modes {first} and {second} have the inner product {product:.6} in L2; \
         make POD with the mass matrix of the same nodes, or keep fewer modes"
    )]
    NotOrthonormal {
        /// Number of the one mode, from 1.
        first: usize,
        /// Number of the other mode, from 1.
        second: usize,
        /// Their inner product, which should be 0 or 1.
        product: f64,
    },
    /// A field of the reference frame that does not vanish at both ends.
    #[error(
        "{what} is {value:e} at the end {end} of the reference frame, but must be zero: \
         take the velocity less X' xi there"
    )]
    NotHomogeneous {
        /// Which field.
        what: &'static str,
        /// The end, 0 or 1.
        end: usize,
        /// The value there.
        value: f64,
    },
    /// A basis of one frame given to a projection of the other.
    #[error("the projection `{projection}` needs modes on {expected}")]
    Frame {
        /// Name of the projection.
        projection: &'static str,
        /// The frame it works in.
        expected: &'static str,
    },
    /// A grid that does not lie on the model's domain.
    #[error(
        "the grid runs from {lower} to {upper} m in {dimension} dimension(s), but must be {expected}"
    )]
    Grid {
        /// Its lower end, in m.
        lower: f64,
        /// Its upper end, in m.
        upper: f64,
        /// Its dimension.
        dimension: usize,
        /// What the model needs.
        expected: &'static str,
    },
    /// Operator tables beyond a sensible size.
    #[error(
        "the operators of {modes} modes on {nodes} nodes would take {mebibytes} MiB; \
         keep fewer modes or take a coarser grid"
    )]
    TooLarge {
        /// Number of modes, the mean included.
        modes: usize,
        /// Number of grid nodes.
        nodes: usize,
        /// Memory of the tables, in MiB.
        mebibytes: usize,
    },
    /// The computation left every sensible range; the model keeps the state before the step.
    #[error(
        "the reduced model diverged at t = {time:.6} s: {cause}; {}",
        remedy(*cause, *step, *stable_step, *projection)
    )]
    Diverged {
        /// Time at which the step began, in s.
        time: f64,
        /// Length of the step, in s.
        step: f64,
        /// Longest stable step of explicit RK4 there, in s; `None` for an L-stable integrator.
        stable_step: Option<f64>,
        /// The projection of the model.
        projection: ProjectionKind,
        /// What was seen.
        cause: Divergence,
    },
}

/// How a divergence showed itself.
///
/// ```
/// use lumley_rom::Divergence;
/// let seen = Divergence::Outside { position: 1.3, length: 1.1 };
/// assert_eq!(seen.to_string(), "the interface went to X = 1.3000 m, outside of (0, 1.1) m");
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Divergence {
    /// A value is not a number or infinite.
    NotFinite,
    /// The interface left the domain.
    Outside {
        /// Its position X, in m.
        position: f64,
        /// Length L of the domain, in m.
        length: f64,
    },
    /// The velocity grew beyond any sense.
    Speed {
        /// Norm of the coefficients and the velocity of the body in L2 of the modes' domain: in m^(3/2)/s
        /// on a fixed grid, in m/s in the reference frame.
        norm: f64,
        /// Largest norm that is taken seriously.
        limit: f64,
    },
    /// The error control of an adaptive integrator found no step that it could accept.
    StepUnderflow {
        /// Last step tried, in s.
        tried: f64,
    },
    /// An adaptive integrator did not come to the end of the step.
    Substeps {
        /// Substeps tried.
        count: usize,
        /// Time that was left, in s.
        left: f64,
    },
}

impl fmt::Display for Divergence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite => write!(f, "a value is no longer finite"),
            Self::Outside { position, length } => {
                write!(f, "the interface went to X = {position:.4} m, outside of (0, {length}) m")
            }
            Self::Speed { norm, limit } => {
                write!(
                    f,
                    "the velocity norm grew to {norm:.3}, beyond {limit:.3}, many times what the energy of the start accounts for"
                )
            }
            Self::StepUnderflow { tried } => {
                write!(f, "the error control rejected even a step of {tried:.1e} s")
            }
            Self::Substeps { count, left } => {
                write!(f, "{count} substeps of the error control left {left:.2e} s of the step")
            }
        }
    }
}

/// What to do about a divergence: it depends on what was seen, and on whether the step was too long.
fn remedy(
    cause: Divergence,
    step: f64,
    stable_step: Option<f64>,
    projection: ProjectionKind,
) -> String {
    let model = if projection.reference_frame() {
        "other modes"
    } else {
        "the projection `mapped`, or other modes"
    };
    match (cause, stable_step) {
        (_, Some(stable)) if step > stable => format!(
            "the step {step:.2e} s exceeds the stable step {stable:.2e} s of RK4: \
             take a shorter step or the integrator `rosenbrock`"
        ),
        (Divergence::Outside { .. }, _) => format!(
            "take a longer domain or a slower start; where the full-order model stays inside, take {model}"
        ),
        (Divergence::StepUnderflow { .. }, _) => format!(
            "take a larger tolerance; if that does not help, the model itself is unstable: take {model}"
        ),
        (Divergence::Substeps { .. }, _) => "take a larger tolerance or a shorter step".into(),
        _ => format!(
            "the step {step:.2e} s is not the cause, the model itself is unstable: take {model}"
        ),
    }
}

impl ReducedError {
    /// Refuses a value that is not positive and finite.
    pub(crate) fn check_positive(
        name: &'static str,
        value: f64,
        unit: &'static str,
    ) -> Result<(), Self> {
        let good = value.is_finite() && value > 0.0;
        let error = Self::Parameter { name, value, unit, expected: "positive and finite" };
        if good { Ok(()) } else { Err(error) }
    }

    /// Refuses a value that is negative or not finite.
    pub(crate) fn check_not_negative(
        name: &'static str,
        value: f64,
        unit: &'static str,
    ) -> Result<(), Self> {
        let good = value.is_finite() && value >= 0.0;
        let error = Self::Parameter { name, value, unit, expected: "zero or more, and finite" };
        if good { Ok(()) } else { Err(error) }
    }
}
