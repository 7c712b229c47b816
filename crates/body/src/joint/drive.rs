use super::Table;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error, MapAccess, Visitor};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::sync::Arc;

/// How a prescribed coordinate goes with the time in s: a number, a formula or a table in a case file.
///
/// This crate reads no formulas: who knows their language puts a [`Function`](Self::Function) in their place.
///
/// ```
/// use lumley_body::joint::{Drive, TimeFunction};
/// #[derive(serde::Deserialize)]
/// struct Case { y: Drive }
/// let case: Case = toml::from_str("y = '0.2 * sin(t)'")?;
/// assert_eq!(case.y, Drive::Formula("0.2 * sin(t)".into()));
/// assert!(case.y.function().is_err());
/// let heave = Drive::Function(TimeFunction::new(|t: f64| 0.2 * t.sin()));
/// assert_eq!(heave.function().expect("a function").at(0.0), 0.0);
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Drive {
    /// It stays there, in m or rad.
    Constant(f64),
    /// A formula of t.
    Formula(String),
    /// Between values at times.
    Table(Table),
    /// A function of the time.
    #[serde(skip)]
    Function(TimeFunction),
}

impl Default for Drive {
    fn default() -> Self {
        Self::Constant(0.0)
    }
}

impl Drive {
    /// The function of time.
    ///
    /// # Errors
    /// The formula that it is instead.
    pub fn function(&self) -> Result<TimeFunction, &str> {
        match self {
            Self::Constant(value) => {
                let value = *value;
                Ok(TimeFunction::new(move |_| value))
            }
            Self::Formula(formula) => Err(formula),
            Self::Table(table) => {
                let table = table.clone();
                Ok(TimeFunction::new(move |time| table.at(time)))
            }
            Self::Function(function) => Ok(function.clone()),
        }
    }
}

/// A function of the time in s.
///
/// ```
/// use lumley_body::joint::TimeFunction;
/// let ramp = TimeFunction::new(|t| 2.0 * t);
/// assert_eq!(ramp.at(1.5), 3.0);
/// assert!((ramp.slope(1.5) - 2.0).abs() < 1e-9);
/// ```
#[derive(Clone)]
pub struct TimeFunction(Arc<dyn Fn(f64) -> f64 + Send + Sync>);

/// Step of the difference that gives the slope, in s.
const DIFFERENCE: f64 = 1e-5;

impl TimeFunction {
    /// The function `f`.
    pub fn new(f: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Self(Arc::new(f))
    }

    /// Its value at a time in s.
    pub fn at(&self, time: f64) -> f64 {
        (self.0)(time)
    }

    /// Its slope just after a time in s, by the parabola through three values.
    pub fn slope(&self, time: f64) -> f64 {
        let value = |k: f64| self.at(time + k * DIFFERENCE);
        (4.0 * value(1.0) - 3.0 * value(0.0) - value(2.0)) / (2.0 * DIFFERENCE)
    }
}

impl fmt::Debug for TimeFunction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a function of time")
    }
}

impl PartialEq for TimeFunction {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl<'de> Deserialize<'de> for Drive {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(DriveVisitor)
    }
}

/// Says what was expected, which an untagged enum cannot.
struct DriveVisitor;

impl<'de> Visitor<'de> for DriveVisitor {
    type Value = Drive;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, a formula of t, or a table { times = [...], values = [...] }")
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Drive, E> {
        Ok(Drive::Constant(value))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Drive, E> {
        Ok(Drive::Constant(value as f64))
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Drive, E> {
        Ok(Drive::Constant(value as f64))
    }

    fn visit_str<E: Error>(self, formula: &str) -> Result<Drive, E> {
        Ok(Drive::Formula(formula.to_owned()))
    }

    fn visit_map<M: MapAccess<'de>>(self, map: M) -> Result<Drive, M::Error> {
        Table::deserialize(MapAccessDeserializer::new(map)).map(Drive::Table)
    }
}
