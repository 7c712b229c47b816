//! Vectors of the plane.

use crate::Point;

pub(super) fn add(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1]]
}

pub(super) fn subtract(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

pub(super) fn scale(factor: f64, a: Point) -> Point {
    [factor * a[0], factor * a[1]]
}

pub(super) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(super) fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub(super) fn norm(a: Point) -> f64 {
    dot(a, a).sqrt()
}

pub(super) fn distance(a: Point, b: Point) -> f64 {
    norm(subtract(a, b))
}

/// `(1 − t) a + t b`.
pub(super) fn between(a: Point, b: Point, t: f64) -> Point {
    add(scale(1.0 - t, a), scale(t, b))
}

/// Twice the area of the triangle, positive when it is counterclockwise.
pub(super) fn orientation([a, b, c]: [Point; 3]) -> f64 {
    cross(subtract(b, a), subtract(c, a))
}

pub(super) fn distance_to_segment(p: Point, [a, b]: [Point; 2]) -> f64 {
    let (along, to) = (subtract(b, a), subtract(p, a));
    let length = dot(along, along);
    let t = if length > 0.0 { (dot(to, along) / length).clamp(0.0, 1.0) } else { 0.0 };
    distance(p, between(a, b, t))
}

/// Whether two segments have a point in common.
pub(super) fn segments_meet([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let apart = |p: Point, q: Point, r: Point, s: Point| {
        let sides = [orientation([p, q, r]), orientation([p, q, s])];
        sides[0] * sides[1] > 0.0
    };
    let boxes_meet =
        (0..2).all(|k| a[k].min(b[k]) <= c[k].max(d[k]) && c[k].min(d[k]) <= a[k].max(b[k]));
    boxes_meet && !apart(a, b, c, d) && !apart(c, d, a, b)
}
