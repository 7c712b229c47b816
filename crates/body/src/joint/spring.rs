use serde::{Deserialize, Serialize};

/// A linear spring and damper on one coordinate of a joint: `f = −stiffness (q − rest) − damping q'`.
///
/// The coordinate of a joint that turns is measured against the body that it is hinged to.
///
/// ```
/// use lumley_body::joint::Spring;
/// let spring: Spring = toml::from_str("stiffness = 2.37")?;
/// assert_eq!(spring, Spring { stiffness: 2.37, rest: 0.0, damping: 0.0 });
/// assert_eq!(spring.force(-1.0, 5.0), 2.37);
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Spring {
    /// In N/m for each m of span, or N m/rad for each m of span.
    pub stiffness: f64,
    /// Value of the coordinate at which the spring is slack, in m or rad.
    pub rest: f64,
    /// In N s/m or N m s/rad, for each m of span.
    pub damping: f64,
}

impl Spring {
    /// Force or moment on the coordinate, in N/m or N.
    pub fn force(&self, position: f64, velocity: f64) -> f64 {
        -self.stiffness * (position - self.rest) - self.damping * velocity
    }

    /// The sum of the magnitudes of what the force is the sum of.
    pub(crate) fn magnitude(&self, position: f64, velocity: f64) -> f64 {
        self.stiffness * (position.abs() + self.rest.abs()) + self.damping * velocity.abs()
    }

    /// Energy in the spring, in J/m.
    pub fn energy(&self, position: f64) -> f64 {
        0.5 * self.stiffness * (position - self.rest).powi(2)
    }
}
