//! The flow beside the same equations solved the plain way: element by element, nothing condensed, one sparse LU of
//! the matrix of all velocities and pressures. Only spaces, maps of the cells and the degree of the quadrature are those
//! of the flow.

mod assembly;
mod closed;
mod conditions;
mod plain;

use super::exact;
use super::setups::parameters;
use assembly::Equations;
use conditions::along;
use lumley_fem::space::NodalSpace;
use lumley_fem::{MeshDescription, PlanarMesh, Point};
use lumley_fom::TimeScheme;
use lumley_fom::flow::{
    Condition, Flow, FlowMotion, FlowParameters, FlowSetup, FlowStart, Linearisation, ViscousForm,
};
use lumley_fom::motion::{Motion, MotionError};
use plain::{Instant, Plain, distance};
use std::sync::Arc;

const CELLS: usize = 6;
const STEPS: [f64; 3] = [0.02, 0.03, 0.025];
/// Of the largest value.
const TOLERANCE: f64 = 1e-8;

/// A bent square of triangles and quadrilaterals, all of whose sides are curved.
fn mesh() -> PlanarMesh {
    let cut = |[i, j]: [usize; 2]| (i + 2 * j) % 3 == 0 || i + j > 8;
    let bend = |[x, y]: Point| {
        let s = 0.09 * (2.5 * x + 2.0 * y).sin();
        [x + s, y + 0.12 * x * x - s * (1.0 - y)]
    };
    PlanarMesh::new(MeshDescription::structured([CELLS, CELLS], cut, bend)).expect("a sound mesh")
}

/// All nodes move but those of the top.
#[derive(Clone)]
struct Sway {
    /// Where the nodes are without motion, and their shares in it.
    nodes: Vec<(Point, f64)>,
}

impl Sway {
    fn of(mesh: &PlanarMesh) -> Self {
        let lattice = MeshDescription::structured([CELLS, CELLS], |_| false, |p| p).points;
        let share = lattice.into_iter().map(|[_, y]| 1.0 - y);
        Self { nodes: mesh.nodes().iter().copied().zip(share).collect() }
    }
}

impl Motion for Sway {
    fn carry(&mut self, time: f64, mesh: &mut PlanarMesh) -> Result<(), MotionError> {
        for (node, &([x, y], share)) in mesh.nodes_mut().iter_mut().zip(&self.nodes) {
            let s = 0.08 * share * (6.0 * time).sin();
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

/// A stream with a vortex that lets fluid in again on the right.
fn start([x, y]: Point, _: f64) -> Point {
    let (x, y) = (x - 1.0, y - 0.5);
    let turn = 15.0 * (-9.0 * (x * x + y * y)).exp();
    [0.3 - turn * y, turn * x]
}

fn inflow([_, y]: Point, time: f64) -> Point {
    [0.3 + y * (1.0 - y) * (1.0 + (5.0 * time).sin()), 0.1 * (4.0 * time).cos()]
}

/// Takes the flow and the plain solution step by step, which must agree; `check` sees the flow after each step.
fn side_by_side(
    case: &str,
    parameters: &FlowParameters,
    conditions: &[Condition; 4],
    check: impl Fn(&Flow),
) {
    let mesh = mesh();
    let motion = Sway::of(&mesh);
    let names = ["bottom", "right", "top", "left"].map(str::to_owned);
    let mut flow = Flow::new(FlowSetup {
        mesh: mesh.clone(),
        parameters: parameters.clone(),
        conditions: names.into_iter().zip(conditions.clone()).collect(),
        start: FlowStart::Velocity(Arc::new(start)),
        motion: FlowMotion::Given(Box::new(motion.clone())),
        parallel: false,
    })
    .expect("a sound setup");

    let space = NodalSpace::velocity(mesh.topology());
    let velocity = space.points(&mesh).into_iter().map(|place| start(place, 0.0)).collect();
    let conditions = conditions.to_vec();
    let plain = Plain { parameters: parameters.clone(), conditions, space };
    let mut past = vec![Instant { time: 0.0, mesh, velocity, pressure: Vec::new() }];
    for dt in STEPS {
        flow.step(dt).expect("a step");
        let time = past[0].time + dt;
        let mut mesh = past[0].mesh.clone();
        motion.clone().carry(time, &mut mesh).expect("a sound mesh");
        let (now, equations) = plain.advance(&past, time, mesh);
        check(&flow);
        let apart = differences(&flow, &plain, &now, &equations);
        assert!(apart.iter().all(|&a| a < TOLERANCE), "{case}, t = {time} s: {apart:?}");
        past.insert(0, now);
    }
}

/// Differences of velocity, pressure and loads over the largest velocity, pressure and force.
fn differences(flow: &Flow, plain: &Plain, now: &Instant, equations: &Equations) -> [f64; 3] {
    let nothing = vec![[0.0; 2]; now.velocity.len()];
    let velocity = distance(flow.velocity(), &now.velocity) / distance(&now.velocity, &nothing);
    let (mut apart, mut largest) = (0.0_f64, 0.0_f64);
    for (cell, [a, b, c]) in now.pressure.iter().enumerate() {
        let functions = flow.pressure_functions(cell);
        for &node in now.mesh.topology().cell_nodes(cell) {
            let [x, y] = now.mesh.nodes()[node];
            let values = functions.values([x, y]);
            let found: f64 = values.iter().zip(flow.pressure()[cell]).map(|(f, p)| f * p).sum();
            let expected = a + b * x + c * y;
            apart = apart.max((found - expected).abs());
            largest = largest.max(expected.abs());
        }
    }
    let held = flow.conditions().iter().zip(now.mesh.topology().boundaries()).zip(flow.loads());
    // What the Laplacian form adds to its residual is no residual; `loads` tests it.
    let stress = plain.parameters.viscous_form == ViscousForm::Stress;
    let held =
        held.filter(|((condition, _), _)| stress && !matches!(condition, Condition::TractionFree));
    let (mut lacking, mut force) = (0.0_f64, 0.0_f64);
    for ((_, boundary), found) in held {
        let expected = plain.load(now, equations, &boundary.name);
        let moment = (found.moment - expected.moment).abs();
        lacking = lacking.max(distance(&[found.force], &[expected.force]).max(moment));
        force = force.max(expected.force[0].hypot(expected.force[1]));
    }
    [velocity, apart / largest, lacking / force.max(f64::MIN_POSITIVE)]
}

/// The smallest velocity out of the domain through a boundary.
fn outflow(flow: &Flow, boundary: &str) -> f64 {
    let topology = flow.mesh().topology();
    let boundary = topology.boundary(boundary).expect("a boundary of the mesh");
    let points = along(flow.mesh(), boundary).into_iter().map(|(edge, at, phi)| {
        let dofs = flow.space().dofs().on_edge(topology.edges()[edge].left);
        let out =
            |dof: usize| [0, 1].map(|d| flow.velocity()[dof][d] * at.normal[d]).iter().sum::<f64>();
        dofs.zip(phi).map(|(dof, f)| f * out(dof)).sum::<f64>()
    });
    points.fold(f64::INFINITY, f64::min)
}

const FORMS: [ViscousForm; 2] = [ViscousForm::Stress, ViscousForm::Laplacian];
const SCHEMES: [TimeScheme; 2] = [TimeScheme::ImplicitEuler, TimeScheme::Bdf2];
const LINEARISATIONS: [Linearisation; 3] =
    [Linearisation::Extrapolation, Linearisation::Tangent, Linearisation::Newton];

/// A wall that moves, an outlet where fluid comes back in, a curved wall to slip along, an inlet that pulsates.
#[test]
fn steps_solve_the_equations() {
    let conditions = [
        Condition::NoSlip,
        Condition::TractionFree,
        Condition::Slip,
        Condition::Velocity(Arc::new(inflow)),
    ];
    for form in FORMS {
        for scheme in SCHEMES {
            for linearisation in LINEARISATIONS {
                let mut parameters = parameters(scheme, form, linearisation);
                parameters.viscosity = 0.01;
                let case = format!("{form:?} {scheme:?} {linearisation:?}");
                side_by_side(&case, &parameters, &conditions, |flow| {
                    assert!(outflow(flow, "right") < -0.1, "{case}: nothing comes back in");
                });
            }
        }
    }
}

/// Without an outlet: the pressure has mean zero, and the flux that interpolation leaves goes somewhere.
#[test]
fn steps_in_a_closed_domain_solve_the_equations() {
    let given = || Condition::Velocity(Arc::new(exact::velocity));
    for form in FORMS {
        let parameters = parameters(TimeScheme::Bdf2, form, Linearisation::Newton);
        let conditions = [given(), given(), given(), given()];
        side_by_side(&format!("{form:?}"), &parameters, &conditions, |flow| {
            assert!(flow.has_level_pressure());
        });
    }
}
