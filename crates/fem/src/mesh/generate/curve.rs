use super::plane::{add, between, distance, dot, norm, orientation, scale, subtract};
use super::shape::Shape;
use crate::Point;
use std::f64::consts::FRAC_PI_2;

/// Longest that a corner's mitre may be, in heights of the layers: sharper corners are blunted.
const MITRE: f64 = 2.5;

/// A smooth piece of a body's boundary, counterclockwise, over t in [0, 1], and the curves beyond it on
/// which rows of cells end.
#[derive(Debug, Clone)]
pub(super) enum Curve {
    /// A quarter of an ellipse between its axes, counted from 0; the curves beyond are parallel to it.
    Arc { centre: Point, semi_axes: [f64; 2], direction: Point, quarter: u8 },
    /// A side of a polygon; the sides beyond are parallel to it and end on the bisectors.
    Side { ends: [Point; 2], mitres: [Point; 2] },
}

impl Curve {
    /// The pieces of the boundary, each beginning where the one before ends.
    pub fn of(shape: &Shape) -> Vec<Self> {
        match shape {
            Shape::Disc(disc) => arcs(disc.centre, [disc.radius; 2], [1.0, 0.0]),
            Shape::Ellipse(ellipse) => {
                let direction = [ellipse.angle.cos(), ellipse.angle.sin()];
                arcs(ellipse.centre, ellipse.semi_axes, direction)
            }
            Shape::Polygon(polygon) => sides(&polygon.corners),
        }
    }

    /// Where it is at `t`, `height` away from the body.
    pub fn at(&self, t: f64, height: f64) -> Point {
        match self {
            Self::Arc { centre, semi_axes: [a, b], direction: [cos, sin], quarter } => {
                let [c, s] = on_circle(*quarter, t);
                let normal = [b * c, a * s];
                let stretch = height / norm(normal);
                let [x, y] = [a * c + stretch * normal[0], b * s + stretch * normal[1]];
                add(*centre, [cos * x - sin * y, sin * x + cos * y])
            }
            Self::Side { ends: [a, b], mitres: [m, n] } => {
                add(between(*a, *b, t), scale(height, between(*m, *n, t)))
            }
        }
    }

    /// Length per t, `height` away from the body.
    pub fn speed(&self, t: f64, height: f64) -> f64 {
        match self {
            Self::Arc { .. } => {
                let (speed, radius) = (self.speed_on_body(t), self.radius(t));
                speed * (1.0 + height / radius)
            }
            Self::Side { .. } => distance(self.at(0.0, height), self.at(1.0, height)),
        }
    }

    fn speed_on_body(&self, t: f64) -> f64 {
        match self {
            Self::Arc { semi_axes: [a, b], quarter, .. } => {
                let [c, s] = on_circle(*quarter, t);
                FRAC_PI_2 * norm([a * s, b * c])
            }
            Self::Side { ends: [a, b], .. } => distance(*a, *b),
        }
    }

    /// Radius of curvature of the body, in m.
    pub fn radius(&self, t: f64) -> f64 {
        match self {
            Self::Arc { semi_axes: [a, b], .. } => {
                (self.speed_on_body(t) / FRAC_PI_2).powi(3) / (a * b)
            }
            Self::Side { .. } => f64::INFINITY,
        }
    }
}

fn arcs(centre: Point, semi_axes: [f64; 2], direction: Point) -> Vec<Curve> {
    (0..4).map(|quarter| Curve::Arc { centre, semi_axes, direction, quarter }).collect()
}

/// Cosine and sine on a quarter of the circle; at its ends exactly 0 and 1.
fn on_circle(quarter: u8, t: f64) -> Point {
    let angle = FRAC_PI_2 * t;
    let [c, s] = if t == 1.0 { [0.0, 1.0] } else { [angle.cos(), angle.sin()] };
    match quarter {
        0 => [c, s],
        1 => [-s, c],
        2 => [-c, -s],
        _ => [s, -c],
    }
}

fn sides(corners: &[Point]) -> Vec<Curve> {
    let mut corners = corners.to_vec();
    if area(&corners) < 0.0 {
        corners.reverse();
    }
    let count = corners.len();
    let mitres: Vec<Point> = (0..count)
        .map(|k| mitre(corners[(k + count - 1) % count], corners[k], corners[(k + 1) % count]))
        .collect();
    (0..count)
        .map(|k| (k, (k + 1) % count))
        .map(|(k, l)| Curve::Side {
            ends: [corners[k], corners[l]],
            mitres: [mitres[k], mitres[l]],
        })
        .collect()
}

/// The vector m of the outer bisector with m·n = 1 for the normals n of both sides.
fn mitre(before: Point, corner: Point, after: Point) -> Point {
    let [n0, n1] = [[before, corner], [corner, after]].map(|[a, b]| {
        let along = subtract(b, a);
        scale(1.0 / norm(along), [along[1], -along[0]])
    });
    let sum = add(n0, n1);
    let length = (2.0 / (1.0 + dot(n0, n1))).sqrt(); // 1/cos of half the angle between them
    if length <= MITRE {
        scale(1.0 / (1.0 + dot(n0, n1)), sum)
    } else if norm(sum) > 0.0 {
        scale(MITRE / norm(sum), sum)
    } else {
        scale(MITRE, [-n0[1], n0[0]]) // the tip of a needle: straight on
    }
}

/// The area within a polygon, positive when it is counterclockwise.
pub(super) fn area(corners: &[Point]) -> f64 {
    let fan = corners.windows(2).skip(1).map(|w| orientation([corners[0], w[0], w[1]]));
    0.5 * fan.sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::{Curve, area};
    use crate::mesh::generate::plane::{distance, scale, subtract};
    use crate::mesh::generate::{Ellipse, Polygon, Shape};

    /// Speed and curvature against difference quotients.
    #[test]
    fn speed_is_the_derivative() {
        let ellipse = Ellipse { centre: [1.0, 2.0], semi_axes: [2.0, 0.5], angle: 0.3 };
        let l =
            Polygon { corners: vec![[0., 0.], [2., 0.], [2., 1.], [1., 1.], [1., 3.], [0., 3.]] };
        for shape in [Shape::Ellipse(ellipse), Shape::Polygon(l)] {
            for curve in Curve::of(&shape) {
                for (t, height) in [(0.1, 0.0), (0.4, 0.2), (0.75, 0.1)] {
                    let (p, q) = (curve.at(t - 1e-6, height), curve.at(t + 1e-6, height));
                    let quotient = distance(p, q) / 2e-6;
                    let speed = curve.speed(t, height);
                    assert!((speed - quotient).abs() < 1e-6 * quotient, "{speed}, {quotient}");
                }
            }
        }
    }

    /// The sides of a grown polygon are parallel at the height; clockwise corners are turned round.
    #[test]
    fn mitres_keep_sides_parallel() {
        let corners = vec![[0.0, 0.0], [0.0, 1.0], [1.0, 2.0], [2.5, 0.0]];
        assert!(area(&corners) < 0.0);
        for side in Curve::of(&Shape::Polygon(Polygon { corners })) {
            let along =
                scale(1.0 / side.speed(0.5, 0.0), subtract(side.at(1., 0.), side.at(0., 0.)));
            for t in [0.0, 0.3, 1.0] {
                let out = subtract(side.at(t, 0.1), side.at(t, 0.0));
                let height = out[0] * along[1] - out[1] * along[0];
                assert!((height - 0.1).abs() < 1e-15, "{height}");
            }
        }
    }
}
