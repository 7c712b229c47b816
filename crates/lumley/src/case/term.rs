use super::CaseError;
use super::ask::Ask;
use super::formula::{Formula, Variables};
use lumley_fem::Point;
use serde::de::{Deserialize, Deserializer, Error, Visitor};
use serde::{Serialize, Serializer};
use std::fmt;

/// A number or a formula in a case file.
///
/// ```
/// use lumley::case::Term;
/// #[derive(serde::Deserialize)]
/// struct Section { velocity: [Term; 2] }
/// let section: Section = toml::from_str("velocity = ['1 - y^2', 0]")?;
/// assert_eq!(section.velocity, [Term::Formula("1 - y^2".into()), Term::Number(0.0)]);
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Term {
    /// A constant.
    Number(f64),
    /// A formula, not read yet.
    Formula(String),
}

impl fmt::Display for Term {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(value) => write!(f, "{value:?}"),
            Self::Formula(text) => write!(f, "\"{text}\""),
        }
    }
}

impl Serialize for Term {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Number(value) => serializer.serialize_f64(*value),
            Self::Formula(text) => serializer.serialize_str(text),
        }
    }
}

impl<'de> Deserialize<'de> for Term {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Either;
        impl Visitor<'_> for Either {
            type Value = Term;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number or a formula such as \"1 - y^2\"")
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<Term, E> {
                Ok(Term::Number(value))
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<Term, E> {
                Ok(Term::Number(value as f64))
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<Term, E> {
                Ok(Term::Formula(text.to_owned()))
            }
        }
        deserializer.deserialize_any(Either)
    }
}

/// A term that has been read.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Scalar {
    /// A constant.
    Number(f64),
    /// A formula.
    Formula(Formula),
}

impl Scalar {
    /// Reads a term of `key`; a constant has a unit.
    pub fn read(
        ask: &Ask,
        key: &str,
        term: &Term,
        variables: Variables,
        unit: &str,
    ) -> Result<Self, CaseError> {
        match term {
            Term::Number(value) => {
                ask.finite(key, *value, unit)?;
                Ok(Self::Number(*value))
            }
            Term::Formula(text) => Formula::read(text, variables)
                .map(Self::Formula)
                .map_err(|e| ask.refuse(key, term, &e.to_string())),
        }
    }

    /// Its value at a point in m and a time in s.
    pub fn value(&self, at: Point, time: f64) -> f64 {
        match self {
            Self::Number(value) => *value,
            Self::Formula(formula) => formula.value(at, time),
        }
    }

    /// Whether it may change with time.
    pub fn uses_time(&self) -> bool {
        matches!(self, Self::Formula(formula) if formula.uses_time())
    }
}
