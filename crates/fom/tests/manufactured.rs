//! Orders of convergence on a manufactured solution of the coupled equations, the mesh in motion.
//!
//! With `V = X'` and the sources that make it so, `u = V xi + A sin(pi xi)`, `xi = x/X`.

use lumley_body::joint::Prismatic;
use lumley_fom::{Forcing, InitialFlow, Piston, PistonError, PistonParameters, TimeScheme};
use std::f64::consts::PI;

const VISCOSITY: f64 = 0.1;
const FORCE_FACTOR: f64 = 0.7;
const JOINT: Prismatic = Prismatic { mass: 0.4, stiffness: 9.0, damping: 0.3, rest_length: 0.75 };

/// X, X', X'' at time t.
fn interface(t: f64) -> [f64; 3] {
    let (sin, cos) = (3.0 * t).sin_cos();
    [0.8 + 0.1 * sin, 0.3 * cos, -0.9 * sin]
}

/// A, A' at time t.
fn amplitude(t: f64) -> [f64; 2] {
    let (sin, cos) = (2.0 * t + 0.4).sin_cos();
    [0.5 * cos, -sin]
}

fn velocity(xi: f64, t: f64) -> f64 {
    interface(t)[1] * xi + amplitude(t)[0] * (PI * xi).sin()
}

fn traction(t: f64) -> f64 {
    let [x, v, _] = interface(t);
    VISCOSITY / x * (v - PI * amplitude(t)[0])
}

#[derive(Debug)]
struct Sources;

impl Forcing for Sources {
    /// `u_t + (u − xi V) u_xi/X − nu u_xixi/X²`, u_t at fixed xi.
    fn fluid(&self, xi: f64, t: f64) -> f64 {
        let ([x, v, acceleration], [a, a_t]) = (interface(t), amplitude(t));
        let (sin, cos) = (PI * xi).sin_cos();
        let (u_t, u_xi) = (acceleration * xi + a_t * sin, v + PI * a * cos);
        u_t + a * sin * u_xi / x + VISCOSITY * PI * PI * a * sin / (x * x)
    }

    /// `m X'' − f(X, X') + c_F nu u_x(X−)`.
    fn body(&self, t: f64) -> f64 {
        let [x, v, acceleration] = interface(t);
        JOINT.mass * acceleration - JOINT.force(x, v) + FORCE_FACTOR * traction(t)
    }
}

fn piston(cells: usize, degree: usize, scheme: TimeScheme) -> Result<Piston, PistonError> {
    let [position, velocity, _] = interface(0.0);
    let parameters = PistonParameters {
        viscosity: VISCOSITY,
        domain_length: 1.0,
        force_factor: FORCE_FACTOR,
        joint: JOINT,
        initial_position: position,
        initial_velocity: velocity,
        initial_flow: InitialFlow::Sine(amplitude(0.0)[0]),
    };
    Piston::forced(&parameters, cells, degree, scheme, Box::new(Sources))
}

/// Errors of u (root mean square over the fluid), X, X' and the traction, at this instant.
fn errors(piston: &Piston) -> [f64; 4] {
    let t = piston.time();
    let [x, v, _] = interface(t);
    let samples = (0..200).map(|k| (f64::from(k) + 0.5) / 200.0);
    let square: f64 = samples
        .map(|xi| (piston.velocity_at(xi * piston.interface()) - velocity(xi, t)).powi(2))
        .sum();
    let body = [piston.interface() - x, piston.body().velocity[0] - v];
    let traction = piston.traction() - traction(t);
    [(square / 200.0).sqrt(), body[0].abs(), body[1].abs(), traction.abs()]
}

/// The slopes of the errors between the first and the last refinement, each by a factor of two.
fn orders(errors: &[[f64; 4]]) -> [f64; 4] {
    let (first, last) = (errors[0], errors[errors.len() - 1]);
    [0, 1, 2, 3].map(|k| (first[k] / last[k]).log2() / (errors.len() - 1) as f64)
}

/// The largest of each error over the steps of these lengths; one instant alone may be lucky.
fn worst(
    mut piston: Piston,
    steps: usize,
    length: impl Fn(usize) -> f64,
) -> Result<[f64; 4], PistonError> {
    let mut worst = [0.0; 4];
    for step in 0..steps {
        piston.step(length(step))?;
        let found = errors(&piston);
        worst = [0, 1, 2, 3].map(|k| f64::max(worst[k], found[k]));
    }
    Ok(worst)
}

fn space(degree: usize, cells: [usize; 3]) -> Result<[f64; 4], PistonError> {
    let of = |cells| worst(piston(cells, degree, TimeScheme::CrankNicolson)?, 400, |_| 5e-4);
    Ok(orders(&[of(cells[0])?, of(cells[1])?, of(cells[2])?]))
}

fn time(scheme: TimeScheme, length: fn(f64, usize) -> f64) -> Result<[f64; 4], PistonError> {
    let of = |steps: usize| {
        worst(piston(100, 2, scheme)?, steps, |step| length(1.0 / steps as f64, step))
    };
    Ok(orders(&[of(40)?, of(80)?, of(160)?]))
}

fn equal(dt: f64, _: usize) -> f64 {
    dt
}

/// Ratios of 1.5 and 2/3 in turns.
fn unequal(dt: f64, step: usize) -> f64 {
    if step.is_multiple_of(2) { 0.8 * dt } else { 1.2 * dt }
}

/// Steps that grow by a ratio of 5, where BDF2 starts again, and shrink by it.
fn restarting(dt: f64, step: usize) -> f64 {
    if step.is_multiple_of(2) { dt / 3.0 } else { 5.0 * dt / 3.0 }
}

#[test]
fn degree_1_is_second_order_in_space() -> Result<(), PistonError> {
    let orders = space(1, [8, 16, 32])?;
    assert!(orders.iter().all(|order| (order - 2.0).abs() < 0.1), "{orders:?}");
    Ok(())
}

/// Third order in L2, and about fourth in what the interface sees.
#[test]
fn degree_2_is_third_order_in_space_and_better_at_the_interface() -> Result<(), PistonError> {
    let orders = space(2, [4, 8, 16])?;
    assert!((orders[0] - 3.0).abs() < 0.1, "{orders:?}");
    assert!(orders[1..].iter().all(|order| *order > 3.5), "{orders:?}");
    Ok(())
}

#[test]
fn schemes_have_their_orders_in_time() -> Result<(), PistonError> {
    for (scheme, expected) in [
        (TimeScheme::ImplicitEuler, 1.0),
        (TimeScheme::CrankNicolson, 2.0),
        (TimeScheme::Bdf2, 2.0),
    ] {
        let orders = time(scheme, equal)?;
        assert!(
            orders.iter().all(|order| (order - expected).abs() < 0.1),
            "{scheme:?}: {orders:?}"
        );
    }
    Ok(())
}

#[test]
fn unequal_steps_keep_the_order() -> Result<(), PistonError> {
    for (scheme, expected) in [
        (TimeScheme::ImplicitEuler, 1.0),
        (TimeScheme::CrankNicolson, 2.0),
        (TimeScheme::Bdf2, 2.0),
    ] {
        let orders = time(scheme, unequal)?;
        assert!(
            orders.iter().all(|order| (order - expected).abs() < 0.1),
            "{scheme:?}: {orders:?}"
        );
    }
    Ok(())
}

#[test]
fn bdf2_that_starts_again_keeps_the_order() -> Result<(), PistonError> {
    let orders = time(TimeScheme::Bdf2, restarting)?;
    assert!(orders.iter().all(|order| (order - 2.0).abs() < 0.1), "{orders:?}");
    Ok(())
}
