//! The equations of the flow, solved the plain way: all unknowns, one sparse LU of one matrix.

use super::assembly::{Equations, Fields};
use super::conditions::Hold;
use faer::Col;
use faer::prelude::Solve;
use faer::sparse::{SparseColMat, Triplet};
use lumley_fem::space::NodalSpace;
use lumley_fem::{PlanarMesh, Point};
use lumley_fom::TimeScheme;
use lumley_fom::flow::{Condition, FlowParameters, Linearisation, Load};
use std::array;

/// Change over the largest velocity where Newton's method stops, a thousandth of the flow's own.
const TOLERANCE: f64 = 1e-12;

/// What does not change.
pub struct Plain {
    pub parameters: FlowParameters,
    /// In the order of the mesh's boundaries.
    pub conditions: Vec<Condition>,
    pub space: NodalSpace,
}

/// The flow at a time.
#[derive(Clone)]
pub struct Instant {
    pub time: f64,
    pub mesh: PlanarMesh,
    pub velocity: Vec<Point>,
    /// By cell: the coefficients of 1, x and y.
    pub pressure: Vec<[f64; 3]>,
}

impl Plain {
    /// The flow at `time` on `mesh`, after the instants of the past, the newest first.
    pub fn advance(&self, past: &[Instant], time: f64, mesh: PlanarMesh) -> (Instant, Equations) {
        let steps = if self.parameters.scheme == TimeScheme::Bdf2 { 2 } else { 1 };
        let past = &past[..steps.min(past.len())];
        let mut now = Instant { time, mesh, velocity: extrapolated(past, time), pressure: vec![] };
        let mut fields = self.fields(past, &now);
        let holds = self.holds(&now, &fields.mesh_velocity);
        for (base, hold) in fields.base.iter_mut().zip(&holds) {
            if let Hold::Velocity(u) = hold {
                *base = *u;
            }
        }
        for _ in 0..20 {
            let mut equations = self.equations(&now, &fields);
            self.close(&now, &holds, &mut equations);
            let solution = solve(&equations, &holds);
            let (velocity, pressure) = solution.split_at(2 * holds.len());
            now.velocity = velocity.as_chunks().0.to_vec();
            now.pressure = pressure.as_chunks().0.to_vec();
            let change = distance(&now.velocity, &fields.base);
            let size = distance(&now.velocity, &vec![[0.0; 2]; holds.len()]);
            if self.parameters.linearisation != Linearisation::Newton || change < TOLERANCE * size {
                return (now, equations);
            }
            fields.base.clone_from(&now.velocity);
        }
        panic!("Newton's method of the reference did not converge at t = {time} s");
    }

    fn fields(&self, past: &[Instant], now: &Instant) -> Fields {
        let times: Vec<f64> = [now.time].into_iter().chain(past.iter().map(|p| p.time)).collect();
        let weights = slopes(&times);
        let dofs = self.space.dofs().len();
        let points = self.space.points(&now.mesh);
        let mut fields = Fields {
            base: now.velocity.clone(),
            mesh_velocity: points.iter().map(|p| p.map(|x| weights[0] * x)).collect(),
            source: match &self.parameters.body_force {
                Some(force) => points.iter().map(|&p| force.value(p, now.time)).collect(),
                None => vec![[0.0; 2]; dofs],
            },
            rate: weights[0],
        };
        for (instant, weight) in past.iter().zip(&weights[1..]) {
            add(&mut fields.mesh_velocity, *weight, &self.space.points(&instant.mesh));
            add(&mut fields.source, -weight, &instant.velocity);
        }
        fields
    }

    /// What the fluid does to a boundary that holds its velocity: `b − A x` of its dofs.
    pub fn load(&self, now: &Instant, equations: &Equations, boundary: &str) -> Load {
        let mut lacking = equations.right.clone();
        let solution = [now.velocity.as_flattened(), now.pressure.as_flattened()].concat();
        for Triplet { row, col, val } in &equations.entries {
            lacking[*row] -= val * solution[*col];
        }
        let points = self.space.points(&now.mesh);
        let topology = now.mesh.topology();
        let boundary = topology.boundary(boundary).expect("a boundary of the mesh");
        let mut load = Load::default();
        for dof in self.space.dofs().on_boundary(topology, boundary) {
            let ([x, y], force) = (points[dof], [lacking[2 * dof], lacking[2 * dof + 1]]);
            load.force = [0, 1].map(|d| load.force[d] + force[d]);
            load.moment += x * force[1] - y * force[0];
        }
        load
    }
}

/// Puts the conditions in the place of the equations that they replace, and solves.
fn solve(equations: &Equations, holds: &[Hold]) -> Vec<f64> {
    let unknowns = equations.right.len();
    let (mut entries, mut right) = (Vec::new(), vec![0.0; unknowns]);
    // Which rows an equation goes to, with which factors.
    let rows = |row: usize| match holds.get(row / 2) {
        Some(Hold::Velocity(_)) => None,
        // The tangential momentum goes first.
        Some(Hold::Slip([nx, ny])) => Some((row - row % 2, [-ny, *nx][row % 2])),
        Some(Hold::Free) | None => Some((row, 1.0)),
    };
    for Triplet { row, col, val } in &equations.entries {
        if let Some((to, factor)) = rows(*row) {
            entries.push(Triplet::new(to, *col, factor * val));
        }
    }
    for (row, value) in equations.right.iter().enumerate() {
        if let Some((to, factor)) = rows(row) {
            right[to] += factor * value;
        }
    }
    for (dof, hold) in holds.iter().enumerate() {
        let [x, y] = [2 * dof, 2 * dof + 1];
        match hold {
            Hold::Free => {}
            Hold::Slip(normal) => entries.extend([x, y].map(|k| Triplet::new(y, k, normal[k - x]))),
            Hold::Velocity(u) => {
                entries.extend([x, y].map(|k| Triplet::new(k, k, 1.0)));
                right[x..=y].copy_from_slice(u);
            }
        }
    }
    let matrix = SparseColMat::try_new_from_triplets(unknowns, unknowns, &entries);
    let lu = matrix.expect("indices in range").sp_lu().expect("a regular matrix");
    lu.solve(&Col::from_fn(unknowns, |i| right[i])).iter().copied().collect()
}

/// Weights of the values at `times` in the slope at the first of them, of the polynomial through all.
fn slopes(times: &[f64]) -> Vec<f64> {
    let gaps = |from: usize, but: &[usize]| -> f64 {
        let others = times.iter().enumerate().filter(|(k, _)| !but.contains(k));
        others.map(|(_, t)| times[from] - t).product()
    };
    let mut weights: Vec<f64> =
        (0..times.len()).map(|k| gaps(0, &[0, k]) / gaps(k, &[k])).collect();
    weights[0] = -weights[1..].iter().sum::<f64>();
    weights
}

/// The past velocity carried on to `time` by the line through the last two instants.
fn extrapolated(past: &[Instant], time: f64) -> Vec<Point> {
    let mut velocity = past[0].velocity.clone();
    if let [now, before] = past {
        let ratio = (time - now.time) / (now.time - before.time);
        add(&mut velocity, ratio, &now.velocity);
        add(&mut velocity, -ratio, &before.velocity);
    }
    velocity
}

fn add(to: &mut [Point], factor: f64, field: &[Point]) {
    for (to, value) in to.iter_mut().zip(field) {
        *to = array::from_fn(|d| to[d] + factor * value[d]);
    }
}

/// Largest distance between vectors.
pub fn distance(one: &[Point], other: &[Point]) -> f64 {
    let distances = one.iter().zip(other).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]));
    distances.fold(0.0, f64::max)
}
