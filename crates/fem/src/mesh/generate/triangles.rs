//! Triangles in a region whose rim is given: Delaunay refinement, then smoothing.

use super::GenerateError;
use super::plane::{
    add, between, cross, distance, distance_to_segment, dot, norm, scale, subtract,
};
use super::size::SizeField;
use super::smooth::smooth;
use crate::Point;
use spade::handles::{FixedFaceHandle, FixedVertexHandle, InnerTag};
use spade::{ConstrainedDelaunayTriangulation, InsertionError, Point2};
use spade::{PositionInTriangulation, Triangulation};
use std::collections::BinaryHeap;

/// The region: corners on its rim and edges between them. The first edge has the region on its left.
pub(super) struct Region {
    pub corners: Vec<Point>,
    pub edges: Vec<[usize; 2]>,
}

/// A triangle is divided when its circumcircle is larger than that of an equilateral one of this many times the
/// wanted size. An average edge is then about as long as wanted.
const LARGE: f64 = 1.3;

/// A new corner stays this far away from an edge of the rim, in lengths of the edge.
const CLEARANCE: f64 = 0.4;

/// Sweeps of smoothing.
const SWEEPS: usize = 10;

type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;
type Face = FixedFaceHandle<InnerTag>;

/// Fills the region: all corners, those on the rim first, and the triangles.
pub(super) fn fill(
    region: &Region,
    field: &SizeField,
    limit: usize,
) -> Result<(Vec<Point>, Vec<[usize; 3]>), GenerateError> {
    let mut points = refine(region, field, limit)?;
    for _ in 0..SWEEPS {
        let triangles = inside(&connect(&points, &region.edges)?, region)?;
        smooth(&mut points, region.corners.len(), &triangles, field);
    }
    let triangles = inside(&connect(&points, &region.edges)?, region)?;
    Ok((points, triangles))
}

fn connect(points: &[Point], edges: &[[usize; 2]]) -> Result<Cdt, GenerateError> {
    let refused = |e: InsertionError| GenerateError::Coordinates { reason: e.to_string() };
    let vertices = points.iter().map(|p| Point2::new(p[0], p[1])).collect();
    let mut crossing = None;
    let cdt = Cdt::try_bulk_load_cdt(vertices, edges.to_vec(), |edge| crossing = Some(edge));
    let cdt = cdt.map_err(refused)?;
    if cdt.num_vertices() < points.len() {
        let reason = format!("{} coincide", points.len() - cdt.num_vertices());
        return Err(GenerateError::Coordinates { reason });
    }
    if crossing.is_some() || cdt.num_constraints() != edges.len() {
        let [a, _] = crossing.unwrap_or(edges[0]);
        return Err(GenerateError::Folded { at: points[a] });
    }
    Ok(cdt)
}

/// The faces of the region: all that can be reached from the first edge without crossing one.
fn faces(cdt: &Cdt, region: &Region) -> Result<Vec<Face>, GenerateError> {
    let [a, b] = region.edges[0].map(FixedVertexHandle::from_index);
    let edge = cdt.get_edge_from_neighbors(a, b);
    let first = edge.and_then(|edge| edge.face().as_inner()).map(|face| face.fix());
    let first = first.ok_or(GenerateError::Folded { at: region.corners[a.index()] })?;
    let mut seen = vec![false; cdt.num_all_faces()];
    seen[first.index()] = true;
    let mut found = vec![first];
    let mut next = 0;
    while next < found.len() {
        for edge in cdt.face(found[next]).adjacent_edges() {
            if edge.is_constraint_edge() {
                continue;
            }
            if let Some(face) = edge.rev().face().as_inner().map(|face| face.fix())
                && !std::mem::replace(&mut seen[face.index()], true)
            {
                found.push(face);
            }
        }
        next += 1;
    }
    found.sort_unstable();
    Ok(found)
}

fn inside(cdt: &Cdt, region: &Region) -> Result<Vec<[usize; 3]>, GenerateError> {
    let corners = |face: Face| cdt.face(face).vertices().map(|v| v.fix().index());
    Ok(faces(cdt, region)?.into_iter().map(corners).collect())
}

/// The corners of a triangulation whose triangles are as large as wanted.
fn refine(region: &Region, field: &SizeField, limit: usize) -> Result<Vec<Point>, GenerateError> {
    let mut cdt = connect(&region.corners, &region.edges)?;
    let first = faces(&cdt, region)?;
    let mut queue: BinaryHeap<Large> =
        first.into_iter().filter_map(|face| Large::new(&cdt, face, field)).collect();
    while let Some(large) = queue.pop() {
        let Some(p) = large.division(&cdt, field) else { continue };
        let hint = large.corners[0];
        let refused = |e: InsertionError| GenerateError::Coordinates { reason: e.to_string() };
        let new = cdt.insert_with_hint(Point2::new(p[0], p[1]), hint).map_err(refused)?;
        if cdt.num_inner_faces() > limit.saturating_mul(2) {
            return Err(GenerateError::TooManyCells { limit });
        }
        let around = cdt.vertex(new).out_edges().filter_map(|edge| edge.face().as_inner());
        queue.extend(around.filter_map(|face| Large::new(&cdt, face.fix(), field)));
    }
    Ok(cdt.vertices().map(|v| position(v.position())).collect())
}

fn position(p: Point2<f64>) -> Point {
    [p.x, p.y]
}

/// A triangle that is larger than wanted; the largest goes first.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Large {
    /// How many times larger, a positive float: its bits have its order.
    excess: u64,
    corners: [FixedVertexHandle; 3],
    face: Face,
}

impl Large {
    fn new(cdt: &Cdt, face: Face, field: &SizeField) -> Option<Self> {
        let corners = cdt.face(face).vertices();
        let [a, b, c] = corners.map(|v| position(v.position()));
        let radius = distance(circumcentre([a, b, c]), a);
        let wanted = field.at(scale(1.0 / 3.0, add(a, add(b, c)))) / 3.0_f64.sqrt();
        let excess = radius / wanted;
        (excess > LARGE).then(|| Self {
            excess: excess.to_bits(),
            corners: corners.map(|v| v.fix()),
            face,
        })
    }

    /// The new corner that divides it, unless it is no longer there or the rim is in the way.
    fn division(&self, cdt: &Cdt, field: &SizeField) -> Option<Point> {
        let face = cdt.face(self.face); // faces are changed, never removed
        if face.vertices().map(|v| v.fix()) != self.corners {
            return None;
        }
        let corners = face.vertices().map(|v| position(v.position()));
        let p = apex(corners, field);
        let centre = scale(1.0 / 3.0, corners.into_iter().fold([0.0; 2], add));
        let [from, to] = [centre, p].map(|q| Point2::new(q[0], q[1]));
        if cdt.get_conflicting_edges_between_points(from, to).next().is_some() {
            return None;
        }
        let PositionInTriangulation::OnFace(face) = cdt.locate_with_hint(to, self.corners[0])
        else {
            return None;
        };
        let too_near = cdt.face(face).adjacent_edges().into_iter().any(|edge| {
            let ends = edge.positions().map(position);
            let clearance = CLEARANCE * distance(ends[0], ends[1]);
            edge.is_constraint_edge() && distance_to_segment(p, ends) < clearance
        });
        (!too_near).then_some(p)
    }
}

/// Where a triangle of the wanted size has its third corner over the shortest edge, but no farther than the
/// circumcentre ("off-centre", Üngör 2009; also Rebay 1993): triangles grow from small edges row by row.
fn apex([a, b, c]: [Point; 3], field: &SizeField) -> Point {
    let edges = [[a, b], [b, c], [c, a]];
    let length = |[p, q]: [Point; 2]| distance(p, q);
    let shortest = edges.into_iter().min_by(|e, f| length(*e).total_cmp(&length(*f)));
    let [p, q] = shortest.expect("a triangle has edges");
    let (middle, base) = (between(p, q, 0.5), length([p, q]));
    let up = subtract(circumcentre([a, b, c]), middle);
    let side = field.at(middle).clamp(0.75 * base, 1.5 * base);
    let height = (side * side - 0.25 * base * base).sqrt();
    let share = (height / norm(up)).min(1.0);
    add(middle, scale(share, up))
}

fn circumcentre([a, b, c]: [Point; 3]) -> Point {
    let (u, v) = (subtract(b, a), subtract(c, a));
    let twice = 2.0 * cross(u, v);
    let (uu, vv) = (dot(u, u) / twice, dot(v, v) / twice);
    add(a, [v[1] * uu - u[1] * vv, u[0] * vv - v[0] * uu])
}
