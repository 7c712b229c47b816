//! Closures: what the truncated modes would have done to the kept ones.

mod eddy_viscosity;

pub use eddy_viscosity::EddyViscosity;

use crate::ReducedError;
use crate::choice::{FromTable, name_or_table};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A model of the truncated modes, applied where the viscous term stands in each equation.
pub(crate) trait Closure {
    /// Corrects `viscous`, the viscous term of each of the N equations.
    fn correct(&self, viscous: &mut [f64]);
}

/// The closures of a case file: `"none"`, `"eddy-viscosity"`, or a table with `kind` and parameters.
///
/// ```
/// use lumley_rom::ClosureKind;
/// assert_eq!(ClosureKind::default(), ClosureKind::None {});
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(remote = "Self", tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum ClosureKind {
    /// The truncated modes are ignored.
    None {},
    /// Viscosity grows with the mode index.
    EddyViscosity(EddyViscosity),
}

impl ClosureKind {
    /// The name in a case file.
    pub fn name(&self) -> &'static str {
        match self {
            Self::None {} => "none",
            Self::EddyViscosity(_) => "eddy-viscosity",
        }
    }

    pub(crate) fn validate(&self) -> Result<(), ReducedError> {
        match self {
            Self::None {} => Ok(()),
            Self::EddyViscosity(closure) => closure.validate(),
        }
    }
}

impl Closure for ClosureKind {
    fn correct(&self, viscous: &mut [f64]) {
        match self {
            Self::None {} => {}
            Self::EddyViscosity(closure) => closure.correct(viscous),
        }
    }
}

impl Default for ClosureKind {
    fn default() -> Self {
        Self::None {}
    }
}

impl FromTable for ClosureKind {
    fn from_table<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        Self::deserialize(from)
    }
}

impl<'de> Deserialize<'de> for ClosureKind {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        name_or_table(from)
    }
}

impl Serialize for ClosureKind {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        Self::serialize(self, to)
    }
}
