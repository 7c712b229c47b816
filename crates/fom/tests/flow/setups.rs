//! Meshes, motions and flows of the tests.

use super::exact;
use lumley_fem::element::{Cell, P2Bubble, Q2, TriangleP2};
use lumley_fem::geometry::{Mapped, Tabulated};
use lumley_fem::quadrature::rule;
use lumley_fem::{MeshDescription, PlanarMesh, Point};
use lumley_fom::TimeScheme;
use lumley_fom::flow::{
    Condition, Flow, FlowMotion, FlowParameters, FlowSetup, FlowStart, Linearisation, ViscousForm,
};
use lumley_fom::motion::{Motion, MotionError};
use std::sync::Arc;

/// Which cells a mesh has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    Triangles,
    Quadrilaterals,
    Both,
}

pub const KINDS: [Kind; 3] = [Kind::Triangles, Kind::Quadrilaterals, Kind::Both];

/// The unit square bent so that no edge is straight.
fn bend([x, y]: Point) -> Point {
    let s = 0.08 * (2.0 * x + 3.0 * y).sin();
    [x + s * (1.0 + y), y + 0.5 * s + 0.1 * x * x]
}

/// A bent square of n x n cells.
pub fn mesh(kind: Kind, n: usize) -> PlanarMesh {
    let cut = |[i, j]: [usize; 2]| match kind {
        Kind::Triangles => true,
        Kind::Quadrilaterals => false,
        Kind::Both => (i + j) % 2 == 0 || j < n / 2,
    };
    PlanarMesh::new(MeshDescription::structured([n, n], cut, bend)).expect("a sound mesh")
}

/// A smooth motion of all nodes.
pub struct Wobble {
    reference: Vec<Point>,
    speed: f64,
}

impl Wobble {
    pub fn of(mesh: &PlanarMesh, speed: f64) -> Box<dyn Motion> {
        Box::new(Self { reference: mesh.nodes().to_vec(), speed })
    }
}

impl Motion for Wobble {
    fn carry(&mut self, time: f64, mesh: &mut PlanarMesh) -> Result<(), MotionError> {
        let s = 0.05 * (self.speed * time).sin();
        for (node, &[x, y]) in mesh.nodes_mut().iter_mut().zip(&self.reference) {
            *node = [x + s * (3.0 * y).cos(), y + s * (2.0 * x - y).sin()];
        }
        Ok(())
    }

    fn boundaries(&self) -> Vec<&str> {
        Vec::new()
    }

    fn pivot(&self, _: usize) -> Point {
        unreachable!("no boundary moves as a body")
    }
}

pub fn parameters(
    scheme: TimeScheme,
    form: ViscousForm,
    linearisation: Linearisation,
) -> FlowParameters {
    FlowParameters {
        density: exact::DENSITY,
        viscosity: exact::VISCOSITY,
        viscous_form: form,
        linearisation,
        scheme,
        body_force: Some(Arc::new(exact::force)),
    }
}

/// Radii of the ring, in m.
pub const INNER: f64 = 0.5;
pub const OUTER: f64 = 1.5;

/// A ring with a closed inside `bottom` and outside `top`, as the ends of the bent strip are made one.
pub fn ring(n: usize) -> PlanarMesh {
    let map = |[x, y]: Point| {
        let (sin, cos) = (-std::f64::consts::TAU * x).sin_cos();
        let radius = INNER + (OUTER - INNER) * y;
        [radius * cos, radius * sin]
    };
    let mut mesh = MeshDescription::structured([4 * n, n], |[i, _]| i % 2 == 0, map);
    // The nodes at the end of each row are those at its beginning.
    let row = 8 * n + 1;
    let first = |node: &mut usize| {
        *node -= if *node % row == row - 1 { row - 1 } else { 0 };
        *node -= *node / row;
    };
    mesh.triangles.iter_mut().flatten().for_each(first);
    mesh.quadrilaterals.iter_mut().flatten().for_each(first);
    mesh.boundaries.retain(|boundary| ["bottom", "top"].contains(&boundary.name.as_str()));
    mesh.boundaries.iter_mut().flat_map(|b| &mut b.edges).flatten().for_each(first);
    let points = mesh.points.iter().enumerate();
    mesh.points = points.filter(|(k, _)| k % row != row - 1).map(|(_, point)| *point).collect();
    PlanarMesh::new(mesh).expect("a ring")
}

/// The fluid of the exact flow without its force.
pub fn fluid(form: ViscousForm) -> FlowParameters {
    let parameters = parameters(TimeScheme::Bdf2, form, Linearisation::default());
    FlowParameters { body_force: None, ..parameters }
}

/// The exact flow's boundary values all round.
pub fn enclosed(
    mesh: PlanarMesh,
    parameters: FlowParameters,
    motion: FlowMotion,
    parallel: bool,
) -> Flow {
    let given = || Condition::Velocity(Arc::new(exact::velocity));
    let sides = ["bottom", "right", "top", "left"].map(|name| (name.to_owned(), given()));
    let start = FlowStart::Velocity(Arc::new(exact::velocity));
    let conditions = sides.into();
    Flow::new(FlowSetup { mesh, parameters, conditions, start, motion, parallel })
        .expect("a sound setup")
}

/// L2 errors of the velocity and of the pressure.
pub fn errors(flow: &Flow) -> [f64; 2] {
    let (mesh, time) = (flow.mesh(), flow.time());
    let triangles = mesh.topology().triangles().len();
    let mut sums = [0.0; 2];
    let mut level = [0.0; 2];
    let points = {
        let rule = rule(Cell::Triangle, 8);
        (Tabulated::<7>::on(&P2Bubble, &rule), Tabulated::<6>::on(&TriangleP2, &rule))
    };
    let square = Tabulated::<9>::on(&Q2, &rule(Cell::Quadrilateral, 9));
    let visit = |see: &mut dyn FnMut(Point, f64, Point, f64)| {
        for cell in 0..mesh.topology().cells() {
            let dofs = flow.space().dofs().cell(cell);
            let functions = flow.pressure_functions(cell);
            let p = |at: Point| -> f64 {
                functions.values(at).iter().zip(flow.pressure()[cell]).map(|(f, p)| f * p).sum()
            };
            let u = |phi: &[f64]| {
                [0, 1].map(|d| dofs.iter().zip(phi).map(|(&k, f)| flow.velocity()[k][d] * f).sum())
            };
            if cell < triangles {
                for (v, g) in points.0.iter().zip(&points.1) {
                    let mapped = Mapped::new(&mesh.triangle(cell), g);
                    see(mapped.point, mapped.weight, u(&v.phi), p(mapped.point));
                }
            } else {
                for v in &square {
                    let mapped = Mapped::new(&mesh.quadrilateral(cell - triangles), v);
                    see(mapped.point, mapped.weight, u(&v.phi), p(mapped.point));
                }
            }
        }
    };
    if flow.has_level_pressure() {
        visit(&mut |at, w, _, p| {
            level[0] += w * (p - exact::pressure(at, time));
            level[1] += w;
        });
    } else {
        level[1] = 1.0;
    }
    visit(&mut |at, w, u, p| {
        let exact = exact::velocity(at, time);
        sums[0] += w * ((u[0] - exact[0]).powi(2) + (u[1] - exact[1]).powi(2));
        sums[1] += w * (p - exact::pressure(at, time) - level[0] / level[1]).powi(2);
    });
    sums.map(f64::sqrt)
}

/// Slope of the errors between two sizes, the second half of the first.
pub fn order(coarse: f64, fine: f64) -> f64 {
    (coarse / fine).log2()
}
