//! The bodies as pictures show them: outlines of those in the mesh, and lines from hinge to hinge for dry ones.

use super::rings::{Ring, rings};
use super::{BodyMotion, FlowReport};
use crate::report::figure::{Curves, Series};
use crate::report::html::rounded;
use lumley_body::RigidBody;
use lumley_body::joint::Joint;
use lumley_fem::Point;
use serde_json::{Value, json};

/// What a picture shows of a body.
struct Shape<'a> {
    /// In the mesh as it was at first.
    curves: Curves,
    /// The body that carries it; none for an outline that stays.
    body: Option<&'a BodyMotion>,
}

impl Shape<'_> {
    fn at(&self, report: &FlowReport, time: f64) -> Curves {
        let Some(body) = self.body else { return self.curves.clone() };
        let [x, y, angle] = report.bodies.place(body, time);
        self.curves.clone().moved(body.setup.centre, [x, y], angle)
    }
}

/// Everything that pictures show, lines below outlines.
fn shapes(report: &FlowReport) -> Vec<Shape<'_>> {
    links(report).into_iter().chain(outlines(report)).collect()
}

/// The outlines of the bodies in the mesh.
fn outlines(report: &FlowReport) -> Vec<Shape<'_>> {
    let Some(mesh) = &report.scene.mesh else { return Vec::new() };
    let names = mesh.topology().boundaries();
    let body_of = |ring: &Ring| {
        ring.boundaries.iter().find_map(|&k| report.bodies.of_boundary(&names[k].name))
    };
    let bodies = rings(mesh).into_iter().filter(Ring::is_body);
    bodies.map(|ring| Shape { body: body_of(&ring), curves: Curves::solid(ring.edges) }).collect()
}

/// A line for each dry body that hangs on a hinge.
fn links(report: &FlowReport) -> Vec<Shape<'_>> {
    let dry = report.bodies.bodies.iter().filter(|body| body.setup.boundary.is_none());
    let line =
        |body| Some(Shape { curves: Curves::link(&points(report, body)?), body: Some(body) });
    dry.filter_map(line).collect()
}

/// From the hinge of a body to those of the bodies that it holds; where it holds none, through its centre to its
/// other end.
fn points(report: &FlowReport, body: &BodyMotion) -> Option<Vec<Point>> {
    let (start, _) = hinge(&body.setup)?;
    let held = report.bodies.bodies.iter().filter_map(|other| {
        let (at, to) = hinge(&other.setup)?;
        (to == Some(&*body.setup.name)).then_some(at)
    });
    let held: Vec<Point> = held.flat_map(|at| [at, start]).collect();
    let end = [0, 1].map(|d| 2.0 * body.setup.centre[d] - start[d]);
    let ends = if held.is_empty() { vec![end] } else { held };
    Some(std::iter::once(start).chain(ends).collect())
}

/// Where the hinge of a body is, and the body on which it is.
fn hinge(body: &RigidBody) -> Option<(Point, Option<&str>)> {
    match &body.joint {
        Joint::Revolute(hinge) => Some((hinge.at, hinge.to.as_deref())),
        _ => None,
    }
}

/// The bodies where they are at `time`.
pub(super) fn solids(report: &FlowReport, time: f64) -> Vec<Curves> {
    shapes(report).iter().map(|shape| shape.at(report, time)).collect()
}

/// For everything that [`solids`] draws `null` where it stays, else x and y of its body's centre and how far that
/// has turned, in degrees, at all times.
pub(super) fn frames(report: &FlowReport, times: &[f64]) -> Vec<Value> {
    let of_shape = |shape: &Shape| match shape.body {
        None => Value::Null,
        Some(body) => {
            let place = |&time: &f64| {
                let [x, y, angle] = report.bodies.place(body, time);
                let [gx, gy] = body.setup.centre;
                [gx + x, gy + y, angle.to_degrees()].map(rounded)
            };
            json!(times.iter().map(place).collect::<Vec<_>>())
        }
    };
    shapes(report).iter().map(of_shape).collect()
}

/// What pictures of the time from `start` to `end` show, say those of modes: bodies that stay, and of those that
/// move the outline at the start, dashed, that at the end, and the way of the centre.
pub(super) fn swept(report: &FlowReport, start: f64, end: f64) -> (Vec<Curves>, Vec<Series>) {
    let mut curves = Vec::new();
    let mut ways = Vec::new();
    for shape in outlines(report) {
        match shape.body.filter(|body| body.moves()) {
            None => curves.push(shape.curves),
            Some(body) => {
                curves.push(shape.at(report, start).dashed());
                curves.push(shape.at(report, end).hollow());
                ways.push(way(report, body, start, end));
            }
        }
    }
    (curves, ways)
}

/// The way of the centre of a body from `start` to `end`.
fn way(report: &FlowReport, body: &BodyMotion, start: f64, end: f64) -> Series {
    let times = report.bodies.times.iter().zip(&body.track);
    let between = times.filter(|(t, _)| (start..=end).contains(*t)).map(|(_, place)| *place);
    let first = report.bodies.place(body, start);
    let last = report.bodies.place(body, end);
    let places: Vec<[f64; 3]> = std::iter::once(first).chain(between).chain([last]).collect();
    let along = |d: usize| places.iter().map(|p| body.setup.centre[d] + p[d]).collect::<Vec<_>>();
    Series::line("", &along(0), &along(1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{BodiesReport, BodyNumbers};

    const PENDULUM: &str = "
        [[bodies]]
        name = 'bar'
        mass = 1
        centre = [7, 2.75]
        joint = { kind = 'revolute', at = [7, 0] }
        [[bodies]]
        name = 'disc'
        mass = 50
        centre = [7, 6]
        joint = { kind = 'revolute', at = [7, 5.5], to = 'bar' }
        boundary = 'disc'
        [[bodies]]
        name = 'rod'
        mass = 1
        centre = [3, 1]
        joint = { kind = 'revolute', at = [1, 1] }
        [[bodies]]
        name = 'block'
        mass = 1
        centre = [3, 1]
        joint = { kind = 'prismatic', along = [1, 1] }
    ";

    #[derive(serde::Deserialize)]
    struct Case {
        bodies: Vec<RigidBody>,
    }

    #[test]
    fn dry_bodies_are_lines_from_hinge_to_hinge_or_to_their_end() -> Result<(), toml::de::Error> {
        let case: Case = toml::from_str(PENDULUM)?;
        let of = |setup| BodyMotion {
            setup,
            track: vec![],
            coordinates: vec![],
            numbers: BodyNumbers::default(),
        };
        let bodies: Vec<BodyMotion> = case.bodies.into_iter().map(of).collect();
        let report = FlowReport {
            bodies: BodiesReport { bodies, ..BodiesReport::default() },
            ..FlowReport::default()
        };
        let lines: Vec<_> = report.bodies.bodies.iter().map(|body| points(&report, body)).collect();
        assert_eq!(lines[0], Some(vec![[7.0, 0.0], [7.0, 5.5], [7.0, 0.0]]));
        assert_eq!(lines[2], Some(vec![[1.0, 1.0], [5.0, 1.0]]));
        assert_eq!(lines[3], None);
        assert_eq!(links(&report).len(), 2, "the disc is wet");
        Ok(())
    }
}
