//! Time integration of small systems of ordinary differential equations, without allocation.

mod lu;
mod rk4;
mod rosenbrock;
mod stability;

pub(crate) use rk4::Rk4;
pub use rosenbrock::Rosenbrock;
pub(crate) use stability::stable_step;

use crate::choice::{FromTable, name_or_table};
use crate::{Divergence, ReducedError};
use rosenbrock::Rodas4;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// An autonomous system `y' = f(y)`.
pub(crate) trait System {
    /// Writes `f(y)` to `rates`.
    fn rates(&mut self, y: &[f64], rates: &mut [f64]);
}

/// A method that moves a system in time. It owns its work space.
pub(crate) trait Stepper: Send + Sync {
    /// Moves `y` by `dt`. `rates` is `f(y)` before and after.
    ///
    /// # Errors
    /// Error control that accepts no step, or too many; `y` is then worthless.
    fn step(
        &mut self,
        system: &mut dyn System,
        y: &mut [f64],
        rates: &mut [f64],
        dt: f64,
    ) -> Result<(), Divergence>;

    /// The step in s that error control would take next; zero before the first one.
    fn suggestion(&self) -> f64 {
        0.0
    }

    /// Takes up a suggestion from a checkpoint.
    fn resume(&mut self, _suggestion: f64) {}

    /// Whether the method is explicit, so that [`stable_step`] bounds its step.
    fn is_explicit(&self) -> bool;
}

/// The integrators of a case file: `"rk4"`, `"rosenbrock"`, or a table with `kind` and parameters.
///
/// ```
/// use lumley_rom::{Integrator, Rosenbrock};
/// # #[derive(serde::Deserialize)] struct Rom { integrator: Integrator }
/// let rom: Rom = toml::from_str("integrator = { kind = 'rosenbrock', tolerance = 1e-6 }")?;
/// assert_eq!(rom.integrator, Integrator::Rosenbrock(Rosenbrock { tolerance: 1e-6 }));
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(remote = "Self", tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Integrator {
    /// The classical explicit Runge-Kutta method of order 4, stable up to
    /// [`ReducedPiston::stable_step`](crate::ReducedPiston::stable_step).
    Rk4 {},
    /// Adaptive and L-stable, for stiff systems.
    Rosenbrock(Rosenbrock),
}

impl Integrator {
    /// Checks every parameter.
    ///
    /// # Errors
    /// A tolerance out of its range, with its value.
    pub fn validate(&self) -> Result<(), ReducedError> {
        match self {
            Self::Rk4 {} => Ok(()),
            Self::Rosenbrock(method) => method.validate(),
        }
    }

    /// Work space for a system of `size` unknowns.
    pub(crate) fn stepper(&self, size: usize) -> Box<dyn Stepper> {
        match self {
            Self::Rk4 {} => Box::new(Rk4::new(size)),
            Self::Rosenbrock(method) => Box::new(Rodas4::new(size, method.tolerance)),
        }
    }
}

impl Default for Integrator {
    fn default() -> Self {
        Self::Rk4 {}
    }
}

impl FromTable for Integrator {
    fn from_table<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        Self::deserialize(from)
    }
}

impl<'de> Deserialize<'de> for Integrator {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        name_or_table(from)
    }
}

impl Serialize for Integrator {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        Self::serialize(self, to)
    }
}

/// `out = y + factor * direction`.
fn offset(y: &[f64], factor: f64, direction: &[f64], out: &mut [f64]) {
    for ((o, y), d) in out.iter_mut().zip(y).zip(direction) {
        *o = y + factor * d;
    }
}

#[cfg(test)]
mod tests;
