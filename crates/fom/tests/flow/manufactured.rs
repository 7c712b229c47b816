//! Manufactured solutions on a moving, curved mesh.

use super::exact;
use super::setups::{KINDS, Kind, Wobble, enclosed, errors, mesh, order, parameters};
use lumley_fem::Point;
use lumley_fom::TimeScheme;
use lumley_fom::flow::{Linearisation, SteadyLimits, ViscousForm};
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
                let mut flow = enclosed(mesh(kind, n), parameters, None, false);
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

/// On a mesh that moves all the time: the difference to a run with very small steps.
#[test]
fn orders_in_time() {
    for (scheme, expected) in [(TimeScheme::ImplicitEuler, 1.0), (TimeScheme::Bdf2, 2.0)] {
        for linearisation in LINEARISATIONS {
            let run = |steps: usize| {
                let grid = mesh(Kind::Both, 6);
                let motion = Wobble::of(&grid, 4.0);
                let parameters = parameters(scheme, ViscousForm::Stress, linearisation);
                let mut flow = enclosed(grid, parameters, Some(motion), false);
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
