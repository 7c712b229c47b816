use super::Closure;
use crate::ReducedError;
use serde::{Deserialize, Serialize};

/// Eddy viscosity that grows with the mode index, paper section 4.3: `ν_i = ν (1 + c i)`.
///
/// Drains the energy that the truncated modes would have taken (Aubry 1988, Podvin 2001). Scaling
/// the rows of a symmetric viscous matrix need not keep it dissipative unless it is diagonal.
///
/// ```
/// use lumley_rom::EddyViscosity;
/// assert_eq!(EddyViscosity::default().rate, 0.001);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct EddyViscosity {
    /// c, dimensionless, per mode index counted from 1; the paper uses 0.001.
    pub rate: f64,
}

impl Default for EddyViscosity {
    fn default() -> Self {
        Self { rate: 0.001 }
    }
}

impl EddyViscosity {
    pub(crate) fn validate(self) -> Result<(), ReducedError> {
        ReducedError::check_not_negative("closure.rate", self.rate, "per mode index")
    }
}

impl Closure for EddyViscosity {
    fn correct(&self, viscous: &mut [f64]) {
        for (i, drain) in viscous.iter_mut().enumerate() {
            *drain *= 1.0 + self.rate * (i + 1) as f64;
        }
    }
}
