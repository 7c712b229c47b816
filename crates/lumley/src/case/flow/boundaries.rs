//! One condition for every boundary of the mesh.

use super::fields::{Given, Parabola, Ramped, TimeTable, check_finite, written};
use super::periodic;
use super::raw::{BoundaryKind, BoundarySection, FlowFile, ProfileShape};
use crate::case::CaseError;
use crate::case::ask::{Ask, Number};
use crate::case::formula::Variables;
use crate::case::suggest::nearest;
use crate::format::csv;
use lumley_fem::{Boundary, PlanarMesh, Point};
use lumley_fom::flow::{Condition, VectorField};
use std::path::Path;
use std::sync::Arc;

/// How far, relative to its length, a boundary may be from straight.
const STRAIGHT: f64 = 1e-9;

/// The conditions in the order of the mesh's boundaries; `times` are the first and the last, in s.
pub(super) fn conditions(
    ask: &Ask,
    file: &FlowFile,
    mesh: &PlanarMesh,
    folder: &Path,
    times: &[f64],
) -> Result<Vec<(String, Condition)>, CaseError> {
    let sections = &file.flow.boundaries;
    check_names(ask, "flow.boundaries", sections.keys(), mesh)?;
    let mut conditions = Vec::new();
    for boundary in mesh.topology().boundaries() {
        let name = &boundary.name;
        let key = format!("flow.boundaries.{name}");
        let Some(section) = sections.get(name) else {
            let expected = "a condition, such as kind = \"no-slip\": the mesh has this boundary";
            return Err(ask.missing(&key, expected));
        };
        let task = Task { ask, key: &key, section, mesh, boundary, folder, times };
        conditions.push((name.clone(), task.condition(file.steady.is_some())?));
    }
    periodic::check(ask, file, mesh)?;
    Ok(conditions)
}

/// Every name under `key` must be that of a boundary.
fn check_names<'a>(
    ask: &Ask,
    key: &str,
    mut names: impl Iterator<Item = &'a String>,
    mesh: &PlanarMesh,
) -> Result<(), CaseError> {
    let found = names.find_map(|name| Some((name, stray(name, mesh)?)));
    let Some((name, expected)) = found else { return Ok(()) };
    Err(ask.refuse(&format!("{key}.{name}"), "a table", &expected))
}

/// What is expected in the place of a name that no boundary has.
pub(super) fn stray(name: &str, mesh: &PlanarMesh) -> Option<String> {
    let known: Vec<&str> =
        mesh.topology().boundaries().iter().map(|boundary| boundary.name.as_str()).collect();
    let hint = nearest(name, &known).map_or(String::new(), |w| format!("; did you mean {w}?"));
    let expected = || format!("a boundary of the mesh: {}{hint}", known.join(", "));
    (!known.contains(&name)).then(expected)
}

/// A boundary and what the case says of it.
struct Task<'a> {
    ask: &'a Ask<'a>,
    key: &'a str,
    section: &'a BoundarySection,
    mesh: &'a PlanarMesh,
    boundary: &'a Boundary,
    folder: &'a Path,
    times: &'a [f64],
}

impl Task<'_> {
    fn condition(&self, steady: bool) -> Result<Condition, CaseError> {
        let section = self.section;
        let velocity = [
            ("velocity", section.velocity.is_some()),
            ("profile", section.profile.is_some()),
            ("peak", section.peak.is_some()),
            ("table", section.table.is_some()),
            ("ramp", section.ramp.is_some()),
            ("ramp_shape", section.ramp_shape.is_some()),
        ];
        let is = |kind| section.kind == kind;
        for (key, given) in velocity {
            self.only(key, given, is(BoundaryKind::Velocity), "kind = \"velocity\"")?;
        }
        let periodic = is(BoundaryKind::Periodic);
        self.only("with", section.with.is_some(), periodic, "kind = \"periodic\"")?;
        Ok(match section.kind {
            BoundaryKind::Velocity => Condition::Velocity(self.velocity(steady)?),
            BoundaryKind::NoSlip => Condition::NoSlip,
            BoundaryKind::Slip => Condition::Slip,
            BoundaryKind::TractionFree => Condition::TractionFree,
            BoundaryKind::Periodic => Condition::Periodic { with: self.other()? },
        })
    }

    /// A key that goes with another one.
    fn only(&self, key: &str, given: bool, fits: bool, other: &str) -> Result<(), CaseError> {
        let expected = format!("nothing: it goes with {other}");
        self.ask.that(!given || fits, &format!("{}.{key}", self.key), "given", &expected)
    }

    fn other(&self) -> Result<String, CaseError> {
        let expected = "with = \"NAME\": the boundary at which the flow goes on";
        self.section.with.clone().ok_or_else(|| self.ask.missing(self.key, expected))
    }

    fn velocity(&self, steady: bool) -> Result<Arc<dyn VectorField>, CaseError> {
        let (ask, section) = (self.ask, self.section);
        let (what, written, field, varies) =
            match (&section.velocity, section.profile, &section.table) {
                (Some(terms), None, None) => {
                    let key = format!("{}.velocity", self.key);
                    let given = Given::read(ask, &key, terms, Variables::PlaceAndTime, "m/s")?;
                    let varies = given.uses_time();
                    ("velocity", written(terms), Arc::new(given) as Arc<dyn VectorField>, varies)
                }
                (None, Some(shape), None) => {
                    ("profile", "parabolic".into(), self.profile(shape)?, false)
                }
                (None, None, Some(table)) => ("table", table.clone(), self.table(table)?, true),
                _ => {
                    let expected = "exactly one of velocity, profile and table";
                    return Err(ask.refuse(self.key, "kind = \"velocity\"", expected));
                }
            };
        self.only("peak", section.peak.is_some(), what == "profile", "profile")?;
        let key = format!("{}.{what}", self.key);
        let still = "a velocity that does not change with time: [steady] seeks the steady flow";
        ask.that(!(steady && varies), &key, &written, still)?;
        let nodes = self.nodes();
        check_finite(ask, (&key, &written), &*field, &nodes, self.times)?;
        self.ramped(field, steady)
    }

    fn ramped(
        &self,
        whole: Arc<dyn VectorField>,
        steady: bool,
    ) -> Result<Arc<dyn VectorField>, CaseError> {
        let (ask, key) = (self.ask, format!("{}.ramp", self.key));
        let Some(time) = self.section.ramp else {
            self.only("ramp_shape", self.section.ramp_shape.is_some(), false, "ramp")?;
            return Ok(whole);
        };
        ask.positive(&key, time, "s")?;
        let still = "nothing: [steady] seeks the steady flow";
        ask.that(!steady, &key, Number(time), still)?;
        Ok(Arc::new(Ramped { whole, time, shape: self.section.ramp_shape.unwrap_or_default() }))
    }

    fn table(&self, name: &str) -> Result<Arc<dyn VectorField>, CaseError> {
        let rows = csv::read_rows::<2>(&self.folder.join(name));
        let key = format!("{}.table", self.key);
        let expected = |e| format!("a table of t in s, u and v in m/s: {e}");
        let rows = rows.map_err(|e| self.ask.refuse(&key, name, &expected(e)))?;
        Ok(Arc::new(TimeTable::new(&rows)))
    }

    fn profile(&self, shape: ProfileShape) -> Result<Arc<dyn VectorField>, CaseError> {
        let (ask, key) = (self.ask, format!("{}.profile", self.key));
        let Some(peak) = self.section.peak else {
            let expected = "peak = the largest velocity in m/s, positive into the domain";
            return Err(ask.missing(&format!("{}.peak", self.key), expected));
        };
        ask.finite(&format!("{}.peak", self.key), peak, "m/s")?;
        let Some((start, span, inward)) = straight(self.mesh, self.boundary) else {
            let expected = "a straight boundary in one piece; give velocity = [\"...\", \"...\"]";
            return Err(ask.refuse(&key, "parabolic", expected));
        };
        match shape {
            ProfileShape::Parabolic => {
                Ok(Arc::new(Parabola { start, span, peak: inward.map(|n| peak * n) }))
            }
        }
    }

    fn nodes(&self) -> Vec<Point> {
        self.boundary.edges.iter().flat_map(|&edge| self.mesh.edge(edge)).collect()
    }
}

/// An end of a straight boundary, the vector to the other end, and the unit vector into the domain.
fn straight(mesh: &PlanarMesh, boundary: &Boundary) -> Option<(Point, Point, Point)> {
    let edges = || boundary.edges.iter().map(|&edge| mesh.edge(edge));
    let [first, second, _] = edges().next()?;
    let along = [0, 1].map(|d| second[d] - first[d]);
    let length = along[0].hypot(along[1]);
    let along = along.map(|a| a / length);
    let position = |p: Point| (p[0] - first[0]) * along[0] + (p[1] - first[1]) * along[1];
    let (mut least, mut most) = (0.0_f64, 0.0_f64);
    for s in edges().flatten().map(position) {
        (least, most) = (least.min(s), most.max(s));
    }
    let tolerance = STRAIGHT * (most - least);
    let beside = |p: Point| (p[1] - first[1]) * along[0] - (p[0] - first[0]) * along[1];
    let is_straight = edges().flatten().all(|p| beside(p).abs() <= tolerance);
    // In one piece and run through once: the edges, all in one direction, add up to the whole.
    let sum: f64 = edges().map(|[a, b, _]| position(b) - position(a)).sum();
    let forwards = edges().all(|[a, b, _]| position(b) > position(a));
    let in_one_piece = forwards && (sum - (most - least)).abs() <= tolerance;
    let end = [0, 1].map(|d| first[d] + least * along[d]);
    let span = along.map(|a| (most - least) * a);
    // Edges have the domain at their left.
    (is_straight && in_one_piece).then_some((end, span, [-along[1], along[0]]))
}
