use super::{MotionError, Stiffness};
use serde::{Deserialize, Serialize};

/// How the mesh follows the boundaries that move.
///
/// ```
/// use lumley_fom::motion::{MotionParameters, Stiffness};
/// let paper: MotionParameters = toml::from_str("stiffness = { kind = 'uniform' }")?;
/// assert_eq!(paper, MotionParameters { stiffness: Stiffness::Uniform {}, rigid_zone: 0.0 });
/// assert!(toml::from_str::<MotionParameters>("rigid_zon = 0.1").is_err());
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MotionParameters {
    /// Where the mesh deforms less.
    pub stiffness: Stiffness,
    /// Cells with a node closer than this to a moving boundary move rigidly with it, in m: boundary layers keep
    /// their shape.
    pub rigid_zone: f64,
}

impl MotionParameters {
    /// Whether every quantity is in its range.
    ///
    /// # Errors
    /// The [`MotionError::Quantity`] that names the quantity.
    pub fn check(&self) -> Result<(), MotionError> {
        self.stiffness.check()?;
        let zone = self.rigid_zone;
        let ok = zone.is_finite() && zone >= 0.0;
        let expected = "0 or a finite number above";
        MotionError::require(ok, "rigid zone", zone, "m", expected)
    }
}
