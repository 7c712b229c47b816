//! Manufactured solutions on a moving, curved mesh.

use super::exact;
use super::setups::{KINDS, Kind, Wobble, enclosed, errors, mesh, order, parameters};
use lumley_fem::Point;
use lumley_fom::TimeScheme;
use lumley_fom::flow::{FlowMotion, Linearisation, SteadyLimits, StepControl, ViscousForm};
use std::sync::Arc;

const LINEARISATIONS: [Linearisation; 3] =
    [Linearisation::Extrapolation, Linearisation::Tangent, Linearisation::Newton];

/// The pair P2 with bubble / P1 and Q2 / P1: order 3 for the velocity and 2 for the pressure, in L2.
#[test]
fn orders_in_space() {
    for form in [ViscousForm::Stress, ViscousForm::Laplacian] {
        for kind in KINDS {
            let found = [32, 64].map(|n| {
                let mut parameters = parameters(TimeScheme::Bdf2, form, Linearisation::default());
                parameters.body_force = Some(Arc::new(exact::steady_force));
                let mut flow = enclosed(mesh(kind, n), parameters, FlowMotion::Still, false);
                flow.settle(SteadyLimits::default(), |_, _| {}).expect("a steady flow");
                errors(&flow)
            });
            for (k, expected) in [3.0, 2.0].into_iter().enumerate() {
                let order = order(found[0][k], found[1][k]);
                let case = format!("{form:?} {kind:?} {found:?}: order {order:.2}");
                assert!((order - expected).abs() < 0.15, "{case}, expected {expected}");
            }
        }
    }
}

/// The same orders where every node moves, in steps so short that their error does not show.
#[test]
fn orders_in_space_on_a_moving_mesh() {
    for kind in KINDS {
        let finest = if kind == Kind::Quadrilaterals { 32 } else { 64 };
        let found = [finest / 2, finest].map(|n| {
            let grid = mesh(kind, n);
            let motion = Wobble::of(&grid, 20.0);
            let parameters =
                parameters(TimeScheme::Bdf2, ViscousForm::Stress, Linearisation::default());
            let mut flow = enclosed(grid, parameters, FlowMotion::Given(motion), false);
            for _ in 0..16 {
                flow.step(5e-4).expect("a step");
            }
            errors(&flow)
        });
        for (k, expected) in [3.0, 2.0].into_iter().enumerate() {
            let order = order(found[0][k], found[1][k]);
            let case = format!("{kind:?} {found:?}: order {order:.2}");
            assert!((order - expected).abs() < 0.2, "{case}, expected {expected}");
        }
    }
}

/// On a mesh that moves all the time: the difference to a run with very small steps.
#[test]
fn orders_in_time() {
    for (scheme, expected) in [(TimeScheme::ImplicitEuler, 1.0), (TimeScheme::Bdf2, 2.0)] {
        for linearisation in LINEARISATIONS {
            let run = |steps: usize| {
                let grid = mesh(Kind::Both, 6);
                let motion = Wobble::of(&grid, 4.0);
                let parameters = parameters(scheme, ViscousForm::Stress, linearisation);
                let mut flow = enclosed(grid, parameters, FlowMotion::Given(motion), false);
                for _ in 0..steps {
                    flow.step(1.0 / steps as f64).expect("a step");
                }
                flow.velocity().to_vec()
            };
            let exact = run(1280);
            let away = |u: Vec<Point>| {
                let parts = u.iter().zip(&exact).map(|(u, v)| (u[0] - v[0]).hypot(u[1] - v[1]));
                parts.fold(0.0, f64::max)
            };
            let found = [40, 80].map(|steps| away(run(steps)));
            let order = order(found[0], found[1]);
            let case = format!("{scheme:?}, {linearisation:?}: {found:?}, order {order:.2}");
            assert!((order - expected).abs() < 0.2, "{case}, expected {expected}");
        }
    }
}

/// An adaptive run meets the times it is asked for, with the error that it is asked for.
#[test]
fn adaptive_steps_keep_the_error() {
    let errors = [2e-2, 4e-3].map(|tolerance| {
        let grid = mesh(Kind::Quadrilaterals, 16);
        let motion = Wobble::of(&grid, 4.0);
        let parameters =
            parameters(TimeScheme::Bdf2, ViscousForm::Stress, Linearisation::default());
        let mut flow = enclosed(grid, parameters, FlowMotion::Given(motion), false);
        let control = StepControl { tolerance, shortest: 1e-4, longest: 0.2, velocity: 0.0 };
        let (mut lengths, mut worst) = (Vec::new(), 0.0_f64);
        for end in [0.4, 1.0] {
            while flow.time() < end {
                let before = flow.time();
                let step = flow.step_towards(end, &control).expect("a step");
                lengths.push(flow.time() - before);
                if lengths.len() > 2 {
                    worst = worst.max(step.extrapolation_error);
                }
            }
            assert!((flow.time() - end).abs() < 1e-12);
        }
        assert!(worst < 2.0 * tolerance, "{worst:e}");
        let longest = lengths.iter().copied().fold(0.0, f64::max);
        assert!(longest > 20.0 * lengths[0], "the steps grow: {lengths:?}");
        (errors(&flow)[0], lengths.len())
    });
    let [(coarse, few), (fine, many)] = errors;
    assert!(fine < 0.5 * coarse && many > few, "{errors:?}");
}
