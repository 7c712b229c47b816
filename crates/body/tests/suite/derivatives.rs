//! Difference quotients, symmetry and the balance of energy of trees with every kind of joint.

use crate::fixtures::{Bench, Random, bodies, five_bodies, two_loads, with_a_wing};
use lumley_body::{Square, Tree};

const STEP: f64 = 1e-5;

/// Central difference of a vector along entry `j` of `at`.
fn difference(at: &[f64], j: usize, mut f: impl FnMut(&[f64]) -> Vec<f64>) -> Vec<f64> {
    let mut value = |shift: f64| {
        let mut at = at.to_vec();
        at[j] += shift;
        f(&at)
    };
    let (above, below) = (value(STEP), value(-STEP));
    above.iter().zip(&below).map(|(a, b)| (a - b) / (2.0 * STEP)).collect()
}

fn check(matrix: &Square, j: usize, column: &[f64], what: &str) {
    for (i, &expected) in column.iter().enumerate() {
        let error = (matrix[(i, j)] - expected).abs();
        assert!(error < 2e-8 * (1.0 + expected.abs()), "{what} ({i}, {j}): error {error:e}");
    }
}

#[test]
fn derivatives_are_difference_quotients() {
    let mut random = Random(2);
    let loads = two_loads();
    for tree in [five_bodies(), with_a_wing()] {
        let n = tree.coordinates().len();
        let mut bench = Bench::new(tree);
        for _ in 0..5 {
            let [q, v, a] = [1.0, 2.0, 3.0].map(|size| random.vector(n, size));
            bench.residual(&q, &v, &a, &loads);
            let exact = bench.equations.clone();
            for j in 0..n {
                let by_q = difference(&q, j, |q| bench.residual(q, &v, &a, &loads));
                check(exact.by_position(), j, &by_q, "dr/dq");
                let by_v = difference(&v, j, |v| bench.residual(&q, v, &a, &loads));
                check(exact.by_velocity(), j, &by_v, "dr/dv");
                let by_a = difference(&a, j, |a| bench.residual(&q, &v, a, &loads));
                check(exact.mass(), j, &by_a, "dr/da");
            }
            let mut tangent = Square::zeros(n);
            exact.tangent(4.0, &mut tangent);
            for (i, coordinate) in bench.tree.coordinates().iter().enumerate() {
                for j in 0..n {
                    let sum = 4.0 * exact.mass()[(i, j)]
                        + exact.by_velocity()[(i, j)]
                        + exact.by_position()[(i, j)] / 4.0;
                    let unit = f64::from(u8::from(i == j));
                    let expected = if coordinate.prescribed { unit } else { sum };
                    assert_eq!(tangent[(i, j)], expected);
                }
            }
        }
    }
}

/// Velocities and accelerations of points are rates along a motion, and Jacobians give the velocities.
#[test]
fn points_move_as_their_places_change() {
    let mut random = Random(3);
    let tree = with_a_wing();
    let n = tree.coordinates().len();
    let mut bench = Bench::new(tree);
    let [q, v, a] = [1.0, 2.0, 3.0].map(|size| random.vector(n, size));
    for body in 0..bench.tree.bodies().len() {
        let point = [random.next(), random.next()];
        // Along q + v t + a t²/2.
        let mut at = |t: f64| {
            let position: Vec<f64> = (0..n).map(|k| q[k] + t * (v[k] + 0.5 * t * a[k])).collect();
            let velocity: Vec<f64> = (0..n).map(|k| v[k] + t * a[k]).collect();
            bench.residual(&position, &velocity, &a, &[]);
            let placement = bench.kinematics.placement(body);
            [placement.place(point), bench.kinematics.velocity(body, point)]
        };
        let (after, before) = (at(STEP), at(-STEP));
        at(0.0);
        let quotient = |k: usize, d: usize| (after[k][d] - before[k][d]) / (2.0 * STEP);
        let velocity = bench.kinematics.velocity(body, point);
        let acceleration = bench.kinematics.acceleration(body, point);
        let columns = || bench.kinematics.jacobian(body, point);
        for d in 0..2 {
            assert!((velocity[d] - quotient(0, d)).abs() < 1e-7, "velocity of body {body}");
            assert!((acceleration[d] - quotient(1, d)).abs() < 1e-6, "acceleration of body {body}");
            let sum: f64 = columns().map(|c| c.velocity[d] * v[c.coordinate]).sum();
            assert!((velocity[d] - sum).abs() < 1e-13, "Jacobian of body {body}");
        }
        let spin: f64 = columns().map(|c| c.spin * v[c.coordinate]).sum();
        assert!((bench.kinematics.spin(body) - spin).abs() < 1e-14, "spin of body {body}");
        let path: Vec<usize> = columns().map(|c| c.coordinate).collect();
        assert_eq!(path, bench.kinematics.path(body));
    }
}

/// The tree without springs and dampers, whose dr/dv is 2 C.
fn bare() -> Tree {
    let mut bodies = five_bodies().bodies().to_vec();
    for body in &mut bodies {
        use lumley_body::joint::Joint;
        match &mut body.joint {
            Joint::Revolute(joint) => joint.spring = None,
            Joint::Prismatic(joint) => joint.spring = None,
            Joint::Free(joint) => {
                (joint.spring_x, joint.spring_y, joint.spring_angle) = (None, None, None);
            }
            _ => {}
        }
    }
    Tree::new(&bodies, [0.0; 2]).expect("the same tree")
}

#[test]
fn the_mass_matrix_is_symmetric_positive_definite_and_its_rate_less_two_c_is_skew() {
    let mut random = Random(4);
    let tree = bare();
    let n = tree.coordinates().len();
    let mut bench = Bench::new(tree);
    let zeros = vec![0.0; n];
    for _ in 0..20 {
        let (q, v) = (random.vector(n, 2.0), random.vector(n, 2.0));
        bench.residual(&q, &v, &zeros, &[]);
        let exact = bench.equations.clone();
        let x = random.vector(n, 1.0);
        let mut energy = 0.0;
        for i in 0..n {
            for j in 0..n {
                energy += x[i] * exact.mass()[(i, j)] * x[j];
                let skew = (exact.mass()[(i, j)] - exact.mass()[(j, i)]).abs();
                assert!(skew < 1e-14 * exact.mass()[(i, i)].max(1.0), "M ({i}, {j}): {skew:e}");
            }
        }
        assert!(energy > 0.0, "x·Mx = {energy}");
        let mut along = |t: f64| {
            let moved: Vec<f64> = (0..n).map(|k| q[k] + t * v[k]).collect();
            bench.residual(&moved, &v, &zeros, &[]);
            bench.equations.mass().clone()
        };
        let (after, before) = (along(STEP), along(-STEP));
        let twice = exact.by_velocity();
        let entry = |i, j| (after[(i, j)] - before[(i, j)]) / (2.0 * STEP) - twice[(i, j)];
        for i in 0..n {
            for j in 0..n {
                let sum: f64 = entry(i, j) + entry(j, i);
                assert!(sum.abs() < 1e-7, "M' − 2C ({i}, {j}): {sum:e}");
            }
        }
    }
}

/// A body that is fixed to another counts as one with it, wherever it is fixed and in whatever order.
#[test]
fn fixed_bodies_are_one() {
    let parts = bodies(
        "
        [[bodies]]
        name = 'right'
        mass = 1
        inertia = 0
        centre = [3, 0]
        joint = { kind = 'fixed', to = 'left' }
        [[bodies]]
        name = 'left'
        mass = 1
        inertia = 0
        centre = [1, 0]
        joint = { kind = 'revolute', at = [0, 0] }
        ",
    );
    let whole = bodies(
        "[[bodies]]\nname = 'both'\nmass = 2\ninertia = 2\ncentre = [2, 0]\njoint = { kind = 'revolute', at = [0, 0] }",
    );
    let gravity = [0.3, -2.0];
    let residual = |bodies: &[_]| {
        let mut bench = Bench::new(Tree::new(bodies, gravity).expect("a tree"));
        bench.residual(&[0.4], &[1.0], &[0.7], &[])[0]
    };
    let difference = residual(&parts) - residual(&whole);
    assert!(difference.abs() < 1e-14, "{difference:e}");
}
