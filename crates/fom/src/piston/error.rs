use lumley_body::joint::JointError;

/// Why a piston cannot be built or cannot make a step.
///
/// ```
/// use lumley_fom::PistonError;
/// let error = PistonError::Step(-0.1);
/// assert_eq!(error.to_string(), "time step is -0.1 s, expected a finite number above 0");
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PistonError {
    /// A physical quantity outside of its range.
    #[error("{quantity} is {value} {unit}, expected {expected}")]
    Quantity {
        /// Its name.
        quantity: &'static str,
        /// The value found.
        value: f64,
        /// Its unit.
        unit: &'static str,
        /// What was expected.
        expected: &'static str,
    },
    /// The block is not a physical one.
    #[error(transparent)]
    Joint(JointError),
    /// The block does not start inside of the domain.
    #[error(
        "initial position is {position} m, expected a position inside of the domain, above 0 and below {domain_length} m"
    )]
    InitialPosition {
        /// X(0), in m.
        position: f64,
        /// L, in m.
        domain_length: f64,
    },
    /// The table of the initial flow is shorter than a line.
    #[error("initial flow table has {0} rows, expected at least 2")]
    TableTooShort(usize),
    /// A row of the initial flow's table is out of order or not finite.
    #[error(
        "initial flow table, row {row}: x = {x} m, u = {u} m/s, expected finite numbers and x above the row before"
    )]
    TableRow {
        /// The row, counted from 1.
        row: usize,
        /// Its position, in m.
        x: f64,
        /// Its velocity, in m/s.
        u: f64,
    },
    /// The table of the initial flow leaves a part of the fluid out.
    #[error(
        "initial flow table covers {first} m to {last} m, expected all of the fluid, 0 m to {position} m"
    )]
    TableRange {
        /// First position in the table, in m.
        first: f64,
        /// Last position in the table, in m.
        last: f64,
        /// X(0), in m.
        position: f64,
    },
    /// The initial flow slips at one of its ends.
    #[error(
        "initial flow table gives u = {found} m/s at x = {x} m, expected {expected} m/s, the velocity of the boundary there"
    )]
    TableEnd {
        /// Where, in m.
        x: f64,
        /// The velocity in the table, in m/s.
        found: f64,
        /// The velocity of the boundary, in m/s.
        expected: f64,
    },
    /// A mesh without an unknown, or too large to be meant.
    #[error("mesh has {cells} cells, expected 2 to {largest}")]
    Cells {
        /// Cells asked for.
        cells: usize,
        /// Most cells allowed.
        largest: usize,
    },
    /// No such finite element.
    #[error("mesh degree is {0}, expected 1 or 2")]
    Degree(usize),
    /// The length of a step makes no sense.
    #[error("time step is {0} s, expected a finite number above 0")]
    Step(f64),
    /// Newton's method did not converge.
    #[error(
        "Newton's method did not converge at t = {time} s; residuals in m/s: {}, wanted {tolerance:.1e}: take a shorter time step",
        list(.residuals)
    )]
    NotConverged {
        /// The instant that was to be reached, in s.
        time: f64,
        /// The residual after each iteration, in m/s.
        residuals: Vec<f64>,
        /// The residual that was wanted, in m/s.
        tolerance: f64,
    },
    /// The block left the domain.
    #[error(
        "the interface left the domain at t = {time} s: X = {position} m, expected above 0 and below {domain_length} m; take a longer domain, a slower start or a shorter time step"
    )]
    InterfaceLeft {
        /// The instant that was to be reached, in s.
        time: f64,
        /// X, in m.
        position: f64,
        /// L, in m.
        domain_length: f64,
    },
    /// A value overflowed or is not a number.
    #[error(
        "a value is not finite at t = {time} s: the velocities are too large for the time step; take a shorter one"
    )]
    NonFinite {
        /// The instant that was to be reached, in s.
        time: f64,
    },
}

fn list(residuals: &[f64]) -> String {
    residuals.iter().map(|r| format!("{r:.1e}")).collect::<Vec<_>>().join(", ")
}
