use super::PistonError;
use lumley_body::joint::Prismatic;
use std::f64::consts::PI;

/// The physics of the piston, paper eqs. (33) and (34), and how it starts.
///
/// ```
/// use lumley_body::joint::Prismatic;
/// use lumley_fom::{InitialFlow, PistonParameters};
/// let canonical = PistonParameters {
///     viscosity: 0.2,
///     domain_length: 1.1,
///     force_factor: 1.0,
///     joint: Prismatic { mass: 0.5, stiffness: 39.5, damping: 0.1, rest_length: 0.95 },
///     initial_position: 0.9,
///     initial_velocity: 0.0,
///     initial_flow: InitialFlow::Zero,
/// };
/// assert!(canonical.check().is_ok());
/// assert!(PistonParameters { viscosity: -1.0, ..canonical }.check().is_err());
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct PistonParameters {
    /// Kinematic viscosity nu, in m²/s.
    pub viscosity: f64,
    /// Length L of the fixed domain, in m.
    pub domain_length: f64,
    /// Factor `c_F` in the force `F = −c_F nu u_x(X−)` of the fluid on the block, in kg/m: 1 is the viscous
    /// traction, 0 a block that does not feel the fluid.
    pub force_factor: f64,
    /// Mass, spring and damper of the block.
    pub joint: Prismatic,
    /// X(0), in m.
    pub initial_position: f64,
    /// X'(0), in m/s.
    pub initial_velocity: f64,
    /// The velocity u0 of the fluid.
    pub initial_flow: InitialFlow,
}

/// The velocity of the fluid at the start, paper eq. (33).
///
/// ```
/// use lumley_fom::InitialFlow;
/// let flow = InitialFlow::Table(vec![(0.0, 0.0), (0.5, 0.1), (0.9, 0.0)]);
/// assert_ne!(flow, InitialFlow::Zero);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum InitialFlow {
    /// At rest; at the interface the block's velocity.
    Zero,
    /// `u0 = X'(0) x/X(0)`.
    Linear,
    /// Linear plus `A sin(pi x/X(0))`, the amplitude A in m/s.
    Sine(f64),
    /// Rows of x in m and u in m/s, linear between them; from the wall, u = 0, to the interface,
    /// u = X'(0).
    Table(Vec<(f64, f64)>),
}

/// How far, relative to its largest velocity, a table may miss the velocities of the boundaries.
const TABLE_TOLERANCE: f64 = 1e-6;

impl PistonParameters {
    /// Whether every quantity is in its range.
    ///
    /// # Errors
    /// The [`PistonError`] that names the quantity.
    pub fn check(&self) -> Result<(), PistonError> {
        positive("viscosity", self.viscosity, "m²/s")?;
        positive("domain length", self.domain_length, "m")?;
        not_negative("force factor", self.force_factor, "kg/m")?;
        self.joint.check().map_err(PistonError::Joint)?;
        finite("initial velocity", self.initial_velocity, "m/s")?;
        let (position, domain_length) = (self.initial_position, self.domain_length);
        if !(position > 0.0 && position < domain_length) {
            return Err(PistonError::InitialPosition { position, domain_length });
        }
        match &self.initial_flow {
            InitialFlow::Zero | InitialFlow::Linear => Ok(()),
            InitialFlow::Sine(amplitude) => finite("initial flow amplitude", *amplitude, "m/s"),
            InitialFlow::Table(rows) => self.check_table(rows),
        }
    }

    fn check_table(&self, rows: &[(f64, f64)]) -> Result<(), PistonError> {
        let [(first, _), .., (last, _)] = *rows else {
            return Err(PistonError::TableTooShort(rows.len()));
        };
        let mut before = f64::NEG_INFINITY;
        for (row, &(x, u)) in (1..).zip(rows) {
            if !(x.is_finite() && u.is_finite() && x > before) {
                return Err(PistonError::TableRow { row, x, u });
            }
            before = x;
        }
        let position = self.initial_position;
        let slack = TABLE_TOLERANCE * position;
        if first > slack || last < position - slack {
            return Err(PistonError::TableRange { first, last, position });
        }
        let scale = rows.iter().fold(self.initial_velocity.abs(), |max, row| max.max(row.1.abs()));
        for (x, expected) in [(0.0, 0.0), (position, self.initial_velocity)] {
            let found = interpolate(rows, x);
            if (found - expected).abs() > TABLE_TOLERANCE * scale {
                return Err(PistonError::TableEnd { x, found, expected });
            }
        }
        Ok(())
    }

    /// u0 at `xi = x/X(0)`, in m/s. At the ends it is exactly the velocity of the boundary.
    pub(super) fn initial_velocity_at(&self, xi: f64) -> f64 {
        let linear = self.initial_velocity * xi;
        if xi <= 0.0 || xi >= 1.0 {
            return linear;
        }
        match &self.initial_flow {
            InitialFlow::Zero => 0.0,
            InitialFlow::Linear => linear,
            InitialFlow::Sine(amplitude) => linear + amplitude * (PI * xi).sin(),
            InitialFlow::Table(rows) => interpolate(rows, xi * self.initial_position),
        }
    }
}

/// The piecewise linear function through `rows` at `x`; beyond the ends their values.
fn interpolate(rows: &[(f64, f64)], x: f64) -> f64 {
    let next = rows.partition_point(|row| row.0 <= x);
    if next == 0 || next == rows.len() {
        return rows[next.saturating_sub(1)].1;
    }
    let ((x0, u0), (x1, u1)) = (rows[next - 1], rows[next]);
    let t = (x - x0) / (x1 - x0);
    u0 * (1.0 - t) + u1 * t
}

fn require(
    ok: bool,
    quantity: &'static str,
    value: f64,
    unit: &'static str,
    expected: &'static str,
) -> Result<(), PistonError> {
    if ok { Ok(()) } else { Err(PistonError::Quantity { quantity, value, unit, expected }) }
}

fn finite(quantity: &'static str, value: f64, unit: &'static str) -> Result<(), PistonError> {
    require(value.is_finite(), quantity, value, unit, "a finite number")
}

fn positive(quantity: &'static str, value: f64, unit: &'static str) -> Result<(), PistonError> {
    let ok = value.is_finite() && value > 0.0;
    require(ok, quantity, value, unit, "a finite number above 0")
}

fn not_negative(quantity: &'static str, value: f64, unit: &'static str) -> Result<(), PistonError> {
    let ok = value.is_finite() && value >= 0.0;
    require(ok, quantity, value, unit, "0 or a finite number above")
}
