use super::instant::{Instant, Variation};
use super::magnitude::{larger, largest_magnitude};
use super::{Piston, PistonError};
use crate::linear::BorderRow;

/// Newton's method gives up after this many iterations; from an extrapolated start it takes one or two.
const MOST_ITERATIONS: usize = 12;

/// Wanted residual, relative to the largest velocity.
const TOLERANCE: f64 = 1e-10;

/// How a step of time went.
///
/// ```
/// let step = lumley_fom::PistonStep { iterations: 1, residual: 1e-14 };
/// assert!(step.residual < 1e-10);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PistonStep {
    /// Newton iterations, each one linear solve.
    pub iterations: usize,
    /// Largest residual after the last of them, as a change of velocity over the step, in m/s.
    pub residual: f64,
}

impl Piston {
    /// Newton-Raphson on all equations in (u, X) at once, for the trial instant.
    pub(super) fn solve(&mut self, variation: Variation) -> Result<PistonStep, PistonError> {
        let mut residuals = [0.0; MOST_ITERATIONS];
        let time = self.trial.time;
        self.evaluate();
        for iterations in 1..=MOST_ITERATIONS {
            self.iterate(variation);
            self.evaluate();
            let (residual, tolerance) = (self.residual(variation), self.tolerance(variation));
            if !(residual.is_finite() && tolerance.is_finite()) {
                return Err(PistonError::NonFinite { time });
            }
            if residual <= tolerance {
                self.check_interface()?;
                return Ok(PistonStep { iterations, residual });
            }
            residuals[iterations - 1] = residual;
        }
        let (residuals, tolerance) = (residuals.to_vec(), self.tolerance(variation));
        Err(PistonError::NotConverged { time, residuals, tolerance })
    }

    /// Evaluates the equations of the fluid.
    pub(super) fn evaluate(&mut self) {
        self.fluid.evaluate(&self.trial);
        if let Some(forcing) = &self.forcing {
            self.fluid.subtract(forcing.as_ref(), self.trial.time);
        }
    }

    /// One Newton iteration from the residual as evaluated.
    pub(super) fn iterate(&mut self, variation: Variation) {
        let cell = self.fluid.linearise(&self.trial, variation);
        let block = self.block_row(cell.vertex[1], cell.border[1], variation);
        self.fluid.correct(&mut self.trial, variation, block);
    }

    /// Traction `nu u_x(X−)` as the residual of the fluid at the interface, in m²/s².
    pub(super) fn consistent_traction(&self) -> f64 {
        self.trial.interface * self.fluid.interface_residual()
    }

    /// `m V' − f(X, V) + c_F nu u_x(X−)` less the source, paper eq. (34), in N.
    fn block_residual(&self) -> f64 {
        let Instant { time, interface, .. } = self.trial;
        let joint = &self.parameters.joint;
        let source = self.forcing.as_ref().map_or(0.0, |forcing| forcing.body(time));
        let (velocity, acceleration) = (self.trial.velocity(), self.trial.acceleration());
        joint.mass * acceleration - joint.force(interface, velocity) - source
            + self.parameters.force_factor * self.consistent_traction()
    }

    /// The row of V from the row of the interface node: its entries at the last vertex and at V.
    fn block_row(&self, [neighbour, at_v]: [f64; 2], border: f64, by: Variation) -> BorderRow {
        let joint = &self.parameters.joint;
        let factor = self.parameters.force_factor;
        let x = self.trial.interface;
        let traction_by_v = x * (at_v + border) + by.position() * self.fluid.interface_residual();
        BorderRow {
            neighbour: factor * x * neighbour,
            diagonal: by.rate * joint.mass
                - by.state * joint.force_by_velocity()
                - by.position() * joint.force_by_position()
                + factor * traction_by_v,
            residual: self.block_residual(),
        }
    }

    /// Largest residual, divided by mass and rate: the change of velocity that would answer it.
    fn residual(&self, by: Variation) -> f64 {
        let (mass, _) = self.fluid.scales(self.trial.interface);
        let fluid = self.fluid.largest_residual() / (by.rate * mass);
        let block = self.block_residual().abs() / (by.rate * self.parameters.joint.mass);
        larger(fluid, block)
    }

    /// The residual that is good enough, in m/s, but never below what rounding leaves: a few units in
    /// the last place of the largest terms of the equations.
    fn tolerance(&self, by: Variation) -> f64 {
        let speed = largest_magnitude(&self.trial.u, |u| *u);
        let (mass, viscous) = self.fluid.scales(self.trial.interface);
        let fluid = speed * (1.0 + viscous / (by.rate * mass));
        let x = self.trial.interface;
        let joint = &self.parameters.joint;
        let traction = self.parameters.force_factor * x * by.rate * mass * fluid;
        let spring = joint.stiffness * (x.abs() + joint.rest_length.abs());
        let block = (traction + spring) / (by.rate * joint.mass);
        TOLERANCE * speed + 8.0 * f64::EPSILON * (fluid + block)
    }

    fn check_interface(&self) -> Result<(), PistonError> {
        let Instant { time, interface: position, .. } = self.trial;
        let domain_length = self.parameters.domain_length;
        if !(position > 0.0 && position < domain_length) {
            return Err(PistonError::InterfaceLeft { time, position, domain_length });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{InitialFlow, PistonParameters, TimeScheme};
    use lumley_body::joint::Prismatic;

    /// Only the exact derivative squares the residual; each term of it matters in this long step.
    #[test]
    fn convergence_is_quadratic() -> Result<(), PistonError> {
        let parameters = PistonParameters {
            viscosity: 0.05,
            domain_length: 2.0,
            force_factor: 3.0,
            joint: Prismatic { mass: 0.5, stiffness: 20.0, damping: 0.4, rest_length: 0.7 },
            initial_position: 0.9,
            initial_velocity: 0.5,
            initial_flow: InitialFlow::Sine(0.4),
        };
        for degree in [1, 2] {
            let mut piston = Piston::new(&parameters, 12, degree, TimeScheme::ImplicitEuler)?;
            let variation = piston.predict(0.05);
            let mut residuals = Vec::new();
            piston.evaluate();
            for _ in 0..4 {
                residuals.push(piston.residual(variation));
                piston.iterate(variation);
                piston.evaluate();
            }
            let order = |k: usize| {
                let gain = |k: usize| (residuals[k + 1] / residuals[k]).ln();
                gain(k + 1) / gain(k)
            };
            assert!(order(1) > 1.8, "degree {degree}: {residuals:?}");
        }
        Ok(())
    }
}
