use super::{GenerateError, Shape};
use crate::Point;
use serde::{Deserialize, Serialize};

/// What a mesh of a channel with bodies is made from.
///
/// Its sides are called `left`, `right`, `bottom` and `top`. The wanted size of the cells is
///
/// ```text
/// h(x) = min(size, h_b + growth d_b(x) over all bodies b)
/// ```
///
/// where `d_b` is the distance from the body or its layers and `h_b` the body's size, smaller where it is
/// strongly curved, has short sides, or is close to another body or a wall. Lines of rectangles go through
/// from side to side: where they are closer than wanted, the triangles beside them are smaller too.
///
/// ```
/// use lumley_fem::generate::Channel;
/// let channel: Channel = toml::from_str(
///     r#"
///     x = [0, 2.2]
///     y = [0, 0.41]
///     size = 0.05
///     [[bodies]]
///     name = "cylinder"
///     shape = { kind = "disc", centre = [0.2, 0.2], radius = 0.05 }
///     size = 0.015
///     layers = { first = 0.003, growth = 1.3, count = 3 }
///     "#,
/// )?;
/// let mesh = channel.mesh()?;
/// assert!(mesh.triangles.len() > 100 && mesh.quadrilaterals.len() > 100);
/// assert_eq!(mesh.boundaries.last().map(|b| b.name.as_str()), Some("cylinder"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Channel {
    /// x of its left and right sides, in m.
    pub x: [f64; 2],
    /// y of its bottom and top, in m.
    pub y: [f64; 2],
    /// Largest size of a cell, in m.
    pub size: f64,
    /// Growth of the cells' size with the distance from the bodies, in m per m.
    #[serde(default = "growth")]
    pub growth: f64,
    /// Where the triangles are; beyond it are rectangles. By default the smallest rectangle round the bodies and
    /// their layers, widened on each side by the extent of the largest body, and to the wall where no row of
    /// rectangles would fit.
    #[serde(default)]
    pub triangles: Option<Rectangle>,
    /// The bodies, which touch neither each other nor the sides.
    #[serde(default)]
    pub bodies: Vec<Body>,
    /// Most cells that may be made.
    #[serde(default = "limit")]
    pub limit: usize,
}

fn growth() -> f64 {
    0.2
}

fn limit() -> usize {
    1_000_000
}

/// A rectangle.
///
/// ```
/// use lumley_fem::generate::Rectangle;
/// let near: Rectangle = toml::from_str("x = [0.1, 0.6]\ny = [0.1, 0.3]")?;
/// assert_eq!(near.y, [0.1, 0.3]);
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rectangle {
    /// x of its left and right sides, in m.
    pub x: [f64; 2],
    /// y of its bottom and top, in m.
    pub y: [f64; 2],
}

/// A body in the channel.
///
/// ```
/// use lumley_fem::generate::Body;
/// let body: Body = toml::from_str(
///     "name = 'wing'\nsize = 0.01\nshape = { kind = 'ellipse', centre = [0, 0], semi_axes = [1, 0.1] }",
/// )?;
/// assert!(body.layers.is_none());
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// The name of its boundary.
    pub name: String,
    /// Its outline.
    pub shape: Shape,
    /// Largest length of an edge on it, in m.
    pub size: f64,
    /// Rows of quadrilaterals along it.
    #[serde(default)]
    pub layers: Option<Layers>,
}

/// Rows of quadrilaterals along a body, thin at the body and thicker away from it.
///
/// At corners of less than about 30° their cells are poor: leave them out there.
///
/// ```
/// use lumley_fem::generate::Layers;
/// let layers = Layers { first: 0.001, growth: 2.0, count: 3 };
/// assert_eq!(layers.thickness(), 0.007);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Layers {
    /// Height of the first row, in m.
    pub first: f64,
    /// Height of a row over that of the row below.
    pub growth: f64,
    /// Number of rows.
    pub count: usize,
}

impl Layers {
    /// Heights of all rows together, in m.
    pub fn thickness(&self) -> f64 {
        self.levels().last().copied().unwrap_or(0.0)
    }

    /// Where rows begin and end, above the body, in m.
    pub(super) fn levels(&self) -> Vec<f64> {
        let mut height = self.first;
        let mut level = 0.0;
        let above = (0..self.count).map(|_| {
            level += height;
            height *= self.growth;
            level
        });
        std::iter::once(0.0).chain(above.collect::<Vec<_>>()).collect()
    }
}

impl Body {
    /// Where rows of its layers begin and end, in m; without layers only 0.
    pub(super) fn levels(&self) -> Vec<f64> {
        self.layers.map_or(vec![0.0], |layers| layers.levels())
    }
}

/// The names of the sides.
pub(super) const SIDES: [&str; 4] = ["left", "right", "bottom", "top"];

/// Most rows of layers: more come from a slip of the hand.
const ROWS: usize = 1000;

impl Channel {
    /// A channel between these sides, in m, with cells of this size and no bodies.
    pub fn new(x: [f64; 2], y: [f64; 2], size: f64) -> Self {
        let (growth, limit) = (growth(), limit());
        Self { x, y, size, growth, triangles: None, bodies: vec![], limit }
    }

    /// Whether every quantity by itself is in its range.
    pub(super) fn check(&self) -> Result<(), GenerateError> {
        interval("x", self.x)?;
        interval("y", self.y)?;
        positive("size", self.size)?;
        let growth = self.growth;
        if !(0.0..=1.0).contains(&growth) {
            return Err(quantity("growth", growth, "a number from 0 to 1, for example 0.2"));
        }
        if let Some(rectangle) = self.triangles {
            interval("triangles.x", rectangle.x)?;
            interval("triangles.y", rectangle.y)?;
        }
        for (k, body) in self.bodies.iter().enumerate() {
            let name = &body.name;
            let taken = SIDES.into_iter().chain(self.bodies[..k].iter().map(|b| b.name.as_str()));
            if name.is_empty() || taken.into_iter().any(|other| other == name) {
                return Err(GenerateError::Name { name: name.clone() });
            }
            body.check()?;
        }
        Ok(())
    }
}

impl Body {
    fn check(&self) -> Result<(), GenerateError> {
        let called = |what: &str| format!("{what} of body {}", self.name);
        positive(&called("size"), self.size)?;
        if let Some(layers) = &self.layers {
            positive(&called("layers.first"), layers.first)?;
            positive(&called("layers.growth"), layers.growth)?;
            if !(1..=ROWS).contains(&layers.count) {
                let expected = "1 to 1000 rows";
                return Err(quantity(&called("layers.count"), layers.count as f64, expected));
            }
            positive(&called("thickness of the layers"), layers.thickness())?;
        }
        match &self.shape {
            Shape::Disc(disc) => {
                finite(&called("centre"), &disc.centre)?;
                positive(&called("radius"), disc.radius)
            }
            Shape::Ellipse(ellipse) => {
                finite(&called("centre"), &ellipse.centre)?;
                finite(&called("angle"), &[ellipse.angle])?;
                ellipse.semi_axes.iter().try_for_each(|&axis| positive(&called("semi-axis"), axis))
            }
            Shape::Polygon(polygon) => self.check_corners(&polygon.corners),
        }
    }

    fn check_corners(&self, corners: &[Point]) -> Result<(), GenerateError> {
        if corners.len() < 3 {
            let (body, corners) = (self.name.clone(), corners.len());
            return Err(GenerateError::FewCorners { body, corners });
        }
        corners.iter().try_for_each(|c| finite(&format!("corner of body {}", self.name), c))
    }
}

fn quantity(what: &str, value: f64, expected: &'static str) -> GenerateError {
    GenerateError::Quantity { what: what.to_owned(), value, expected }
}

fn positive(what: &str, value: f64) -> Result<(), GenerateError> {
    let ok = value.is_finite() && value > 0.0;
    if ok { Ok(()) } else { Err(quantity(what, value, "a finite number above 0")) }
}

fn finite(what: &str, values: &[f64]) -> Result<(), GenerateError> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(&value) => Err(quantity(what, value, "a finite number")),
        None => Ok(()),
    }
}

fn interval(what: &'static str, ends: [f64; 2]) -> Result<(), GenerateError> {
    let ok = ends[0] < ends[1] && (ends[1] - ends[0]).is_finite();
    if ok { Ok(()) } else { Err(GenerateError::Interval { what, ends }) }
}
