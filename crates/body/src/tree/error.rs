use std::fmt;

/// Why bodies are no tree.
///
/// ```
/// use lumley_body::{RigidBody, Tree, TreeError};
/// #[derive(serde::Deserialize)]
/// struct Case { bodies: Vec<RigidBody> }
/// let case: Case = toml::from_str(
///     "[[bodies]]\nname = 'disc'\nmass = -50\ncentre = [0, 0]\njoint = { kind = 'cartesian' }",
/// )?;
/// let error = Tree::new(&case.bodies, [0.0, 0.0]).unwrap_err();
/// assert_eq!(error.to_string(), "body \"disc\": mass is -50 kg/m, expected 0 or a finite number above");
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TreeError {
    /// No body at all.
    #[error("no bodies: describe at least one")]
    Empty,
    /// A quantity outside of its range.
    #[error("body \"{body}\": {what} is {value} {unit}, expected {expected}")]
    Quantity {
        /// The body.
        body: String,
        /// Which quantity.
        what: String,
        /// The value found.
        value: f64,
        /// Its unit.
        unit: &'static str,
        /// What was expected.
        expected: &'static str,
    },
    /// Gravity that is not a finite vector.
    #[error("gravity is {0:?} m/s², expected two finite numbers")]
    Gravity([f64; 2]),
    /// A body without a name.
    #[error("body {0} has no name: give it one that no other body has")]
    NoName(usize),
    /// Two bodies of one name.
    #[error("two bodies are called \"{0}\": give each its own name")]
    Twice(String),
    /// Two bodies with one boundary.
    #[error(
        "bodies \"{}\" and \"{}\" both have the boundary \"{boundary}\": give each body a boundary of its own, or fix one body to the other and leave its boundary out",
        .bodies[0], .bodies[1]
    )]
    SharedBoundary {
        /// The boundary.
        boundary: String,
        /// The bodies.
        bodies: [String; 2],
    },
    /// A joint to a body that is not there.
    #[error(
        "body \"{body}\": its joint is to \"{to}\", which is no body; the others are {}; leave `to` out for the ground",
        Names(.others)
    )]
    Unknown {
        /// The body.
        body: String,
        /// To what it is joined.
        to: String,
        /// The other bodies.
        others: Vec<String>,
    },
    /// Joints that form a loop.
    #[error(
        "the joints form a loop: {}: hold one of these bodies by the ground, or by a body outside of the loop",
        .0.join(" to ")
    )]
    Loop(Vec<String>),
    /// A body that loads move, without a mass.
    #[error("body \"{0}\" has no mass, and loads can move it: give `mass` in kg/m, which may be 0")]
    NoMass(String),
    /// A body that loads turn, without an inertia.
    #[error(
        "body \"{0}\" has no inertia, and loads can turn it: give `inertia` in kg m about its centre, which may be 0, or a uniform `shape`"
    )]
    NoInertia(String),
    /// Both an inertia and a shape.
    #[error("body \"{0}\" has both `inertia` and `shape`: give one of them")]
    TwoInertias(String),
    /// A start of the wrong length.
    #[error(
        "body \"{body}\": its start has {found} {what}, expected {expected}, as many as coordinates that its joint leaves free, or none"
    )]
    Start {
        /// The body.
        body: String,
        /// Positions or velocities.
        what: &'static str,
        /// How many the joint leaves free.
        expected: usize,
        /// How many were given.
        found: usize,
    },
    /// A formula that nobody has turned into a function.
    #[error(
        "body \"{body}\": {coordinate} is the formula \"{formula}\", expected a number, a table or a function: bodies read no formulas"
    )]
    Formula {
        /// The body.
        body: String,
        /// The coordinate.
        coordinate: &'static str,
        /// The formula.
        formula: String,
    },
}

/// Names in quotes, or that there are none.
struct Names<'a>(&'a [String]);

impl fmt::Display for Names<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_empty() {
            return f.write_str("none");
        }
        for (k, name) in self.0.iter().enumerate() {
            let separator = if k == 0 { "" } else { ", " };
            write!(f, "{separator}\"{name}\"")?;
        }
        Ok(())
    }
}
