use lumley_fem::Point;
use serde::{Deserialize, Serialize};

/// How far a rigid body is from its place in the mesh as it was given, paper eq. (23):
///
/// ```text
/// x = X + d + (R(angle) - I) (X - pivot)
/// ```
///
/// Written so, a body that has not moved is where it was to the last bit.
///
/// ```
/// use lumley_fom::motion::RigidMotion;
/// let motion = RigidMotion { translation: [1.0, 0.0], angle: std::f64::consts::FRAC_PI_2 };
/// let [x, y] = motion.place([2.0, 0.0], [3.0, 0.0]);
/// assert!((x - 3.0).abs() < 1e-15 && (y - 1.0).abs() < 1e-15);
/// assert_eq!(RigidMotion::REST.place([0.1, 0.2], [0.3, 0.7]), [0.3, 0.7]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RigidMotion {
    /// Displacement d of the pivot, in m.
    pub translation: Point,
    /// Angle, counterclockwise, in rad; whole turns count.
    pub angle: f64,
}

impl RigidMotion {
    /// The body is where it was.
    pub const REST: Self = Self { translation: [0.0; 2], angle: 0.0 };

    /// Where the point of the body is that was at `point`, in m.
    pub fn place(&self, pivot: Point, point: Point) -> Point {
        self.map(pivot)(point)
    }

    /// [`place`](Self::place) for many points: the same bits, the sine taken once.
    pub(super) fn map(&self, pivot: Point) -> impl Fn(Point) -> Point {
        let ([dx, dy], turn) = (self.translation, Turn::by(self.angle));
        move |[x, y]| {
            let [tx, ty] = turn.displacement([x - pivot[0], y - pivot[1]]);
            [x + (dx + tx), y + (dy + ty)]
        }
    }

    /// How far the body's point at `point` has moved, in m.
    pub(super) fn displacement(&self, pivot: Point, point: Point) -> Point {
        let arm = [0, 1].map(|d| point[d] - pivot[d]);
        let turned = Turn::by(self.angle).displacement(arm);
        [0, 1].map(|d| self.translation[d] + turned[d])
    }

    pub(super) fn is_finite(&self) -> bool {
        self.angle.is_finite() && self.translation.iter().all(|x| x.is_finite())
    }
}

/// `R - I` for an angle, without the cancellation of `cos - 1`.
#[derive(Clone, Copy)]
pub(super) struct Turn {
    sin: f64,
    cos_less_one: f64,
}

impl Turn {
    #[inline]
    pub fn by(angle: f64) -> Self {
        if angle == 0.0 {
            return Self { sin: 0.0, cos_less_one: 0.0 };
        }
        let (sin, cos) = (0.5 * angle).sin_cos();
        Self { sin: 2.0 * sin * cos, cos_less_one: -2.0 * sin * sin }
    }

    #[inline]
    pub fn displacement(&self, [x, y]: Point) -> Point {
        [self.cos_less_one * x - self.sin * y, self.sin * x + self.cos_less_one * y]
    }
}
