//! Stokes and Oseen: the blocks of pressures have nothing on the diagonal.

use crate::oseen::{Grid, Oseen, System, relative_residual};
use faer::Par;
use lumley_fom::linear::{Analysis, DelayedUnknowns, Multifrontal, Scalar};

type Map = fn([f64; 2]) -> [f64; 2];

/// A channel with a hump in the grid, inflow on the left, outflow on the right.
fn channel(cells: [usize; 2]) -> Grid {
    let map =
        |[x, y]: [f64; 2]| [3.0 * x + 0.1 * (4.0 * y).sin(), y * (1.0 - 0.3 * (5.0 * x).sin())];
    Grid { cells, map, periodic: false, outlet: true }
}

fn poiseuille(viscosity: f64, rate: f64, condensed: bool) -> Oseen {
    Oseen { viscosity, rate, wind: |[x, y]| [1.0 - y * y, 0.2 * x.sin()], condensed }
}

fn residual<T: Scalar>(system: &System) -> f64 {
    let cells = system.unknowns.clone();
    let analysis = Analysis::new(cells, &system.centroids, &system.delay());
    let mut lu = Multifrontal::<T>::new(analysis, Par::Seq);
    lu.factorise(&system.matrices).expect("a regular saddle point");
    let b = &system.rhs;
    let mut x = b.clone();
    lu.solve(&mut x);
    relative_residual(system, &x, b)
}

#[test]
fn residuals_are_round_off_from_stokes_to_steep_convection() {
    for viscosity in [1.0, 1e-1, 1e-2, 1e-3, 1e-4] {
        for rate in [1e4, 100.0, 1e-6] {
            for condensed in [false, true] {
                let system =
                    channel([24, 12]).assemble(&poiseuille(viscosity, rate, condensed), false);
                let residual = residual::<f64>(&system);
                // Slopes of the pressure are scaled as h², far below the velocities: they cost digits.
                let most = if condensed { 1e-12 } else { 1e-10 };
                assert!(
                    residual < most,
                    "ν = {viscosity}, 1/dt = {rate}, condensed {condensed}: {residual:e}"
                );
            }
        }
    }
}

#[test]
fn single_precision_is_good_enough_for_a_preconditioner() {
    for viscosity in [1.0, 1e-2, 1e-4] {
        let system = channel([24, 12]).assemble(&poiseuille(viscosity, 100.0, true), false);
        let residual = residual::<f32>(&system);
        assert!(residual < 1e-2, "ν = {viscosity}: {residual:e}");
    }
}

#[test]
fn grids_of_all_shapes_are_regular() {
    let ring = |[x, y]: [f64; 2]| {
        let (radius, angle) = (0.5 * 20f64.powf(y), -std::f64::consts::TAU * x);
        [radius * angle.cos(), radius * angle.sin()]
    };
    let shapes: [(_, _, Map); 5] = [
        ([1, 1], false, |x| x),
        ([1, 17], false, |x| x),
        ([40, 2], false, |[x, y]| [9.0 * x, y]),
        ([13, 11], false, |x| x),
        ([30, 12], true, ring),
    ];
    for (cells, periodic, map) in shapes {
        let grid = Grid { cells, map, periodic, outlet: !periodic };
        let system = grid.assemble(&poiseuille(0.01, 10.0, true), periodic);
        let residual = residual::<f64>(&system);
        assert!(residual < 1e-12, "{cells:?}: {residual:e}");
    }
}

/// Cells that only meet in corners: each of them has a pressure of its own that must wait.
#[test]
fn components_that_meet_in_corners_have_a_pressure_each() {
    let system = channel([24, 12]).assemble(&poiseuille(0.01, 100.0, true), false);
    // Centroids that mix neighbours up: subdomains in many components.
    let mixed: Vec<_> = (0..24 * 12).map(|c| [f64::from((c * 7919) % 288), 0.0]).collect();
    let cells = system.unknowns.clone();
    let analysis = Analysis::new(cells, &mixed, &system.delay());
    let mut lu = Multifrontal::<f64>::new(analysis, Par::Seq);
    lu.factorise(&system.matrices).expect("a regular saddle point");
    let b = &system.rhs;
    let mut x = b.clone();
    lu.solve(&mut x);
    let residual = relative_residual(&system, &x, b);
    assert!(residual < 1e-11, "{residual:e}");
}

/// The trap: without delay the pressures of a subdomain are eliminated before its boundary.
#[test]
fn without_delay_subdomains_are_singular() {
    let system = channel([24, 12]).assemble(&poiseuille(0.01, 100.0, true), false);
    let nothing = DelayedUnknowns::default();
    let analysis = Analysis::new(system.unknowns.clone(), &system.centroids, &nothing);
    let mut lu = Multifrontal::<f64>::new(analysis, Par::Seq);
    let error = lu.factorise(&system.matrices).expect_err("a singular front");
    let pressures: Vec<usize> = system.pressures.iter().map(|p| p[0]).collect();
    assert!(pressures.contains(&error.unknown), "{error}");
}
