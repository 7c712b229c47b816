use super::curve::Curve;
use super::divide::whole;
use super::plane::{distance_to_segment, orientation, segments_meet};
use super::{Body, GenerateError, Shape, curve};
use crate::Point;

/// Fewest points of a quarter of an ellipse, and of a side.
const SMOOTH: usize = 64;
const STRAIGHT: usize = 16;

/// A closed polyline, counterclockwise, along the outer edge of a body's layers, or along the body itself.
#[derive(Debug, Clone)]
pub(super) struct Outline {
    pub points: Vec<Point>,
    /// For each point the piece of the boundary that it is on, and where on it.
    pub places: Vec<(usize, f64)>,
    /// The smallest rectangle round it: lower and upper corner.
    pub bounds: [Point; 2],
}

impl Outline {
    /// Points along the curves at most `spacing` apart, `height` away from the body.
    pub fn new(
        curves: &[Curve],
        height: f64,
        spacing: f64,
        limit: usize,
    ) -> Result<Self, GenerateError> {
        let mut places = Vec::new();
        for (piece, curve) in curves.iter().enumerate() {
            let least = if matches!(curve, Curve::Side { .. }) { STRAIGHT } else { SMOOTH };
            let fastest = (0..=8).map(|k| curve.speed(f64::from(k) / 8.0, height));
            let wanted = (fastest.fold(0.0, f64::max) / spacing).ceil();
            if places.len() as f64 + wanted > 4.0 * limit as f64 {
                return Err(GenerateError::TooManyCells { limit });
            }
            let count = least.max(whole(wanted));
            places.extend((0..count).map(|k| (piece, k as f64 / count as f64)));
        }
        let at = |&(piece, t): &(usize, f64)| curves[piece].at(t, height);
        let points: Vec<Point> = places.iter().map(at).collect();
        let bounds = bounds(&points);
        Ok(Self { points, places, bounds })
    }

    pub fn segments(&self) -> impl Iterator<Item = [Point; 2]> + '_ {
        let ends = self.points.iter().skip(1).chain(self.points.first());
        self.points.iter().zip(ends).map(|(&a, &b)| [a, b])
    }

    pub fn distance(&self, p: Point) -> f64 {
        self.segments().map(|s| distance_to_segment(p, s)).fold(f64::INFINITY, f64::min)
    }

    /// Whether `p` is within, by counting crossings of the ray to the right.
    fn contains(&self, p: Point) -> bool {
        let crosses = |[a, b]: &[Point; 2]| {
            let upward = a[1] <= p[1] && p[1] < b[1] && orientation([*a, *b, p]) > 0.0;
            let downward = b[1] <= p[1] && p[1] < a[1] && orientation([*a, *b, p]) < 0.0;
            upward || downward
        };
        self.segments().filter(crosses).count() % 2 == 1
    }

    /// A point that this has in common with `other`, if there is one.
    pub fn meets(&self, other: &Self) -> Option<Point> {
        let ([l, u], [m, v]) = (self.bounds, other.bounds);
        if (0..2).any(|d| u[d] < m[d] || v[d] < l[d]) {
            return None;
        }
        let (p, q) = (self.points[0], other.points[0]);
        if self.contains(q) {
            return Some(q);
        }
        if other.contains(p) {
            return Some(p);
        }
        let near: Vec<_> = other.segments().filter(|s| boxes_meet(s, &[l, u])).collect();
        let crossed = self.segments().find(|s| near.iter().any(|t| segments_meet(*s, *t)));
        crossed.map(|s| s[0])
    }
}

fn boxes_meet(segment: &[Point; 2], [lower, upper]: &[Point; 2]) -> bool {
    let [l, u] = bounds(segment);
    (0..2).all(|d| l[d] <= upper[d] && lower[d] <= u[d])
}

/// The smallest rectangle round these points: lower and upper corner.
pub(super) fn bounds(points: &[Point]) -> [Point; 2] {
    let start = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    points.iter().fold(start, |[lower, upper], p| {
        [[0, 1].map(|d| p[d].min(lower[d])), [0, 1].map(|d| p[d].max(upper[d]))]
    })
}

/// Whether a polygon, and the outer edge of its layers, go round once without touching themselves.
pub(super) fn check_polygon(body: &Body, curves: &[Curve]) -> Result<(), GenerateError> {
    let Shape::Polygon(polygon) = &body.shape else { return Ok(()) };
    let ring = |height| curves.iter().map(|c| c.at(0.0, height)).collect::<Vec<Point>>();
    if let Some((first, second)) = first_contact(&polygon.corners) {
        let (body, near) = (body.name.clone(), polygon.corners[first]);
        return Err(GenerateError::CrossesItself { body, first, second, near });
    }
    for level in body.levels().into_iter().skip(1) {
        let (inner, outer) = (ring(0.0), ring(level));
        let turned = (0..inner.len()).find(|&k| {
            let next = (k + 1) % inner.len();
            let along = |c: &[Point]| super::plane::subtract(c[next], c[k]);
            super::plane::dot(along(&inner), along(&outer)) <= 0.0
        });
        let folded = turned.or_else(|| first_contact(&outer).map(|(side, _)| side));
        if let Some(side) = folded {
            let (body, near) = (body.name.clone(), inner[side]);
            return Err(GenerateError::LayersFold { body, thickness: level, near });
        }
    }
    assert!(curve::area(&ring(0.0)) > 0.0, "curves are counterclockwise");
    Ok(())
}

/// Two sides of a polygon that touch each other elsewhere than neighbours do.
fn first_contact(corners: &[Point]) -> Option<(usize, usize)> {
    let count = corners.len();
    let side = |k: usize| [corners[k], corners[(k + 1) % count]];
    (0..count).find_map(|k| {
        let neighbour = (k + 1) % count;
        let far = (k + 2..count).filter(|&l| (l + 1) % count != k);
        let doubles_back = || {
            let ([a, b], [_, c]) = (side(k), side(neighbour));
            let back =
                super::plane::dot(super::plane::subtract(a, b), super::plane::subtract(c, b));
            a == b || (orientation([a, b, c]) == 0.0 && back >= 0.0)
        };
        if doubles_back() {
            return Some((k, neighbour));
        }
        far.into_iter().find(|&l| segments_meet(side(k), side(l))).map(|l| (k, l))
    })
}
