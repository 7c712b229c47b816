use super::RigidMotion;
use lumley_fem::{CellPlace, MeshError, NodePlace};

/// Why a mesh cannot move, or cannot move so far.
///
/// ```
/// use lumley_fem::CellPlace;
/// use lumley_fom::motion::MotionError;
/// let cell = CellPlace { cell: 7, place: [0.5, 2.0] };
/// let error = MotionError::Tangled { time: 1.5, cell, quality: -0.2, determinant: -1e-3 };
/// assert!(error.to_string().starts_with("the mesh tangled at t = 1.5 s in cell 7 near (0.5, 2) m"));
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MotionError {
    /// A quantity outside of its range.
    #[error("mesh motion: {what} is {value} {unit}, expected {expected}")]
    Quantity {
        /// Which one.
        what: String,
        /// The value found.
        value: f64,
        /// Its unit.
        unit: &'static str,
        /// What was expected.
        expected: &'static str,
    },
    /// No boundary to move.
    #[error("mesh motion: no boundary moves: name at least one, or leave the motion out")]
    NothingMoves,
    /// A name that no boundary has.
    #[error("mesh motion: the mesh has no boundary \"{name}\"; its boundaries are {}", .known.join(", "))]
    UnknownBoundary {
        /// The name.
        name: String,
        /// The names that there are.
        known: Vec<String>,
    },
    /// Two motions for one boundary.
    #[error("mesh motion: boundary \"{0}\" is named twice: give it one motion")]
    Twice(String),
    /// A node that would have to be in two places.
    #[error(
        "mesh motion: {node} is on boundary \"{}\" and on boundary \"{}\", which do not move together: give the parts of one body one name, and leave cells between a body and a wall",
        .names[0], .names[1]
    )]
    Touching {
        /// The node.
        node: NodePlace,
        /// The boundaries.
        names: [String; 2],
    },
    /// A rigid zone that ends nowhere.
    #[error(
        "mesh motion: the rigid zone of {zone} m round boundary \"{boundary}\" reaches boundary \"{other}\" or its zone: the largest that fits is {largest} m"
    )]
    ZoneReaches {
        /// The boundary that moves.
        boundary: String,
        /// The one that is in its way.
        other: String,
        /// The zone asked for, in m.
        zone: f64,
        /// The largest zone that fits, in m.
        largest: f64,
    },
    /// No memory for the factorisation.
    #[error("mesh motion: no memory to factorise {unknowns} unknowns: take a coarser mesh")]
    Memory {
        /// Number of unknowns.
        unknowns: usize,
    },
    /// Stiffnesses so different that nothing is left of the small ones.
    #[error(
        "mesh motion: its equations are singular to working precision: take a smaller power of the stiffness"
    )]
    Singular,
    /// More or fewer motions than boundaries that move.
    #[error("mesh motion: {found} motions for {expected} moving boundaries: give one for each")]
    Positions {
        /// Number of boundaries that move.
        expected: usize,
        /// Number of motions.
        found: usize,
    },
    /// Another mesh than the one that the motion was made for.
    #[error(
        "mesh motion: the mesh has {found} nodes, expected the {expected} of the mesh that the motion was made for"
    )]
    OtherMesh {
        /// Number of nodes that the motion was made for.
        expected: usize,
        /// Number of nodes found.
        found: usize,
    },
    /// A position that is not a number.
    #[error(
        "the motion of boundary \"{boundary}\" at t = {time} s is {:?} m and {} rad, expected finite numbers",
        .motion.translation, .motion.angle, time = rounded(*time)
    )]
    NotFinite {
        /// The time, in s.
        time: f64,
        /// The boundary.
        boundary: String,
        /// Its motion.
        motion: RigidMotion,
    },
    /// A cell that is inside out, flat or folded.
    #[error(
        "the mesh tangled at t = {time} s in {cell}: the cell's scaled Jacobian is {quality:.3}, the determinant of its map {determinant:.2e} m², expected above 0: move less, take the stiffness \"distance\" or another power, a rigid zone so wide that layers keep their shape, or a larger domain",
        time = rounded(*time)
    )]
    Tangled {
        /// The time, in s.
        time: f64,
        /// The cell, with the place where it is worst.
        cell: CellPlace,
        /// Its scaled Jacobian: smallest over largest determinant at its nodes.
        quality: f64,
        /// Determinant of its map at the place, in m².
        determinant: f64,
    },
    /// A node beyond all sense.
    #[error("the mesh is lost at t = {time} s: {error}", time = rounded(*time))]
    Lost {
        /// The time, in s.
        time: f64,
        /// What is wrong with it.
        #[source]
        error: MeshError,
    },
}

/// A time, in s, without the round-off of summed steps.
pub(crate) fn rounded(time: f64) -> f64 {
    format!("{time:.11e}").parse().unwrap_or(time)
}

impl MotionError {
    pub(super) fn require(
        ok: bool,
        what: &str,
        value: f64,
        unit: &'static str,
        expected: &'static str,
    ) -> Result<(), Self> {
        if ok {
            Ok(())
        } else {
            Err(Self::Quantity { what: what.to_owned(), value, unit, expected })
        }
    }
}
