//! Vectors of the plane.

/// A point or a vector of the plane, in m.
pub type Point = [f64; 2];

pub(crate) fn plus(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1]]
}

pub(crate) fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

pub(crate) fn times(s: f64, a: Point) -> Point {
    [s * a[0], s * a[1]]
}

pub(crate) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// `a` turned by a right angle, counterclockwise.
pub(crate) fn across(a: Point) -> Point {
    [-a[1], a[0]]
}

/// `R − I` for an angle, without the cancellation of `cos − 1`: exactly 0 for the angle 0.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Turn {
    sin: f64,
    cos_less_one: f64,
}

impl Turn {
    pub fn by(angle: f64) -> Self {
        let (sin, cos) = (0.5 * angle).sin_cos();
        Self { sin: 2.0 * sin * cos, cos_less_one: -2.0 * sin * sin }
    }

    /// `(R − I) a`
    pub fn change(&self, [x, y]: Point) -> Point {
        [self.cos_less_one * x - self.sin * y, self.sin * x + self.cos_less_one * y]
    }

    /// `R a`
    pub fn apply(&self, a: Point) -> Point {
        plus(a, self.change(a))
    }
}
