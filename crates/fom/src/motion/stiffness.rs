use super::MotionError;
use super::outline::Outline;
use lumley_fem::Point;
use serde::{Deserialize, Serialize};

/// The stiffness lambda of the mesh in paper eq. (25): where it is large, cells keep their shape.
///
/// ```
/// use lumley_fom::motion::Stiffness;
/// let by_distance = Stiffness::Distance { scale: None, power: 1.0 };
/// assert_eq!(Stiffness::default(), by_distance);
/// assert!(Stiffness::Distance { scale: None, power: f64::NAN }.check().is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Stiffness {
    /// `lambda = 1`, the paper's: round a disc the motion fades with the logarithm of the distance, most
    /// steeply at the disc.
    Uniform {},
    /// `lambda = (1 + distance/scale)^-power` from the nearest moving boundary. Round a disc with its radius as
    /// scale, power 1 makes the motion fade linearly up to the walls: no other stiffness lets the disc move
    /// farther before cells fold. Larger powers spare the cells near the body at the expense of those at
    /// the walls.
    Distance {
        /// In m; by default half of the longer side of the rectangle round the boundary: the radius of a disc.
        #[serde(default)]
        scale: Option<f64>,
        /// From 0 to 10.
        #[serde(default = "one")]
        power: f64,
    },
    /// `lambda = (area of the cell / mean area)^-power`: small cells stay as they are.
    CellSize {
        /// From 0 to 10.
        #[serde(default = "one")]
        power: f64,
    },
}

fn one() -> f64 {
    1.0
}

impl Default for Stiffness {
    fn default() -> Self {
        Self::Distance { scale: None, power: 1.0 }
    }
}

/// Stiffnesses of higher powers differ by more than the solver has digits.
const LARGEST_POWER: f64 = 10.0;

impl Stiffness {
    /// Whether every quantity is in its range.
    ///
    /// # Errors
    /// The [`MotionError::Quantity`] that names the quantity.
    pub fn check(&self) -> Result<(), MotionError> {
        let (scale, power) = match *self {
            Self::Uniform {} => (None, 0.0),
            Self::Distance { scale, power } => (scale, power),
            Self::CellSize { power } => (None, power),
        };
        let ok = (0.0..=LARGEST_POWER).contains(&power);
        MotionError::require(ok, "power of the stiffness", power, "", "a number from 0 to 10")?;
        let scale = scale.unwrap_or(1.0);
        let ok = scale.is_finite() && scale > 0.0;
        MotionError::require(ok, "scale of the stiffness", scale, "m", "a finite number above 0")
    }

    /// lambda at a point, given the area of its cell over that of the mean cell.
    pub(super) fn at(&self, point: Point, relative_area: f64, moving: &[Outline]) -> f64 {
        match *self {
            Self::Uniform {} => 1.0,
            Self::Distance { scale, power } => {
                let relative = |o: &Outline| o.distance(point) / scale.unwrap_or(0.5 * o.extent());
                let nearest = moving.iter().map(relative).fold(f64::INFINITY, f64::min);
                (1.0 + nearest).powf(-power)
            }
            Self::CellSize { power } => relative_area.powf(-power),
        }
    }
}
