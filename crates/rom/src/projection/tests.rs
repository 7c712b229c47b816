//! The rates of every projection against the weak equations they come from, by quadrature of the
//! reduced fields themselves.

use super::*;
use crate::EddyViscosity;
use crate::manufactured::{grid_modes, nodes, reference_modes};
use lumley_body::joint::Prismatic;
use lumley_fem::UniformGrid;
use lumley_fem::quadrature::gauss_legendre;
use std::ops::Range;

const NU: f64 = 0.2;
const LENGTH: f64 = 1.1;
const NODES: usize = 57;
/// What differences leave of fifteen digits.
const TOLERANCE: f64 = 1e-10;
const BODY: Motion = Motion { position: 0.913, velocity: 0.37 };
const X: f64 = BODY.position;

fn physics() -> PistonPhysics {
    let joint = Prismatic { mass: 0.5, stiffness: 39.5, damping: 0.1, rest_length: 0.95 };
    PistonPhysics { viscosity: NU, force_factor: 0.8, domain_length: LENGTH, joint }
}

/// One evaluation of a projection at some coefficients, and the fields it stands for.
struct Evaluation {
    basis: Basis,
    a: Vec<f64>,
    rates: Vec<f64>,
    response: Response,
    body: Motion,
}

/// What an integrand may use: a mode, the reduced field and its rate at a point.
struct Point {
    x: f64,
    mode: Field,
    v: Field,
    rate: Field,
}

struct Field {
    value: f64,
    slope: f64,
}

impl Evaluation {
    fn new(basis: Basis, projection: ProjectionKind, closure: ClosureKind, body: Motion) -> Self {
        let mut system = project(&ModelChoice { projection, closure }, &physics(), &basis)
            .expect("a basis in the frame of the projection");
        let modes = (0..basis.modes()).map(|n| 0.3 / (n as f64 + 1.0) - 0.11);
        let a: Vec<f64> = vec![1.0; basis.frozen()].into_iter().chain(modes).collect();
        let mut rates = vec![f64::NAN; a.len()];
        let response = system.rates(body, &a, &mut rates);
        assert!(rates[..basis.frozen()].iter().all(|&rate| rate == 0.0), "a mean stays");
        Self { basis, a, rates, response, body }
    }

    fn on_grid(projection: ProjectionKind, centred: bool) -> Self {
        Self::new(grid_basis(centred), projection, ClosureKind::default(), BODY)
    }

    fn mapped(degree: usize, centred: bool, body: Motion) -> Self {
        let (basis, mapped) = (reference_basis(degree, centred), ProjectionKind::Mapped {});
        Self::new(basis, mapped, ClosureKind::default(), body)
    }

    /// Numbers of the functions that are tested with.
    fn tested(&self) -> Range<usize> {
        self.basis.frozen()..self.a.len()
    }

    /// Coefficients of function `n` alone.
    fn unit(&self, n: usize) -> Vec<f64> {
        (0..self.a.len()).map(|k| f64::from(u8::from(k == n))).collect()
    }

    /// The integral from `from` to `to` of `f`, in which function `n` is the mode.
    fn integral(&self, n: usize, (from, to): (f64, f64), f: impl Fn(Point) -> f64) -> f64 {
        let unit = self.unit(n);
        let mut edges: Vec<f64> = self.basis.nodes().to_vec();
        edges.extend([from, to]);
        edges.retain(|x| (from..=to).contains(x));
        edges.sort_by(f64::total_cmp);
        edges.dedup();
        let mut sum = 0.0;
        for cell in edges.windows(2) {
            let size = cell[1] - cell[0];
            for (s, weight) in gauss_legendre(4) {
                let x = cell[0] + s * size;
                let [mode, v, rate] =
                    [&unit, &self.a, &self.rates].map(|c| self.field(c, x, 0.01 * size));
                sum += weight * size * f(Point { x, mode, v, rate });
            }
        }
        sum
    }

    /// Value and slope, by a difference over ±h that is exact for quadratics.
    fn field(&self, c: &[f64], x: f64, h: f64) -> Field {
        let at = |x| self.basis.evaluate(x, c);
        Field { value: at(x), slope: (at(x + h) - at(x - h)) / (2.0 * h) }
    }

    fn check_block(&self) {
        let joint = physics().joint;
        let load = -physics().force_factor * self.response.traction;
        let expected = joint.acceleration(self.body.position, self.body.velocity, load);
        let gap = self.response.acceleration - expected;
        assert!(gap.abs() < TOLERANCE, "m X'' = f − c_F τ is missed by {gap:e}");
    }
}

/// A basis on the grid; centred, it has a mean that is not orthogonal to its modes.
fn grid_basis(centred: bool) -> Basis {
    let grid = UniformGrid::line(0.0, LENGTH, NODES);
    let modes = grid_modes(&nodes(LENGTH, NODES), 6);
    let mean: Vec<f64> = (0..NODES).map(|k| 0.4 * modes[(k, 0)] + 0.1 * modes[(k, 2)]).collect();
    let kept = modes.subcols(usize::from(centred), 5);
    Basis::on_grid(&grid, kept, centred.then_some(&mean[..])).expect("orthonormal modes")
}

fn reference_basis(degree: usize, centred: bool) -> Basis {
    let nodes = nodes(1.0, NODES);
    let modes = reference_modes(&nodes, degree, 5);
    let mean: Vec<f64> = (0..NODES).map(|k| 0.4 * modes[(k, 0)] + 0.1 * modes[(k, 2)]).collect();
    let kept = modes.subcols(usize::from(centred), 4);
    Basis::on_reference(&nodes, degree, kept, centred.then_some(&mean[..])).expect("good modes")
}

/// `(Φ, v_t) + int_F Φ v v'`: the part that all projections on the grid share.
fn material(e: &Evaluation, n: usize) -> f64 {
    let inertia = e.integral(n, (0.0, LENGTH), |p| p.mode.value * p.rate.value);
    inertia + e.integral(n, (0.0, X), |p| p.mode.value * p.v.value * p.v.slope)
}

/// Multiplier and penalty: `(Φ, v_t) + int_F Φ v v' + ν int Φ' v' = X'' int_S Φ + τ Φ(X)`.
#[test]
fn held_interfaces_satisfy_their_weak_equation() {
    let penalty = ProjectionKind::Penalty(Penalty { sigma: 30.0 });
    for projection in [penalty, ProjectionKind::Multiplier(Multiplier::default())] {
        for centred in [false, true] {
            let e = Evaluation::on_grid(projection, centred);
            for n in e.tested() {
                let viscous = e.integral(n, (0.0, LENGTH), |p| NU * p.mode.slope * p.v.slope);
                let solid = e.integral(n, (X, LENGTH), |p| p.mode.value);
                let force = e.response.traction * e.basis.evaluate(X, &e.unit(n));
                let gap = material(&e, n) + viscous - e.response.acceleration * solid - force;
                assert!(gap.abs() < TOLERANCE, "{projection:?}, {centred}, {n}: {gap:e}");
            }
            e.check_block();
        }
    }
}

/// The paper's forms: the viscous term ends at X, with its boundary term there.
#[test]
fn free_interfaces_satisfy_their_weak_equation() {
    let corrected = (ProjectionKind::Corrected {}, -1.0, X);
    for (projection, boundary, solid_from) in [corrected, (ProjectionKind::Printed {}, 2.0, 0.0)] {
        for centred in [false, true] {
            let e = Evaluation::on_grid(projection, centred);
            let stress = NU * e.field(&e.a, X - 1e-4, 1e-4).slope;
            assert!((e.response.traction - stress).abs() < TOLERANCE);
            for n in e.tested() {
                let viscous = e.integral(n, (0.0, X), |p| NU * p.mode.slope * p.v.slope);
                let solid = e.integral(n, (solid_from, LENGTH), |p| p.mode.value);
                let edge = boundary * stress * e.basis.evaluate(X, &e.unit(n));
                let gap = material(&e, n) + viscous + edge - e.response.acceleration * solid;
                assert!(gap.abs() < TOLERANCE, "{projection:?}, {centred}, {n}: {gap:e}");
            }
            e.check_block();
        }
    }
}

/// `d/dt (v_N(X) − X') = −β (v_N(X) − X')`, the derivative taken along the motion of X.
#[test]
fn multiplier_makes_the_slip_decay_at_its_rate() {
    let beta = 20.0;
    let e = Evaluation::on_grid(ProjectionKind::Multiplier(Multiplier { beta }), true);
    let slope = e.field(&e.a, X - 1e-4, 1e-4).slope;
    let slip = e.basis.evaluate(X, &e.a) - BODY.velocity;
    let rate = e.basis.evaluate(X, &e.rates) + BODY.velocity * slope - e.response.acceleration;
    assert!((rate + beta * slip).abs() < TOLERANCE, "{rate} and {}", -beta * slip);
    assert!(slip.abs() > 0.01, "there is a slip to decay");
}

/// Energy with a penalty: `(v, v_t) = −v(X)³/3 − ν |v'|² + X'' int_S v + τ v(X)`.
#[test]
fn penalty_satisfies_the_energy_balance() {
    let e = Evaluation::on_grid(ProjectionKind::Penalty(Penalty { sigma: 30.0 }), false);
    let growth = e.integral(0, (0.0, LENGTH), |p| p.v.value * p.rate.value);
    let drain = e.integral(0, (0.0, LENGTH), |p| NU * p.v.slope * p.v.slope);
    let solid = e.integral(0, (X, LENGTH), |p| p.v.value);
    let edge = e.basis.evaluate(X, &e.a);
    let work = e.response.acceleration * solid + e.response.traction * edge;
    let gap = growth + edge.powi(3) / 3.0 + drain - work;
    assert!(gap.abs() < TOLERANCE, "{gap:e}");
}

/// Reference frame, `u = X' ξ + w`: `int φ (u_t + w u_ξ/X) + (ν/X²) int φ' u_ξ = 0` for every mode; τ is X
/// times the same with ξ for φ.
#[test]
fn mapped_satisfies_its_weak_equation_and_traction() {
    let v = BODY.velocity;
    for (degree, centred) in [(1, false), (1, true), (2, false), (2, true)] {
        let e = Evaluation::mapped(degree, centred, BODY);
        let material = |p: &Point| {
            e.response.acceleration * p.x + p.rate.value + p.v.value * (v + p.v.slope) / X
        };
        for n in e.tested() {
            let gap = e.integral(n, (0.0, 1.0), |p| {
                p.mode.value * material(&p) + NU / (X * X) * p.mode.slope * (v + p.v.slope)
            });
            assert!(gap.abs() < TOLERANCE, "degree {degree}, {centred}, {n}: {gap:e}");
        }
        let traction = X * e.integral(0, (0.0, 1.0), |p| p.x * material(&p)) + NU * v / X;
        let gap = e.response.traction - traction;
        assert!(gap.abs() < TOLERANCE, "degree {degree}, {centred}: traction off by {gap:e}");
        e.check_block();
    }
}

/// With the block at rest, convection does no work on the flow between two walls.
#[test]
fn mapped_convection_does_no_work() {
    let e = Evaluation::mapped(2, false, Motion { position: X, velocity: 0.0 });
    let balance = e.integral(0, (0.0, 1.0), |p| {
        let inertia = p.v.value * (p.rate.value + e.response.acceleration * p.x);
        inertia + NU / (X * X) * p.v.slope * p.v.slope
    });
    assert!(balance.abs() < TOLERANCE, "{balance:e}");
}

/// Eddy viscosity multiplies the viscous term of equation i by `1 + c i`, i from 1, and nothing else.
#[test]
fn eddy_viscosity_scales_the_viscous_term() {
    let closure = ClosureKind::EddyViscosity(EddyViscosity { rate: 0.05 });
    let penalty = ProjectionKind::Penalty(Penalty::default());
    for centred in [false, true] {
        let [plain, closed] = [ClosureKind::default(), closure]
            .map(|closure| Evaluation::new(grid_basis(centred), penalty, closure, BODY));
        for (i, n) in plain.tested().enumerate() {
            let viscous = plain.integral(n, (0.0, LENGTH), |p| NU * p.mode.slope * p.v.slope);
            let (added, expected) =
                (plain.rates[n] - closed.rates[n], 0.05 * (i + 1) as f64 * viscous);
            assert!((added - expected).abs() < TOLERANCE, "{i}: {added} and {expected}");
        }
    }
}
