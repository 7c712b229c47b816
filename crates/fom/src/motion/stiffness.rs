use super::MotionError;
use super::outline::Outline;
use lumley_fem::Point;
use serde::{Deserialize, Serialize};

/// The stiffness lambda of the mesh in paper eq. (25): where it is large, cells keep their shape.
///
/// Round a disc of radius a in a large domain, the share of a displacement is steepest where cells fold first;
/// `lambda = 1/r` makes it linear in r, and no other choice lets the disc go farther. An angle shears cells by
/// `r dg/dr`; `lambda = 1` makes this the same everywhere, and no other choice lets the disc turn farther.
/// Hence the powers of `distance`.
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
    /// `lambda = 1`, the paper's. A disc goes about three radii before cells at it fold.
    Uniform {},
    /// `lambda = (1 + distance/scale)^-power` from the nearest moving boundary for displacements, one power less
    /// for angles. Powers above 1 spare the cells near the body at the expense of those at the walls.
    Distance {
        /// In m; by default half of the longer side of the rectangle round the boundary: the radius of a disc.
        #[serde(default)]
        scale: Option<f64>,
        /// From 0 to 10.
        #[serde(default = "one")]
        power: f64,
    },
    /// `lambda = (area of the cell / mean area)^-power` for displacements, times `1 + distance/scale` with the
    /// scale above for angles: small cells stay as they are.
    CellSize {
        /// From 0 to 10.
        #[serde(default = "one")]
        power: f64,
    },
}

/// What follows a body in part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Follower {
    /// The displacement of its centre.
    Displacement,
    /// Its angle.
    Angle,
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

    /// lambda for a follower at a point, given the area of the cell there over that of the mean cell.
    pub(super) fn at(
        &self,
        follower: Follower,
        point: Point,
        relative_area: f64,
        moving: &[Outline],
    ) -> f64 {
        let near = |scale: Option<f64>| {
            let relative = |o: &Outline| o.distance(point) / scale.unwrap_or(0.5 * o.extent());
            1.0 + moving.iter().map(relative).fold(f64::INFINITY, f64::min)
        };
        let turns = follower == Follower::Angle;
        match *self {
            Self::Uniform {} => 1.0,
            Self::Distance { scale, power } => near(scale).powf(f64::from(turns) - power),
            Self::CellSize { power } => {
                relative_area.powf(-power) * if turns { near(None) } else { 1.0 }
            }
        }
    }
}
