//! Motions in time against exact ones.

use crate::fixtures::{Bench, bdf2, bodies, five_bodies, two_loads, with_a_wing};
use lumley_body::joint::{Drive, Fixed, Joint, Prescribed, Prismatic, TimeFunction};
use lumley_body::{DynamicsError, Energy, ImplicitScheme, Load, RungeKutta, Tree};

/// Goes to `end` by BDF2.
fn run(tree: &Tree, end: f64, steps: u32, loads: &[Load]) -> ImplicitScheme {
    let mut scheme = ImplicitScheme::new(tree.clone(), 0.0).expect("bodies with inertia");
    let dt = end / f64::from(steps);
    for step in 0..steps {
        scheme.step(dt, bdf2(dt, step == 0), loads).expect("a step");
    }
    scheme
}

/// Orders of errors that come from halved steps.
fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect()
}

#[test]
fn a_mounted_oscillator_follows_the_exact_solution_with_second_order() {
    let mut mounted = bodies(
        "
        [[bodies]]
        name = 'cylinder'
        mass = 2.5
        centre = [0, 0]
        start = { position = [0.3], velocity = [-0.2] }
        joint = { kind = 'prismatic', along = [0, 2], spring = { stiffness = 2.37, rest = 0.1, damping = 0.4 } }
        ",
    );
    mounted[0].boundary = Some("cylinder".into());
    let tree = Tree::new(&mounted, [0.0; 2]).expect("a tree");
    let exact = Prismatic { mass: 2.5, stiffness: 2.37, damping: 0.4, rest_length: 0.1 };
    let (position, velocity) = exact.free_motion(0.3, -0.2, 4.0);
    let errors = [50, 100, 200, 400].map(|steps| {
        let scheme = run(&tree, 4.0, steps, &[]);
        let error = (scheme.position()[0] - position).abs();
        error.max((scheme.velocity()[0] - velocity).abs())
    });
    let orders = orders(&errors);
    assert!((orders[2] - 2.0).abs() < 0.1, "errors {errors:?}, orders {orders:?}");
    assert!(errors[3] < 1e-3, "{errors:?}");
}

#[test]
fn a_free_body_flies_on_a_parabola_and_turns_steadily() {
    let flying = bodies(
        "
        [[bodies]]
        name = 'plate'
        mass = 2
        inertia = 0.5
        centre = [1, 1]
        start = { velocity = [3, 4, 5] }
        joint = { kind = 'free' }
        ",
    );
    let tree = Tree::new(&flying, [0.0, -9.81]).expect("a tree");
    let load = Load { body: 0, at: [1.0, 1.0], force: [0.4, 0.0], moment: 0.1 };
    let mut scheme = RungeKutta::new(tree).expect("a body with inertia");
    for _ in 0..10 {
        scheme.step(0.1, &[load]).expect("a step");
    }
    let exact = [3.0 + 0.5 * 0.2, 4.0 - 0.5 * 9.81, 5.0 + 0.5 * 0.2];
    for (found, exact) in scheme.state().position.iter().zip(exact) {
        assert!((found - exact).abs() < 1e-13, "{found} and {exact}");
    }
}

/// The implicit scheme tends to the motion that the explicit one finds, with second order, for a tree in which all
/// terms are at work.
#[test]
fn both_schemes_find_the_same_motion_of_five_bodies() {
    let tree = five_bodies();
    let mut reference = RungeKutta::new(tree.clone()).expect("bodies with inertia");
    for _ in 0..2000 {
        reference.step(0.5 / 2000.0, &[]).expect("a step");
    }
    let exact = &reference.state().position;
    let errors = [200, 400, 800].map(|steps| {
        let scheme = run(&tree, 0.5, steps, &[]);
        let errors = scheme.position().iter().zip(exact).map(|(a, b)| (a - b).abs());
        errors.fold(0.0, f64::max)
    });
    let orders = orders(&errors);
    assert!((orders[1] - 2.0).abs() < 0.1, "errors {errors:?}, orders {orders:?}");
    assert!(errors[2] < 1e-3, "{errors:?}");
}

/// What loads and dampers do is what the energy changes by.
#[test]
fn the_work_of_loads_and_dampers_is_the_change_of_energy() {
    let tree = five_bodies();
    let loads = two_loads();
    let mut bench = Bench::new(tree.clone());
    let mut bare = Bench::new(tree.clone());
    let zeros = vec![0.0; tree.coordinates().len()];
    // Energy, and the power of loads and dampers: the damping matrix is what dr/dv is for bodies at rest.
    let mut at = |scheme: &RungeKutta| {
        let state = scheme.state();
        bench.residual(&state.position, &state.velocity, &zeros, &[]);
        bare.residual(&state.position, &zeros, &zeros, &[]);
        let v = &state.velocity;
        let power = |load: &Load| {
            let columns = bench.kinematics.jacobian(load.body, load.at);
            let force =
                columns.map(|c| v[c.coordinate] * c.generalised_force(load.force, load.moment));
            force.sum::<f64>()
        };
        let mut sum: f64 = loads.iter().map(power).sum();
        for i in 0..v.len() {
            let damping = bare.equations.by_velocity().row(i).iter().zip(v);
            sum -= v[i] * damping.map(|(d, v)| d * v).sum::<f64>();
        }
        (Energy::of(&bench.kinematics).total(), sum)
    };
    let mut scheme = RungeKutta::new(tree).expect("bodies with inertia");
    let (start, mut power) = at(&scheme);
    let (steps, dt) = (2000, 0.5 / 2000.0);
    let (mut work, mut end) = (0.0, start);
    for _ in 0..steps {
        scheme.step(dt, &loads).expect("a step");
        let (energy, next) = at(&scheme);
        work += 0.5 * dt * (power + next);
        (power, end) = (next, energy);
    }
    assert!(work.abs() > 0.1, "the loads do work: {work} J/m");
    assert!((end - start - work).abs() < 1e-5, "energy {}, work {work}", end - start);
}

/// A flap that hangs from a support with a hinge.
fn flap(support: Joint, gravity: [f64; 2]) -> Tree {
    let mut flap = bodies(
        "
        [[bodies]]
        name = 'support'
        centre = [0, 0]
        joint = { kind = 'fixed' }
        [[bodies]]
        name = 'flap'
        mass = 2
        inertia = 0.3
        centre = [0, -0.8]
        joint = { kind = 'revolute', at = [0, 0], to = 'support' }
        ",
    );
    flap[0].joint = support;
    Tree::new(&flap, gravity).expect("a tree")
}

/// A support falls and is pushed to the right, both with constant acceleration, exactly as its functions say: for the
/// flap on it this is another gravity.
#[test]
fn a_prescribed_body_carries_others() {
    let still = flap(Joint::Fixed(Fixed::default()), [-3.0, -5.0]);
    let mut reference = RungeKutta::new(still).expect("a body with inertia");
    for _ in 0..1000 {
        reference.step(2e-3, &[]).expect("a step");
    }
    let exact = reference.state().position[0];
    assert!(exact.abs() > 0.1, "the flap swings: {exact} rad");

    let x = Drive::Function(TimeFunction::new(|t| 0.4 * t + 1.5 * t * t));
    let y = Drive::Function(TimeFunction::new(|t| -0.5 * 4.81 * t * t));
    let support = Prescribed { x, y, ..Prescribed::default() };
    let tree = flap(Joint::Prescribed(support), [0.0, -9.81]);
    let errors = [100, 200, 400].map(|steps| {
        let scheme = run(&tree, 2.0, steps, &[]);
        let mut prescribed = [0.0; 4];
        tree.prescribe(scheme.time(), &mut prescribed).expect("finite");
        assert_eq!(scheme.position()[..3], prescribed[..3]);
        // The time is a sum of steps.
        assert!((prescribed[0] - 6.8).abs() < 1e-12 && (prescribed[1] + 9.62).abs() < 1e-12);
        (scheme.position()[3] - exact).abs()
    });
    let orders = orders(&errors);
    assert!((orders[1] - 2.0).abs() < 0.1, "errors {errors:?}, orders {orders:?}");
}

/// The residual of a prescribed coordinate is the load that moves the body so: here `m a`.
#[test]
fn the_load_of_a_prescription_is_its_residual() {
    let mut heaving = bodies(
        "[[bodies]]\nname = 'foil'\nmass = 3\ncentre = [0, 0]\njoint = { kind = 'prescribed' }",
    );
    let Joint::Prescribed(foil) = &mut heaving[0].joint else { panic!("another joint") };
    foil.y = Drive::Function(TimeFunction::new(|t| 2.0 * t * t));
    let scheme = run(&Tree::new(&heaving, [0.0; 2]).expect("a tree"), 1.0, 10, &[]);
    let force = scheme.equations().residual()[1];
    assert!((force - 12.0).abs() < 1e-10, "{force}");
}

#[test]
fn newton_converges_quadratically_and_repeats_to_the_bit() {
    let tree = with_a_wing();
    let loads = two_loads();
    let (a, b) = (run(&tree, 0.2, 20, &loads), run(&tree, 0.2, 20, &loads));
    assert_eq!(a.position(), b.position());
    let mut scheme = a;
    let iterations = scheme.step(0.01, bdf2(0.01, false), &loads).expect("a step");
    assert!((2..=5).contains(&iterations), "{iterations} iterations");
}

/// Bodies in equilibrium stay there: round-off does not keep Newton's method from converging.
#[test]
fn equilibrium_is_kept() {
    let hanging = bodies(
        "
        [[bodies]]
        name = 'weight'
        mass = 3
        centre = [100, 1]
        start = { position = [-0.3] }
        joint = { kind = 'prismatic', along = [0, 1], spring = { stiffness = 100, damping = 1 } }
        ",
    );
    let tree = Tree::new(&hanging, [0.0, -10.0]).expect("a tree");
    let scheme = run(&tree, 10.0, 100, &[]);
    assert!((scheme.position()[0] + 0.3).abs() < 1e-12, "{}", scheme.position()[0]);
}

#[test]
fn what_only_a_fluid_can_move_is_refused_without_one() {
    for (mass, inertia, label) in [("0", "0", "disc.x"), ("1", "0", "disc.angle")] {
        let massless = bodies(&format!(
            "[[bodies]]\nname = 'disc'\nmass = {mass}\ninertia = {inertia}\ncentre = [0, 0]\njoint = {{ kind = 'free' }}"
        ));
        let tree = Tree::new(&massless, [0.0; 2]).expect("a fluid could move it");
        assert!(tree.is_singular());
        let refusal = DynamicsError::Massless { coordinate: label.into() };
        assert_eq!(ImplicitScheme::new(tree.clone(), 0.0).err(), Some(refusal.clone()));
        assert_eq!(RungeKutta::new(tree).err(), Some(refusal));
    }
}

#[test]
fn a_massless_link_that_carries_a_mass_is_not_singular() {
    let chain = bodies(
        "
        [[bodies]]
        name = 'rod'
        mass = 0
        centre = [0, 0.5]
        joint = { kind = 'revolute', at = [0, 0] }
        [[bodies]]
        name = 'bob'
        mass = 1
        inertia = 0.1
        centre = [0, 1]
        joint = { kind = 'revolute', at = [0, 1], to = 'rod' }
        ",
    );
    assert!(!Tree::new(&chain, [0.0; 2]).expect("a tree").is_singular());
}
