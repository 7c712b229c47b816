use super::channel::Rectangle;
use super::curve::Curve;
use super::outline::{Outline, bounds, check_polygon};
use super::plane::{distance, subtract};
use super::size::{SizeField, Source};
use super::{Body, Channel, GenerateError};
use crate::Point;
use std::f64::consts::PI;

/// Most that the body's boundary may turn along an edge, in rad: twelve edges round a disc.
const TURN: f64 = PI / 6.0;

/// Cells across a gap.
const ACROSS: f64 = 2.0;

/// Growth below which gaps are taken no more finely.
const SLOWEST: f64 = 0.1;

/// A body in its place, found to be apart from the others.
#[derive(Debug)]
pub(super) struct Placed<'a> {
    pub body: &'a Body,
    pub curves: Vec<Curve>,
    /// Where rows of its layers begin and end, in m; without layers only 0.
    pub levels: Vec<f64>,
    /// The outer edge of its layers.
    outline: Outline,
    /// The longest that edges on it may be: they grow no faster than cells do elsewhere.
    on_body: SizeField,
}

/// All bodies of a channel, apart from each other.
pub(super) fn place(channel: &Channel) -> Result<Vec<Placed<'_>>, GenerateError> {
    let placed = channel.bodies.iter().map(|body| Placed::new(body, channel));
    let placed = placed.collect::<Result<Vec<_>, _>>()?;
    for (k, a) in placed.iter().enumerate() {
        for b in &placed[..k] {
            if let Some(near) = a.outline.meets(&b.outline) {
                let [first, second] = [b, a].map(|p| p.body.name.clone());
                let thickness = [b, a].map(Placed::thickness);
                return Err(GenerateError::Overlap { first, second, thickness, near });
            }
        }
    }
    Ok(placed)
}

/// Where the triangles are: the rectangle that was asked for, or one round the bodies.
pub(super) fn rectangle(
    channel: &Channel,
    placed: &[Placed<'_>],
) -> Result<Option<Rectangle>, GenerateError> {
    let (found, outer) = match channel.triangles {
        Some(given) => ([given.x, given.y], [channel.x, channel.y]),
        None if placed.is_empty() => return Ok(None),
        None => (around(channel, placed), [channel.x, channel.y]),
    };
    if (0..2).any(|d| found[d][0] < outer[d][0] || found[d][1] > outer[d][1]) {
        return Err(GenerateError::Rectangle { found, channel: outer });
    }
    let rectangle = Rectangle { x: found[0], y: found[1] };
    placed.iter().try_for_each(|p| p.check_within([channel.x, channel.y], CHANNEL))?;
    placed.iter().try_for_each(|p| p.check_within(found, TRIANGLES))?;
    Ok(Some(rectangle))
}

const CHANNEL: [[&str; 2]; 2] = [["the left side", "the right side"], ["the bottom", "the top"]];
const TRIANGLES: [[&str; 2]; 2] =
    [["triangles.x[0]", "triangles.x[1]"], ["triangles.y[0]", "triangles.y[1]"]];

fn around(channel: &Channel, placed: &[Placed<'_>]) -> [[f64; 2]; 2] {
    let corners: Vec<Point> = placed.iter().flat_map(|p| p.outline.bounds).collect();
    let [lower, upper] = bounds(&corners);
    let extents = placed.iter().map(|p| p.outline.bounds).map(|[l, u]| subtract(u, l));
    let margin = extents.flatten().fold(0.0, f64::max);
    let sides = [channel.x, channel.y];
    [0, 1].map(|d| {
        let [wall, far] = sides[d];
        let (a, b) = (lower[d] - margin, upper[d] + margin);
        let near = |strip: f64| strip < channel.size;
        [if near(a - wall) { wall } else { a }, if near(far - b) { far } else { b }]
    })
}

impl<'a> Placed<'a> {
    fn new(body: &'a Body, channel: &Channel) -> Result<Self, GenerateError> {
        let curves = Curve::of(&body.shape);
        check_polygon(body, &curves)?;
        let levels = body.levels();
        let height = levels.last().copied().unwrap_or(0.0);
        let outline = Outline::new(&curves, height, 0.5 * body.size, channel.limit)?;
        let shape = outline.places.iter().map(|&(piece, t)| {
            let curve = &curves[piece];
            let size = match curve {
                Curve::Arc { .. } => TURN * curve.radius(t),
                Curve::Side { .. } => curve.speed(t, 0.0),
            };
            Source { at: curve.at(t, 0.0), size }
        });
        let on_body = SizeField::new(body.size, channel.growth, &shape.collect::<Vec<_>>());
        Ok(Self { body, curves, levels, outline, on_body })
    }

    /// Thickness of its layers, in m.
    pub fn thickness(&self) -> f64 {
        self.levels.last().copied().unwrap_or(0.0)
    }

    fn check_within(
        &self,
        interval: [[f64; 2]; 2],
        sides: [[&'static str; 2]; 2],
    ) -> Result<(), GenerateError> {
        let (body, thickness) = (self.body.name.clone(), self.thickness());
        for &reach in &self.outline.points {
            let beyond = |d: &usize| reach[*d] <= interval[*d][0] || reach[*d] >= interval[*d][1];
            if let Some(d) = (0..2).find(beyond) {
                let end = usize::from(reach[d] >= interval[d][1]);
                let (side, at) = (sides[d][end], interval[d][end]);
                return Err(GenerateError::Outside { body, thickness, reach, side, at });
            }
        }
        Ok(())
    }

    /// The sizes that are wanted along the outer edge of its layers.
    ///
    /// Between two points of the outline the wanted size grows: the gap must be wide enough for that.
    pub fn sources(
        &self,
        all: &[Placed<'_>],
        within: Rectangle,
        growth: f64,
    ) -> Result<Vec<Source>, GenerateError> {
        let longest = self.outline.segments().map(|[a, b]| distance(a, b)).fold(0.0, f64::max);
        let least = ACROSS * growth.max(SLOWEST) * longest;
        let places = self.outline.places.iter();
        let own: Vec<f64> = places.map(|&(k, t)| self.own_size(&self.curves[k], t)).collect();
        let points = self.outline.points.iter().zip(&own);
        let gaps: Vec<f64> = points
            .clone()
            .map(|(&at, own)| self.gap_beyond(at, all, within, least.max(ACROSS * own)))
            .collect();
        let narrowest = gaps.iter().zip(&self.outline.points).min_by(|a, b| a.0.total_cmp(b.0));
        if let Some((&gap, &near)) = narrowest.filter(|(gap, _)| **gap < least) {
            return Err(GenerateError::Gap { body: self.body.name.clone(), gap, near, least });
        }
        let sizes = points.zip(gaps);
        Ok(sizes.map(|((&at, own), gap)| Source { at, size: own.min(gap / ACROSS) }).collect())
    }

    /// Distance of `p`, on its outline, from the other bodies that are within `reach`, and from the rectangle.
    fn gap_beyond(
        &self,
        p: Point,
        all: &[Placed<'_>],
        Rectangle { x, y }: Rectangle,
        reach: f64,
    ) -> f64 {
        let others = all.iter().filter(|other| !std::ptr::eq(*other, self));
        let sides = [p[0] - x[0], x[1] - p[0], p[1] - y[0], y[1] - p[1]];
        others.map(|other| other.gap(p, reach)).chain(sides).fold(f64::INFINITY, f64::min)
    }

    /// The size that the body's own shape asks for at the outer edge of the layers.
    fn own_size(&self, curve: &Curve, t: f64) -> f64 {
        self.size_on_body(curve, t) * curve.speed(t, self.thickness()) / curve.speed(t, 0.0)
    }

    /// The longest that an edge on the body may be, other bodies apart.
    pub fn size_on_body(&self, curve: &Curve, t: f64) -> f64 {
        self.on_body.at(curve.at(t, 0.0))
    }

    /// Distance of `p` from its layers, or infinity where it is more than `reach`.
    fn gap(&self, p: Point, reach: f64) -> f64 {
        let [lower, upper] = self.outline.bounds;
        let nearest = [0, 1].map(|d| p[d].clamp(lower[d], upper[d]));
        if distance(p, nearest) > reach { f64::INFINITY } else { self.outline.distance(p) }
    }
}
