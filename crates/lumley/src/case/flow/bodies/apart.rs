use crate::case::CaseError;
use crate::case::ask::Ask;
use lumley_body::joint::Joint;
use lumley_body::{Kinematics, Placement, RigidBody, Tree};
use lumley_fem::{PlanarMesh, Point};

/// A boundary where it is at the start, as chords between its nodes.
struct Outline<'a> {
    name: &'a str,
    body: Option<&'a RigidBody>,
    chords: Vec<[Point; 2]>,
    /// Lower and upper corner of the rectangle round it.
    bounds: [Point; 2],
}

/// Refuses bodies that meet each other or a wall where they start. As the mesh has them, they are apart.
pub(super) fn check(ask: &Ask, tree: &Tree, mesh: &PlanarMesh) -> Result<(), CaseError> {
    let Some(outlines) = outlines(tree, mesh) else { return Ok(()) };
    for (k, own) in outlines.iter().enumerate() {
        let Some(body) = own.body else { continue };
        let others: Vec<&Outline<'_>> = outlines[..k].iter().chain(&outlines[k + 1..]).collect();
        let Some((other, near)) = own.meets(&others) else { continue };
        let (body, place) = (body.name.clone(), ask.place(&key(body)));
        return Err(CaseError::Meets { place, body, other, near });
    }
    Ok(())
}

/// The key that says where a body starts.
fn key(body: &RigidBody) -> String {
    let key = if matches!(body.joint, Joint::Prescribed(_)) { "joint" } else { "start" };
    format!("bodies.{}.{key}", body.name)
}

/// All boundaries; none if every body starts where the mesh has it.
fn outlines<'a>(tree: &'a Tree, mesh: &'a PlanarMesh) -> Option<Vec<Outline<'a>>> {
    let start = tree.start(0.0).expect("prescribed motions were finite at the start");
    let mut kinematics = Kinematics::new(tree);
    kinematics.update(&start.position, &start.velocity, &vec![0.0; start.position.len()]);
    let mut moved = false;
    let outlines = mesh.topology().boundaries().iter().map(|boundary| {
        let owner = |body: &RigidBody| body.boundary.as_ref() == Some(&boundary.name);
        let body = tree.bodies().iter().position(owner);
        let placement = body.map(|body| kinematics.placement(body));
        moved |= placement.is_some_and(|p| p.translation != [0.0; 2] || p.rotation != 0.0);
        let place = |point| placement.as_ref().map_or(point, |p: &Placement| p.place(point));
        let chords = boundary.edges.iter().flat_map(|&edge| {
            let [a, b, middle] = mesh.edge(edge).map(place);
            [[a, middle], [middle, b]]
        });
        Outline::new(&boundary.name, body.map(|k| &tree.bodies()[k]), chords.collect())
    });
    let outlines = outlines.collect();
    moved.then_some(outlines)
}

impl<'a> Outline<'a> {
    fn new(name: &'a str, body: Option<&'a RigidBody>, chords: Vec<[Point; 2]>) -> Self {
        let bounds = bounds(chords.as_flattened());
        Self { name, body, chords, bounds }
    }

    /// What this body meets, and where: what it crosses, is within or goes round, or the wall nearest to it when it
    /// is beyond them all.
    fn meets(&self, others: &[&Outline<'_>]) -> Option<(String, Point)> {
        let near = self.chords[0][0];
        let walls = || others.iter().filter(|other| other.body.is_none());
        let crossed = others.iter().find_map(|other| Some((*other, self.crosses(other)?)));
        let one_in_the_other = |other: &&&Outline<'_>| {
            other.body.is_some() && encloses(&other.chords, near)
                || encloses(&self.chords, other.chords[0][0])
        };
        let round = || Some((*others.iter().find(one_in_the_other)?, near));
        let beyond = || {
            let within = encloses(walls().flat_map(|wall| &wall.chords), near);
            let distance = |wall: &&Outline<'_>| wall.distance(near);
            let nearest = walls().min_by(|a, b| distance(a).total_cmp(&distance(b)));
            nearest.filter(|_| !within).map(|wall| (*wall, near))
        };
        let (other, near) = crossed.or_else(round).or_else(beyond)?;
        Some((other.title(), near))
    }

    fn title(&self) -> String {
        match self.body {
            Some(body) => format!("the body {}", body.name),
            None => format!("the boundary {}", self.name),
        }
    }

    /// Where the two cross or touch, if they do.
    fn crosses(&self, other: &Self) -> Option<Point> {
        if apart(&self.bounds, &other.bounds) {
            return None;
        }
        let near: Vec<_> = other.chords.iter().filter(|c| !apart(c, &self.bounds)).collect();
        let crossed = self.chords.iter().find(|own| near.iter().any(|c| cross(own, c)));
        crossed.map(|chord| chord[0])
    }

    /// Distance of a point from the nearest node, in m.
    fn distance(&self, [x, y]: Point) -> f64 {
        let nodes = self.chords.as_flattened().iter();
        nodes.map(|[a, b]| (a - x).hypot(b - y)).fold(f64::INFINITY, f64::min)
    }
}

/// Whether a point is within closed outlines: an odd number of chords crosses the ray from it to the left.
fn encloses<'a>(chords: impl IntoIterator<Item = &'a [Point; 2]>, [x, y]: Point) -> bool {
    let crosses = |[a, b]: &&[Point; 2]| {
        (a[1] <= y) != (b[1] <= y) && a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) <= x
    };
    chords.into_iter().filter(crosses).count() % 2 == 1
}

fn bounds(points: &[Point]) -> [Point; 2] {
    let of = |start: f64, choose: fn(f64, f64) -> f64| {
        [0, 1].map(|d| points.iter().map(|p| p[d]).fold(start, choose))
    };
    [of(f64::INFINITY, f64::min), of(f64::NEG_INFINITY, f64::max)]
}

/// Whether the rectangles round two pairs of points have none in common.
fn apart(one: &[Point; 2], other: &[Point; 2]) -> bool {
    let ([l, u], [m, v]) = (bounds(one), bounds(other));
    (0..2).any(|d| u[d] < m[d] || v[d] < l[d])
}

/// Whether two chords have a point in common.
fn cross(one: &[Point; 2], other: &[Point; 2]) -> bool {
    let divides = |[a, b]: &[Point; 2], points: &[Point; 2]| {
        let side = |p: &Point| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
        let [s, t] = [side(&points[0]), side(&points[1])];
        s == 0.0 || t == 0.0 || (s < 0.0) != (t < 0.0)
    };
    !apart(one, other) && divides(one, other) && divides(other, one)
}
