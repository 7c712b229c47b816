use super::RecordError;
use super::error::printable;
use lumley_fem::{Point, UniformGrid};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// What a record holds besides the times: fields in frames, short series, and where they come from.
///
/// ```
/// use lumley::record::{Description, FrameDescription, Quantity, SeriesDescription, Support};
/// let x = Quantity::new("X", "m");
/// let description = Description {
///     frames: vec![FrameDescription {
///         name: "fixed".into(),
///         support: Support::Grid(lumley_fem::UniformGrid::line(0.0, 1.1, 401)),
///         length_unit: "m".into(),
///         components: vec![Quantity::new("u", "m/s")],
///     }],
///     series: vec![SeriesDescription { name: "position".into(), entries: vec![x] }],
///     provenance: [("program".into(), "lumley".into())].into(),
///     gathered: None,
/// };
/// assert_eq!(description.frames[0].rows(), 401);
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Description {
    /// The frames in which the fields are recorded, at least one.
    pub frames: Vec<FrameDescription>,
    /// Short vectors recorded with each snapshot: generalised positions and velocities, loads.
    pub series: Vec<SeriesDescription>,
    /// Where the record comes from: program, version, case, ...
    pub provenance: BTreeMap<String, String>,
    /// Most snapshots that the writer gathers before they go to disk; without it as many as 64 MiB hold,
    /// but 16 at least. A record that is opened does not say it.
    pub gathered: Option<usize>,
}

/// A physical quantity.
///
/// ```
/// let speed = lumley::record::Quantity::new("u", "m/s");
/// assert_eq!(speed.unit, "m/s");
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quantity {
    /// Its name or symbol.
    pub name: String,
    /// Its unit, `1` for none.
    pub unit: String,
}

impl Quantity {
    /// The quantity `name`, measured in `unit`.
    pub fn new(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { name: name.into(), unit: unit.into() }
    }
}

/// Where the values of a field live.
///
/// ```
/// let xi = lumley::record::Support::Nodes(vec![[0.0, 0.0], [0.5, 0.0], [1.0, 0.0]]);
/// assert_eq!(xi.len(), 3);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Support {
    /// The nodes of a uniform grid.
    Grid(UniformGrid),
    /// Nodes given one by one, for example those of the reference mesh.
    Nodes(Vec<Point>),
}

impl Support {
    /// Number of nodes.
    #[expect(clippy::len_without_is_empty, reason = "a record of no nodes is refused")]
    pub fn len(&self) -> usize {
        match self {
            Self::Grid(grid) => grid.len(),
            Self::Nodes(nodes) => nodes.len(),
        }
    }
}

/// A field, and the frame in which it is recorded.
///
/// Its vector has the values of the first component at all nodes, then those of the second, and so on.
///
/// ```
/// use lumley::record::{FrameDescription, Quantity, Support};
/// let reference = FrameDescription {
///     name: "reference".into(),
///     support: Support::Nodes(vec![[0.0, 0.0], [1.0, 0.0]]),
///     length_unit: "1".into(),
///     components: vec![Quantity::new("u", "m/s")],
/// };
/// assert_eq!(reference.rows(), 2);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct FrameDescription {
    /// Its name: letters, digits, `-` and `_`.
    pub name: String,
    /// Where the values live.
    pub support: Support,
    /// Unit of the nodes' coordinates, `1` for none.
    pub length_unit: String,
    /// The components of the field, at least one.
    pub components: Vec<Quantity>,
}

impl FrameDescription {
    /// Length of a snapshot: components times nodes.
    pub fn rows(&self) -> usize {
        self.components.len() * self.support.len()
    }
}

/// A short vector that is recorded with each snapshot.
///
/// ```
/// use lumley::record::{Quantity, SeriesDescription};
/// let angles = vec![Quantity::new("theta", "rad"), Quantity::new("phi", "rad")];
/// let position = SeriesDescription { name: "position".into(), entries: angles };
/// assert_eq!(position.entries.len(), 2);
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SeriesDescription {
    /// Its name: letters, digits, `-` and `_`.
    pub name: String,
    /// Its entries, at least one.
    pub entries: Vec<Quantity>,
}

impl Description {
    /// Whether such a record can be made at `path`, which messages name.
    pub(super) fn check(&self, path: &Path) -> Result<(), RecordError> {
        let frames = self.frames.iter().map(|frame| (&frame.name, &frame.components));
        let series = self.series.iter().map(|series| (&series.name, &series.entries));
        check_parts(path, "frames", frames)?;
        check_parts(path, "series", series)?;
        for frame in &self.frames {
            if let Support::Nodes(nodes) = &frame.support {
                let finite = nodes.iter().flatten().all(|x| x.is_finite());
                if nodes.is_empty() || !finite {
                    let key = format!("frames.{}.support", frame.name);
                    let value = format!("{} nodes", nodes.len());
                    return invalid(path, key, value, "at least one node, finite coordinates");
                }
            }
        }
        Ok(())
    }
}

/// Whether these frames or series can be: they name folders, so that nothing may lead out of the record.
pub(super) fn check_parts<'a>(
    path: &Path,
    kind: &str,
    parts: impl Iterator<Item = (&'a String, &'a Vec<Quantity>)>,
) -> Result<(), RecordError> {
    let mut seen = Vec::new();
    for (name, quantities) in parts {
        let key = format!("name in {kind}");
        if !is_name(name) {
            return invalid(path, key, format!("{:?}", printable(name)), NAME);
        }
        if seen.contains(&name) {
            return invalid(path, key, format!("{name:?} twice"), "each name once");
        }
        if quantities.is_empty() {
            return invalid(path, format!("{kind}.{name}"), "empty".into(), "a quantity");
        }
        seen.push(name);
    }
    if kind == "frames" && seen.is_empty() {
        return invalid(path, kind.into(), "empty".into(), "at least one frame");
    }
    Ok(())
}

fn invalid(path: &Path, key: String, value: String, expected: &str) -> Result<(), RecordError> {
    Err(RecordError::Invalid { path: path.into(), key, value, expected: expected.into() })
}

const NAME: &str = "1 to 64 letters, digits, `-` or `_`";

fn is_name(name: &str) -> bool {
    let allowed = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    (1..=64).contains(&name.len()) && name.chars().all(allowed)
}
