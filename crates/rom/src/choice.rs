use crate::closure::ClosureKind;
use crate::{ProjectionKind, ReducedError};
use serde::de::value::{MapAccessDeserializer, MapDeserializer};
use serde::de::{Deserializer, MapAccess, Visitor};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::marker::PhantomData;

/// Which reduced model to build: one table of a case file.
///
/// ```
/// use lumley_rom::{ClosureKind, EddyViscosity, ModelChoice, Multiplier, ProjectionKind};
/// let table = r#"
///     projection = "multiplier"
///     beta = 20.0
///     closure = { kind = "eddy-viscosity", rate = 0.002 }
/// "#;
/// let model: ModelChoice = toml::from_str(table)?;
/// assert_eq!(model.projection, ProjectionKind::Multiplier(Multiplier { beta: 20.0 }));
/// assert_eq!(model.closure, ClosureKind::EddyViscosity(EddyViscosity { rate: 0.002 }));
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ModelChoice {
    /// The equations: frame and interface condition, under the key `projection`, with their
    /// parameter `beta` or `sigma`.
    #[serde(flatten)]
    pub projection: ProjectionKind,
    /// What stands for the truncated modes: a name or a table.
    #[serde(default)]
    pub closure: ClosureKind,
}

impl ModelChoice {
    /// Checks every parameter.
    ///
    /// # Errors
    /// The first parameter that is not positive and finite.
    pub fn validate(&self) -> Result<(), ReducedError> {
        self.projection.validate()?;
        self.closure.validate()
    }
}

/// Reads an enum tagged by `kind` from a table, or from the bare name when every other key has a
/// default.
pub(crate) fn name_or_table<'de, D, T>(from: D) -> Result<T, D::Error>
where
    D: Deserializer<'de>,
    T: FromTable,
{
    from.deserialize_any(NameOrTable(PhantomData))
}

/// An enum whose derived deserialiser reads the table form.
pub(crate) trait FromTable: Sized {
    fn from_table<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error>;
}

struct NameOrTable<T>(PhantomData<T>);

impl<'de, T: FromTable> Visitor<'de> for NameOrTable<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a name or a table with the key `kind`")
    }

    fn visit_str<E: serde::de::Error>(self, name: &str) -> Result<T, E> {
        T::from_table(MapDeserializer::new([("kind", name)].into_iter()))
    }

    fn visit_map<A: MapAccess<'de>>(self, table: A) -> Result<T, A::Error> {
        T::from_table(MapAccessDeserializer::new(table))
    }
}
