//! A flow that solves the equations with a force: what it is, and where its mesh goes.

use lumley_fem::Point;
use std::f64::consts::PI;

/// `ρ (u_t + (u·∇)u) − μ ∇²u + ∇p = ρ f` with ρ and μ of [`DENSITY`] and [`VISCOSITY`].
pub const DENSITY: f64 = 1.3;
pub const VISCOSITY: f64 = 0.07;

/// How the flow changes in time: `g(t)` and its slope.
fn pulse(t: f64) -> [f64; 2] {
    [1.0 + 0.5 * (2.0 * t).sin(), (2.0 * t).cos()]
}

/// `u = g (−cos πx sin πy, sin πx cos πy) + (0.3, −0.2)`, without divergence.
pub fn velocity([x, y]: Point, t: f64) -> Point {
    let ([sx, cx], [sy, cy]) = (sines(x), sines(y));
    let [g, _] = pulse(t);
    [0.3 - g * cx * sy, -0.2 + g * sx * cy]
}

fn sines(x: f64) -> Point {
    let (s, c) = (PI * x).sin_cos();
    [s, c]
}

/// `∂u_i/∂x_j`
pub fn gradient([x, y]: Point, t: f64) -> [Point; 2] {
    let ([sx, cx], [sy, cy]) = (sines(x), sines(y));
    let g = PI * pulse(t)[0];
    [[g * sx * sy, -g * cx * cy], [g * cx * cy, -g * sx * sy]]
}

/// `p = g (x² y − 1/3 + sin 2y)`
pub fn pressure([x, y]: Point, t: f64) -> f64 {
    pulse(t)[0] * (x * x * y - 1.0 / 3.0 + (2.0 * y).sin())
}

/// The force per mass that drives it.
pub fn force([x, y]: Point, t: f64) -> Point {
    let ([sx, cx], [sy, cy]) = (sines(x), sines(y));
    let [g, slope] = pulse(t);
    let rate = [-slope * cx * sy, slope * sx * cy];
    let (u, grad) = (velocity([x, y], t), gradient([x, y], t));
    let laplacian = [2.0 * PI * PI * g * cx * sy, -2.0 * PI * PI * g * sx * cy];
    let push = [g * 2.0 * x * y, g * (x * x + 2.0 * (2.0 * y).cos())];
    [0, 1].map(|c| {
        rate[c] + u[0] * grad[c][0] + u[1] * grad[c][1]
            - (VISCOSITY * laplacian[c] - push[c]) / DENSITY
    })
}

/// The force that keeps the flow as it is at `time`.
pub fn steady_force(at: Point, time: f64) -> Point {
    let ([sx, cx], [sy, cy]) = (sines(at[0]), sines(at[1]));
    let [_, slope] = pulse(time);
    let [x, y] = force(at, time);
    [x + slope * cx * sy, y - slope * sx * cy]
}
