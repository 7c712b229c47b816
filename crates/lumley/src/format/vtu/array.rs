use lumley_fem::Point;
use std::io::{self, Write};

/// The values of a field: one for each point or for each cell.
///
/// ```
/// use lumley::format::vtu::Values;
/// let velocity = [[1.0, 0.0], [0.5, 0.1]];
/// assert_eq!(Values::Vectors(&velocity).len(), 2);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Values<'a> {
    /// Numbers.
    Scalars(&'a [f64]),
    /// Vectors of the plane; in the file they get a third component of zero, as VTK wants it.
    Vectors(&'a [Point]),
}

impl Values<'_> {
    /// How many there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Scalars(values) => values.len(),
            Self::Vectors(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Place and value of the first number that is not finite.
    pub(super) fn not_finite(&self) -> Option<(usize, f64)> {
        let bad = |value: &&f64| !value.is_finite();
        match self {
            Self::Scalars(values) => values.iter().enumerate().find(|(_, v)| bad(v)),
            Self::Vectors(values) => {
                values.iter().enumerate().find_map(|(k, v)| Some((k, v.iter().find(bad)?)))
            }
        }
        .map(|(place, value)| (place, *value))
    }

    fn components(&self) -> usize {
        match self {
            Self::Scalars(_) => 1,
            Self::Vectors(_) => 3,
        }
    }
}

/// An array of the appended data.
pub(super) enum Array<'a> {
    /// Numbers of a frame.
    Numbers(&'a str, Values<'a>),
    /// What does not change: name, VTK's type and the bytes.
    Constant(&'static str, &'static str, &'a [u8]),
}

impl Array<'_> {
    /// Its tag, with the place of its data, counted from the beginning of the appended data.
    pub fn declare(&self, offset: usize, out: &mut impl Write) -> io::Result<()> {
        let (name, kind, components) = match self {
            Self::Numbers(name, values) => (*name, "Float64", values.components()),
            Self::Constant(name, kind, _) => (*name, *kind, 1),
        };
        writeln!(
            out,
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" \
             format=\"appended\" offset=\"{offset}\"/>"
        )
    }

    /// Bytes in the appended data: their count comes first.
    pub fn size(&self) -> usize {
        size_of::<u64>() + self.bytes()
    }

    fn bytes(&self) -> usize {
        match self {
            Self::Numbers(_, values) => values.len() * values.components() * size_of::<f64>(),
            Self::Constant(_, _, bytes) => bytes.len(),
        }
    }

    /// Its part of the appended data.
    pub fn append(&self, out: &mut impl Write) -> io::Result<()> {
        out.write_all(&(self.bytes() as u64).to_le_bytes())?;
        let mut number = |value: &f64| out.write_all(&value.to_le_bytes());
        match self {
            Self::Numbers(_, Values::Scalars(values)) => values.iter().try_for_each(number),
            Self::Numbers(_, Values::Vectors(values)) => values
                .iter()
                .try_for_each(|[x, y]| [x, y, &0.0].into_iter().try_for_each(&mut number)),
            Self::Constant(_, _, bytes) => out.write_all(bytes),
        }
    }
}
