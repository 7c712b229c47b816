use super::series;
use crate::Error;
use crate::case::FlowCase;
use crate::model::FlowModel;
use crate::record::{Record, Series};
use lumley_fem::transfer::{Bodies, Place, PlanarTransfer, Transfer};
use lumley_fem::{PlanarMesh, Point, UniformGrid};
use lumley_fom::motion::RigidMotion;

/// For each node of `grid` whether it is in the fluid at every snapshot of `record`.
pub(super) fn always_fluid(
    case: &FlowCase,
    model: &FlowModel,
    grid: &UniformGrid,
    record: &Record,
) -> Result<Vec<bool>, Error> {
    let moving = moving(case, record)?;
    let solids: Vec<&str> = model.bodies_in_it().collect();
    let moves: Vec<bool> =
        solids.iter().map(|name| moving.iter().any(|body| body.boundary == *name)).collect();
    let bodies = Bodies::new(&case.mesh, &solids).expect("each of them is a body");
    let method = Transfer::FiniteElement {};
    let transfer = PlanarTransfer::new(method, grid.clone(), bodies);
    let mut transfer = transfer.expect("a method without parameters");
    transfer.update(&case.mesh);
    let is_fluid = |(node, place): (usize, &Place)| {
        let stays = match place {
            Place::Fluid(_) => true,
            Place::Solid(body) => moves[*body],
            Place::Outside => false,
        };
        stays && !moving.iter().any(|body| body.covers(grid.point(node)))
    };
    Ok(transfer.places().iter().enumerate().map(is_fluid).collect())
}

/// A body that moves, in the mesh as given, and where it was at all snapshots.
struct Moving<'a> {
    mesh: &'a PlanarMesh,
    boundary: &'a str,
    outline: Bodies,
    pivot: Point,
    /// How far from the pivot its points are at most, in m.
    reach: f64,
    places: &'a Series,
    snapshots: usize,
    /// Lower and upper corner of a box that it never left, in m.
    within: [Point; 2],
}

fn moving<'a>(case: &'a FlowCase, record: &'a Record) -> Result<Vec<Moving<'a>>, Error> {
    let Some(choice) = &case.bodies else { return Ok(Vec::new()) };
    let kinematics = lumley_body::Kinematics::new(&choice.tree);
    let names = series::positions(&choice.tree);
    let mut found = Vec::new();
    for (k, (body, name)) in choice.tree.bodies().iter().zip(&names).enumerate() {
        let Some(boundary) = body.boundary.as_deref() else { continue };
        let (mesh, pivot) = (&case.mesh, kinematics.placement(k).pivot);
        let outline = Bodies::new(mesh, &[boundary]).expect("a checked boundary of a body");
        let (reach, places) = (reach(mesh, boundary, pivot), record.series(name)?);
        let (snapshots, within) = (record.len(), within(pivot, reach, places));
        found.push(Moving { mesh, boundary, outline, pivot, reach, places, snapshots, within });
    }
    Ok(found)
}

/// Edges are within the triangles of their control points.
fn reach(mesh: &PlanarMesh, boundary: &str, pivot: Point) -> f64 {
    let edges = mesh.topology().boundary(boundary).map_or(&[][..], |found| &found.edges);
    let control = |&edge: &usize| {
        let [a, b, middle] = mesh.edge(edge);
        [a, b, [0, 1].map(|d| 2.0 * middle[d] - 0.5 * (a[d] + b[d]))]
    };
    let points = edges.iter().flat_map(control);
    points.map(|[x, y]| (x - pivot[0]).hypot(y - pivot[1])).fold(0.0, f64::max)
}

/// A box about all places of a pivot and what is in reach of it.
fn within(pivot: Point, reach: f64, places: &Series) -> [Point; 2] {
    let corner = |start: f64, sign: f64, choose: fn(f64, f64) -> f64| {
        [0, 1].map(|d| pivot[d] + sign * reach + places.entry(d).fold(start, choose))
    };
    [corner(f64::INFINITY, -1.0, f64::min), corner(f64::NEG_INFINITY, 1.0, f64::max)]
}

impl Moving<'_> {
    /// Whether the point is in the body at any snapshot.
    fn covers(&self, point: Point) -> bool {
        let [lower, upper] = self.within;
        let is_near = (0..2).all(|d| lower[d] <= point[d] && point[d] <= upper[d]);
        is_near && (0..self.snapshots).any(|k| self.covers_at(self.places.at(k), point))
    }

    /// Brings the point to where it would be in the mesh as given.
    fn covers_at(&self, place: &[f64], point: Point) -> bool {
        let &[dx, dy, angle] = place else { panic!("x, y and angle") };
        let moved = [point[0] - dx, point[1] - dy];
        if (moved[0] - self.pivot[0]).hypot(moved[1] - self.pivot[1]) > self.reach {
            return false;
        }
        let back = RigidMotion { translation: [0.0; 2], angle: -angle };
        self.outline.containing(self.mesh, back.place(self.pivot, moved)).is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumley_fem::generate::Channel;
    use std::f64::consts::FRAC_PI_2;

    /// A disc of radius 0.1 m that is held at a point of its rim, which goes half a metre to the right while the disc
    /// turns by a right angle about it.
    #[test]
    fn a_body_covers_what_it_covered_at_any_snapshot() -> Result<(), Box<dyn std::error::Error>> {
        let channel: Channel = toml::from_str(
            "x = [0, 2]\ny = [0, 1]\nsize = 0.2
             bodies = [{ name = 'disc', size = 0.03, shape = { kind = 'disc', centre = [0.7, 0.5], radius = 0.1 } }]",
        )?;
        let mesh = PlanarMesh::new(channel.mesh()?)?;
        let pivot = [0.6, 0.5];
        let places = Series::new(3, vec![0.0, 0.0, 0.0, 0.5, 0.0, FRAC_PI_2]);
        let reach = reach(&mesh, "disc", pivot);
        let body = Moving {
            outline: Bodies::new(&mesh, &["disc"])?,
            within: within(pivot, reach, &places),
            places: &places,
            snapshots: 2,
            reach,
            mesh: &mesh,
            boundary: "disc",
            pivot,
        };
        assert!((0.2..0.205).contains(&reach), "{reach}");
        assert_eq!(body.within, [[0.6 - reach, 0.5 - reach], [1.1 + reach, 0.5 + reach]]);
        // About (0.7, 0.5) at first, then about (1.1, 0.6).
        for [x, y] in [[0.7, 0.5], [1.1, 0.6]] {
            for [dx, dy] in [[0.0, 0.0], [0.098, 0.0], [-0.098, 0.0], [0.0, 0.098], [0.0, -0.098]] {
                assert!(body.covers([x + dx, y + dy]), "{x} + {dx}, {y} + {dy}");
            }
            for [dx, dy] in [[0.102, 0.0], [-0.102, 0.0], [0.0, 0.102], [0.0, -0.102]] {
                assert!(!body.covers([x + dx, y + dy]), "{x} + {dx}, {y} + {dy}");
            }
        }
        Ok(())
    }
}
