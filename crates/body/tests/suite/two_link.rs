//! The disc on a hinged bar of the paper's section 3 against its formulas.

use crate::fixtures::{Bench, Random, bodies};
use lumley_body::{Displaced, Energy, RungeKutta, Tree};
use std::f64::consts::{FRAC_PI_2, PI};

const GRAVITY: f64 = 9.81;
const BAR: f64 = 1.0;
const LENGTH: f64 = 5.5;
const DISC: f64 = 50.0;
const RADIUS: f64 = 0.5;

/// The canonical placement, both angles a right one.
fn pendulum(gravity: f64, density: f64) -> Tree {
    let mut bodies = bodies(
        "
        [[bodies]]
        name = 'bar'
        mass = 1
        shape = { kind = 'bar', length = 5.5 }
        centre = [7, 2.75]
        angle = 1.5707963267948966
        joint = { kind = 'revolute', at = [7, 0] }
        [[bodies]]
        name = 'disc'
        mass = 50
        shape = { kind = 'disc', radius = 0.5 }
        centre = [7, 6]
        angle = 1.5707963267948966
        joint = { kind = 'revolute', at = [7, 5.5], to = 'bar' }
        boundary = 'disc'
        ",
    );
    let mass = density * PI * RADIUS * RADIUS;
    bodies[1].displaced = Some(Displaced { mass, centre: [7.0, 6.0] });
    Tree::new(&bodies, [0.0, -gravity]).expect("the pendulum is a tree")
}

fn close(found: f64, expected: f64, scale: f64, what: &str) {
    let error = (found - expected).abs();
    assert!(error <= 1e-13 * scale, "{what}: {found} and {expected}, error {error:e}");
}

/// (16) with M, C, A and b as in (17)–(22), in random states.
#[test]
fn matrices_are_the_closed_formulas() {
    let mut random = Random(1);
    let density = 1.3;
    let mut bench = Bench::new(pendulum(GRAVITY, density));
    for _ in 0..200 {
        let (q, v) = (random.vector(2, 4.0), random.vector(2, 3.0));
        let residual = bench.residual(&q, &v, &[0.0; 2], &[]);
        let [theta, phi] = [q[0], q[1]];
        let (s, c) = (theta - phi).sin_cos();

        let coupling = DISC * LENGTH * RADIUS;
        let first = (BAR / 3.0 + DISC) * LENGTH * LENGTH;
        let mass = [[first, coupling * c], [coupling * c, 1.5 * DISC * RADIUS * RADIUS]];
        let gyration = [[0.0, coupling * s * v[1]], [-coupling * s * v[0], 0.0]];
        let sunk = DISC - density * PI * RADIUS * RADIUS;
        let weight = [
            -GRAVITY * (BAR / 2.0 + sunk) * LENGTH * theta.cos(),
            -GRAVITY * sunk * RADIUS * phi.cos(),
        ];
        let a = [
            [-LENGTH * theta.sin(), LENGTH * theta.cos(), 0.0],
            [-RADIUS * phi.sin(), RADIUS * phi.cos(), 1.0],
        ];
        let columns: Vec<_> = bench.kinematics.jacobian(1, [7.0, 6.0]).collect();
        for i in 0..2 {
            for j in 0..2 {
                close(bench.equations.mass()[(i, j)], mass[i][j], first, "M");
                let half = 0.5 * bench.equations.by_velocity()[(i, j)];
                close(half, gyration[i][j], 4.0 * coupling, "C");
            }
            let quadratic = gyration[i][0] * v[0] + gyration[i][1] * v[1];
            close(residual[i], quadratic - weight[i], 10.0 * first, "C v - b");
            assert_eq!(columns[i].coordinate, i);
            close(columns[i].velocity[0], a[i][0], LENGTH, "A");
            close(columns[i].velocity[1], a[i][1], LENGTH, "A");
            close(columns[i].spin, a[i][2], 1.0, "A");
        }
    }
}

/// Points of the disc are where (23) says; at the start to the last bit.
#[test]
fn the_disc_is_where_its_angles_put_it() {
    let mut bench = Bench::new(pendulum(0.0, 0.0));
    bench.residual(&[FRAC_PI_2; 2], &[0.0; 2], &[0.0; 2], &[]);
    for point in [[7.0, 6.0], [7.3, 6.4], [0.1, 0.7]] {
        assert_eq!(bench.kinematics.placement(1).place(point), point);
    }
    let [theta, phi] = [0.7_f64, -2.1_f64];
    bench.residual(&[theta, phi], &[0.4, -0.9], &[0.0; 2], &[]);
    let [x, y] = bench.kinematics.centre(1);
    close(x, 7.0 + LENGTH * theta.cos() + RADIUS * phi.cos(), 10.0, "x");
    close(y, LENGTH * theta.sin() + RADIUS * phi.sin(), 10.0, "y");
    close(bench.kinematics.angle(1), phi, 1.0, "phi");
    let [u, v] = bench.kinematics.velocity(1, [7.0, 6.0]);
    close(u, -LENGTH * 0.4 * theta.sin() + RADIUS * 0.9 * phi.sin(), 10.0, "u");
    close(v, LENGTH * 0.4 * theta.cos() - RADIUS * 0.9 * phi.cos(), 10.0, "v");
}

/// From (theta', phi') = (0, 1) at the canonical placement: the drift over 5.55 s falls with dt⁴.
#[test]
fn energy_drifts_with_the_fourth_power_of_the_step() {
    let drift = |steps: u32| {
        let tree = pendulum(0.0, 0.0);
        let mut bodies = tree.bodies().to_vec();
        bodies[1].start.velocity = vec![1.0];
        let tree = Tree::new(&bodies, [0.0; 2]).expect("the same tree");
        let mut scheme = RungeKutta::new(tree.clone()).expect("bodies with inertia");
        let mut bench = Bench::new(tree);
        let mut energy = |scheme: &RungeKutta| {
            bench.kinematics.update(&scheme.state().position, &scheme.state().velocity, &[0.0; 2]);
            Energy::of(&bench.kinematics).total()
        };
        let start = energy(&scheme);
        for _ in 0..steps {
            scheme.step(5.55 / f64::from(steps), &[]).expect("a step");
        }
        (energy(&scheme) / start - 1.0).abs()
    };
    let drifts = [111, 222, 444, 888].map(drift);
    let orders = [0, 1, 2].map(|k| (drifts[k] / drifts[k + 1]).log2());
    for (order, expected) in orders.into_iter().zip([4.05, 4.03, 4.01]) {
        assert!((order - expected).abs() < 0.01, "drifts {drifts:?}, orders {orders:?}");
    }
}
