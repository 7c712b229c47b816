use crate::Point;
use serde::{Deserialize, Serialize};

/// The outline of a body.
///
/// ```
/// use lumley_fem::generate::Shape;
/// let shape: Shape = toml::from_str("kind = 'disc'\ncentre = [0.2, 0.2]\nradius = 0.05")?;
/// assert!(matches!(shape, Shape::Disc(disc) if disc.radius == 0.05));
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Shape {
    /// `kind = "disc"`.
    Disc(Disc),
    /// `kind = "ellipse"`.
    Ellipse(Ellipse),
    /// `kind = "polygon"`.
    Polygon(Polygon),
}

/// A disc.
///
/// ```
/// use lumley_fem::generate::Disc;
/// let disc: Disc = toml::from_str("centre = [0.2, 0.2]\nradius = 0.05")?;
/// assert!(toml::from_str::<Disc>("centre = [0.2, 0.2]\nradus = 0.05").is_err());
/// assert_eq!(disc.centre, [0.2, 0.2]);
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Disc {
    /// Its centre, in m.
    pub centre: Point,
    /// Its radius, in m.
    pub radius: f64,
}

/// An ellipse.
///
/// ```
/// use lumley_fem::generate::Ellipse;
/// let upright: Ellipse = toml::from_str("centre = [0, 0]\nsemi_axes = [1, 2]")?;
/// assert_eq!(upright.angle, 0.0);
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ellipse {
    /// Its centre, in m.
    pub centre: Point,
    /// Its semi-axes, in m.
    pub semi_axes: [f64; 2],
    /// Angle from the x axis to the first semi-axis, counterclockwise, in rad.
    #[serde(default)]
    pub angle: f64,
}

/// A polygon that does not cross itself.
///
/// ```
/// use lumley_fem::generate::Polygon;
/// let plate: Polygon = toml::from_str("corners = [[0, 0], [1, 0], [1, 0.1], [0, 0.1]]")?;
/// assert_eq!(plate.corners.len(), 4);
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Polygon {
    /// Its corners in order, clockwise or counterclockwise, in m.
    pub corners: Vec<Point>,
}
