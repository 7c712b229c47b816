use crate::ReducedError;
use crate::basis::{Basis, norm};
use lumley_body::joint::Prismatic;

/// The constants of the piston, paper (33)(34).
///
/// ```
/// use lumley_body::joint::Prismatic;
/// use lumley_rom::PistonPhysics;
/// let joint = Prismatic { mass: 0.5, stiffness: 39.5, damping: 0.1, rest_length: 0.95 };
/// let physics = PistonPhysics { viscosity: 0.2, force_factor: 1.0, domain_length: 1.1, joint };
/// assert!(physics.validate().is_ok());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PistonPhysics {
    /// Kinematic viscosity ν, in m²/s.
    pub viscosity: f64,
    /// Factor c_F of the force `F_F = −c_F ν u_x(X-)` on the block, in kg/m; 0 uncouples the block.
    pub force_factor: f64,
    /// Length L of the domain of fluid and solid, in m.
    pub domain_length: f64,
    /// The block on its spring and damper.
    pub joint: Prismatic,
}

/// Where a reduced piston starts.
///
/// ```
/// use lumley_rom::PistonStart;
/// let rest = PistonStart { coefficients: vec![0.0; 6], position: 0.9, velocity: 0.0 };
/// assert_eq!(rest.coefficients.len(), 6);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct PistonStart {
    /// The N coefficients a(0), from [`Basis::project`](crate::Basis::project).
    pub coefficients: Vec<f64>,
    /// Position X(0) of the block, in m.
    pub position: f64,
    /// Velocity X'(0) of the block, in m/s.
    pub velocity: f64,
}

/// Position in m and velocity in m/s of the block.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Motion {
    pub position: f64,
    pub velocity: f64,
}

impl PistonPhysics {
    /// Checks that every constant is physical.
    ///
    /// # Errors
    /// The first one that is not, with its value.
    pub fn validate(&self) -> Result<(), ReducedError> {
        ReducedError::check_positive("viscosity", self.viscosity, "m²/s")?;
        ReducedError::check_positive("domain_length", self.domain_length, "m")?;
        ReducedError::check_not_negative("force_factor", self.force_factor, "kg/m")?;
        self.joint.check().map_err(ReducedError::Joint)
    }

    /// The block's acceleration X'' under spring, damper and the traction τ, in m/s².
    pub(crate) fn acceleration(&self, body: Motion, traction: f64) -> f64 {
        self.joint.acceleration(body.position, body.velocity, -self.force_factor * traction)
    }

    /// Positions in m, inside of the domain, between which the undamped block would swing by itself.
    pub(crate) fn reach(&self, start: &PistonStart) -> (f64, f64) {
        let Prismatic { mass, stiffness, rest_length, .. } = self.joint;
        if stiffness == 0.0 {
            return (start.position, start.position);
        }
        let swing =
            (start.position - rest_length).hypot(start.velocity * (mass / stiffness).sqrt());
        let inside = |x: f64| x.clamp(0.0, self.domain_length);
        (inside(rest_length - swing), inside(rest_length + swing))
    }

    /// Largest norm in L2 of `(v, X')` on the domain of `basis` that the energy of the start accounts
    /// for: the fluid is nowhere faster than at the start or at the block.
    pub(crate) fn largest_norm(&self, start: &PistonStart, basis: &Basis) -> f64 {
        let (joint, extent) = (&self.joint, basis.extent());
        let flow = basis.mean_norm() + norm(&start.coefficients);
        let of_flow = 0.5 * self.force_factor * flow * flow * self.domain_length / extent;
        let energy = joint.energy(start.position, start.velocity) + of_flow;
        let block = (2.0 * energy / joint.mass).sqrt();
        flow + block * (2.0 * extent).sqrt()
    }
}

impl PistonStart {
    pub(crate) fn validate(
        &self,
        modes: usize,
        physics: &PistonPhysics,
    ) -> Result<(), ReducedError> {
        let (found, what) = (self.coefficients.len(), "initial coefficients");
        if found != modes {
            return Err(ReducedError::Count { what, found, expected: modes });
        }
        let bad = self.coefficients.iter().position(|a| !a.is_finite());
        if let Some(node) = bad {
            let value = self.coefficients[node];
            return Err(ReducedError::NotFinite { what: "an initial coefficient", node, value });
        }
        if !(self.position > 0.0 && self.position < physics.domain_length) {
            let (name, expected) = ("initial_position", "inside of (0, domain_length)");
            return Err(ReducedError::Parameter {
                name,
                value: self.position,
                unit: "m",
                expected,
            });
        }
        if !self.velocity.is_finite() {
            let (name, value) = ("initial_velocity", self.velocity);
            return Err(ReducedError::Parameter { name, value, unit: "m/s", expected: "finite" });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumley_fem::UniformGrid;

    /// The largest norm of the same piston when its lengths are counted in units of `1/c` m.
    fn norms(c: f64) -> [f64; 2] {
        let joint = Prismatic { mass: 0.5, stiffness: 39.5, damping: 0.1, rest_length: 0.95 * c };
        let domain_length = 1.1 * c;
        let physics =
            PistonPhysics { viscosity: 0.2 * c * c, force_factor: 0.7 / c, domain_length, joint };
        let constant = faer::Mat::from_fn(3, 1, |_, _| domain_length.sqrt().recip());
        let grid = UniformGrid::line(0.0, domain_length, 3);
        let fixed = Basis::on_grid(&grid, constant.as_ref(), None).expect("a constant");
        let bubble = faer::mat![[0.0], [30_f64.sqrt() / 4.0], [0.0]];
        let moving = Basis::on_reference(&[0.0, 0.5, 1.0], 2, bubble.as_ref(), None);
        let start = |coefficient| PistonStart {
            coefficients: vec![coefficient],
            position: 0.9 * c,
            velocity: 0.3 * c,
        };
        [
            physics.largest_norm(&start(0.2 * c.powf(1.5)), &fixed),
            physics.largest_norm(&start(0.2 * c), &moving.expect("homogeneous")),
        ]
    }

    /// A norm in m^(3/2)/s on the grid, in m/s in the reference frame, whatever the unit of length.
    #[test]
    fn largest_norm_knows_no_unit() {
        let ([grid, reference], [grid_mm, reference_mm]) = (norms(1.0), norms(1000.0));
        assert!((grid_mm / (grid * 1000_f64.powf(1.5)) - 1.0).abs() < 1e-12, "{grid} {grid_mm}");
        assert!((reference_mm / (reference * 1e3) - 1.0).abs() < 1e-12, "{reference}");
    }
}
