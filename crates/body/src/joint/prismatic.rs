use super::JointError;
use serde::{Deserialize, Serialize};

/// A mass that slides along one axis on a spring and a damper: the block of the piston, paper eq. (34).
///
/// ```text
/// m X'' = f(X, X') + F,   f(X, X') = -K (X - x0) - b X'
/// ```
///
/// with the load `F` from the fluid. Mass, force and the force's derivatives are all that Newton's
/// method of the full-order model and the multiplier of the reduced model need.
///
/// ```
/// use lumley_body::joint::Prismatic;
/// let block = Prismatic { mass: 0.5, stiffness: 39.5, damping: 0.1, rest_length: 0.95 };
/// assert!((block.force(0.9, 0.0) - 39.5 * 0.05).abs() < 1e-12);
/// assert!((block.acceleration(0.9, 0.0, 0.0) - 3.95).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Prismatic {
    /// Mass m of the block, in kg.
    pub mass: f64,
    /// Spring stiffness K, in N/m.
    pub stiffness: f64,
    /// Damping constant b, in N s/m.
    pub damping: f64,
    /// Position x0 at which the spring is slack, in m.
    pub rest_length: f64,
}

impl Prismatic {
    /// Whether every constant is physical: a positive mass, a spring and a damper that give no energy,
    /// and any finite rest position.
    ///
    /// # Errors
    /// The first one that is not, with its value.
    pub fn check(&self) -> Result<(), JointError> {
        let Self { mass, stiffness, damping, rest_length } = *self;
        let not_negative = "0 or a finite number above";
        let checks = [
            (mass > 0.0, "mass", mass, "kg", "a finite number above 0"),
            (stiffness >= 0.0, "stiffness", stiffness, "N/m", not_negative),
            (damping >= 0.0, "damping", damping, "N s/m", not_negative),
            (true, "rest length", rest_length, "m", "a finite number"),
        ];
        let bad =
            checks.into_iter().find(|(in_range, _, value, ..)| !(*in_range && value.is_finite()));
        bad.map_or(Ok(()), |(_, name, value, unit, expected)| {
            Err(JointError::Quantity { name, value, unit, expected })
        })
    }

    /// Force of spring and damper at position `x` in m and velocity `v` in m/s, in N.
    pub fn force(&self, x: f64, v: f64) -> f64 {
        -self.stiffness * (x - self.rest_length) - self.damping * v
    }

    /// Derivative of [`force`](Self::force) by the position, in N/m.
    pub fn force_by_position(&self) -> f64 {
        -self.stiffness
    }

    /// Derivative of [`force`](Self::force) by the velocity, in N s/m.
    pub fn force_by_velocity(&self) -> f64 {
        -self.damping
    }

    /// Acceleration under spring, damper and the load `load` in N, in m/s².
    pub fn acceleration(&self, x: f64, v: f64, load: f64) -> f64 {
        (self.force(x, v) + load) / self.mass
    }

    /// Kinetic and elastic energy, in J: `m v²/2 + K (x - x0)²/2`.
    pub fn energy(&self, x: f64, v: f64) -> f64 {
        let stretch = x - self.rest_length;
        0.5 * (self.mass * v * v + self.stiffness * stretch * stretch)
    }

    /// The exact free motion (no load) from `(x, v)` after a time `t` in s: position in m and
    /// velocity in m/s of the damped oscillator, under-, over- or critically damped.
    pub fn free_motion(&self, x: f64, v: f64, t: f64) -> (f64, f64) {
        let y = x - self.rest_length;
        let decay = self.damping / (2.0 * self.mass);
        let square = self.stiffness / self.mass - decay * decay;
        // c(t) and s(t): cosine and sine over frequency, continued through critical damping.
        let (c, s) = if square > 0.0 {
            let w = square.sqrt();
            ((w * t).cos(), (w * t).sin() / w)
        } else if square < 0.0 {
            let w = (-square).sqrt();
            ((w * t).cosh(), (w * t).sinh() / w)
        } else {
            (1.0, t)
        };
        let e = (-decay * t).exp();
        let slope = v + decay * y;
        let position = e * (y * c + slope * s);
        let velocity = e * (-square * y * s + slope * c) - decay * position;
        (self.rest_length + position, velocity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(damping: f64) -> Prismatic {
        Prismatic { mass: 0.5, stiffness: 2.0, damping, rest_length: 0.3 }
    }

    /// Residual of m x'' = f by central differences of the closed form, for each kind of damping.
    #[test]
    fn free_motion_satisfies_the_equation_of_motion() {
        for damping in [0.0, 0.1, 2.0, 5.0] {
            let joint = block(damping);
            let h = 1e-4;
            for t in [0.2, 1.0, 3.0] {
                let at = |t| joint.free_motion(0.9, -0.4, t);
                let (x, v) = at(t);
                let by_difference = (at(t + h).0 - at(t - h).0) / (2.0 * h);
                assert!((v - by_difference).abs() < 1e-7, "b = {damping}: {v} and {by_difference}");
                let a = (at(t + h).1 - at(t - h).1) / (2.0 * h);
                assert!((a - joint.acceleration(x, v, 0.0)).abs() < 1e-7, "b = {damping}, t = {t}");
            }
            let (x, v) = joint.free_motion(0.9, -0.4, 0.0);
            // x − x0 + x0 is x to a unit in the last place.
            assert!((x - 0.9).abs() <= f64::EPSILON && (v + 0.4).abs() <= f64::EPSILON, "{x} {v}");
        }
    }

    #[test]
    fn constants_out_of_range_are_named() {
        let refusal = |change: fn(&mut Prismatic, f64), value| {
            let mut joint = block(0.1);
            change(&mut joint, value);
            joint.check().map_err(|error| error.to_string())
        };
        for bad in [f64::NAN, f64::INFINITY, -1.0] {
            let found = [
                (refusal(|j, v| j.mass = v, bad), "mass"),
                (refusal(|j, v| j.stiffness = v, bad), "stiffness"),
                (refusal(|j, v| j.damping = v, bad), "damping"),
            ];
            for (refusal, name) in found {
                let message = refusal.expect_err("out of range");
                assert!(message.starts_with(&format!("{name} is {bad} ")), "{message}");
            }
        }
        assert!(refusal(|j, v| j.mass = v, 0.0).is_err());
        let length = |value| refusal(|j, v| j.rest_length = v, value);
        assert!(length(f64::NAN).is_err() && length(f64::INFINITY).is_err());
        // A slack spring may want to be behind the wall.
        assert_eq!(length(-0.2), Ok(()));
        assert_eq!(block(0.0).check(), Ok(()));
    }

    #[test]
    fn energy_is_kept_without_damping_and_lost_with_it() {
        for (damping, kept) in [(0.0, true), (0.2, false)] {
            let joint = block(damping);
            let (x, v) = joint.free_motion(0.9, 0.0, 2.0);
            let lost = joint.energy(0.9, 0.0) - joint.energy(x, v);
            assert_eq!(lost.abs() < 1e-12, kept, "lost {lost} J");
            assert!(lost > -1e-12);
        }
    }
}
