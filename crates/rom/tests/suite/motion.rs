//! What the model computes: orders, exact solutions, samples.

use crate::{
    LENGTH, MAPPED, MULTIPLIER, PENALTY, basis_for, build, grid_basis, manufactured, physics, run,
    start,
};
use lumley_fem::UniformGrid;
use lumley_rom::{
    Basis, ClosureKind, Integrator, ModelChoice, Penalty, ProjectionKind, ReducedError,
    ReducedPiston, Rosenbrock,
};

const RK4: Integrator = Integrator::Rk4 {};

/// Without a force from the fluid the block is the exact damped oscillator, to the order of RK4.
#[test]
fn uncoupled_block_is_the_exact_oscillator() -> Result<(), ReducedError> {
    let physics = physics(0.0);
    let (position, velocity) = physics.joint.free_motion(0.9, 0.0, 1.0);
    for projection in [PENALTY, MULTIPLIER, MAPPED] {
        let error = |steps| {
            let mut piston = build(&physics, projection, RK4, &basis_for(projection))?;
            run(&mut piston, 1.0, steps)?;
            let body = piston.body();
            Ok((body.position[0] - position).hypot(body.velocity[0] - velocity))
        };
        let (coarse, fine) = (error(1000)?, error(2000)?);
        let order = (coarse / fine).log2();
        assert!(coarse < 1e-8 && (order - 4.0).abs() < 0.1, "{projection:?}: {coarse:e}, {order}");
    }
    Ok(())
}

/// The coupled flow has order 4 in time as long as X stays in one cell, where the operators are smooth.
#[test]
fn rk4_has_order_4_on_the_coupled_piston() -> Result<(), ReducedError> {
    let coarse_grid = grid_basis(7, 3); // one cell from 0.9167 to 1.1
    // A mild penalty, so that these steps are in the asymptotic range.
    let mild = ProjectionKind::Penalty(Penalty { sigma: 3.0 });
    for projection in [mild, MULTIPLIER, MAPPED] {
        let basis = if projection == MAPPED { basis_for(MAPPED) } else { coarse_grid.clone() };
        let state = |steps| {
            let model = ModelChoice { projection, closure: ClosureKind::default() };
            let mut start = start(basis.modes());
            start.position = 0.97;
            let mut piston = ReducedPiston::new(&physics(1.0), &model, RK4, &basis, &start)?;
            run(&mut piston, 0.5, steps)?;
            let body = piston.body();
            let mut state = piston.coefficients().to_vec();
            state.extend([body.position[0], body.velocity[0]]);
            Ok(state)
        };
        let exact: Vec<f64> = state(8000)?;
        let error = |steps| {
            let gaps: Vec<f64> = state(steps)?.iter().zip(&exact).map(|(a, b)| a - b).collect();
            Ok(gaps.iter().map(|g| g * g).sum::<f64>().sqrt())
        };
        let order = (error(200)? / error(400)?).log2();
        assert!((order - 4.0).abs() < 0.1, "{projection:?}: order {order}");
    }
    Ok(())
}

/// Both integrators solve the same equations.
#[test]
fn rosenbrock_agrees_with_rk4() -> Result<(), ReducedError> {
    let implicit = Integrator::Rosenbrock(Rosenbrock { tolerance: 1e-9 });
    for projection in [PENALTY, MULTIPLIER, MAPPED] {
        let basis = basis_for(projection);
        let [mut a, mut b] = [RK4, implicit].map(|i| build(&physics(1.0), projection, i, &basis));
        let (a, b) = (a.as_mut().map_err(|e| e.clone())?, b.as_mut().map_err(|e| e.clone())?);
        run(a, 0.5, 2000)?;
        run(b, 0.5, 5)?;
        let values = a.coefficients().iter().zip(b.coefficients());
        for (x, y) in values.chain([(&a.traction(), &b.traction())]) {
            assert!((x - y).abs() < 1e-6, "{projection:?}: {x} and {y}");
        }
    }
    Ok(())
}

/// On its own grid the sample is the sum of the modes; the mean of a centred basis belongs to it.
#[test]
fn grid_sample_is_the_sum_of_the_modes() -> Result<(), ReducedError> {
    let nodes = manufactured::nodes(LENGTH, 61);
    let modes = manufactured::grid_modes(&nodes, 3);
    let grid = UniformGrid::line(0.0, LENGTH, 61);
    let mean: Vec<f64> = nodes.iter().map(|x| 0.02 * x.min(0.9)).collect();
    let basis = Basis::on_grid(&grid, modes.as_ref(), Some(&mean))?;
    let mut piston = build(&physics(1.0), PENALTY, RK4, &basis)?;
    run(&mut piston, 0.1, 100)?;
    let mut velocity = vec![0.0; 61];
    piston.sample(&grid, &mut velocity)?;
    for (k, v) in velocity.iter().enumerate() {
        let sum: f64 = (0..3).map(|n| piston.coefficients()[n] * modes[(k, n)]).sum();
        assert!((v - mean[k] - sum).abs() < 1e-14, "node {k}");
    }
    Ok(())
}

/// In the reference frame the fluid sticks to both ends, and the solid moves as a whole.
#[test]
fn mapped_sample_sticks_to_the_block() -> Result<(), ReducedError> {
    let mut piston = build(&physics(1.0), MAPPED, RK4, &basis_for(MAPPED))?;
    run(&mut piston, 0.2, 200)?;
    let (position, velocity) = (piston.body().position[0], piston.body().velocity[0]);
    let mut sample = [0.0; 2];
    piston.sample(&UniformGrid::line(0.0, position * (1.0 - 1e-12), 2), &mut sample)?;
    assert!(sample[0] == 0.0 && (sample[1] - velocity).abs() < 1e-10, "{sample:?}, {velocity}");
    piston.sample(&UniformGrid::line(position + 1e-9, LENGTH, 2), &mut sample)?;
    assert_eq!(sample, [velocity; 2]);
    Ok(())
}

/// A mean of zero changes nothing; a field in the span comes back from its coefficients.
#[test]
fn zero_mean_changes_nothing() -> Result<(), ReducedError> {
    for projection in [PENALTY, ProjectionKind::Corrected {}] {
        let nodes = manufactured::nodes(LENGTH, 61);
        let modes = manufactured::grid_modes(&nodes, 4);
        let grid = UniformGrid::line(0.0, LENGTH, 61);
        let centred = Basis::on_grid(&grid, modes.as_ref(), Some(&[0.0; 61]))?;
        let mut plain = build(&physics(1.0), projection, RK4, &grid_basis(61, 4))?;
        let mut with_mean = build(&physics(1.0), projection, RK4, &centred)?;
        run(&mut plain, 0.1, 100)?;
        run(&mut with_mean, 0.1, 100)?;
        for (a, b) in plain.coefficients().iter().zip(with_mean.coefficients()) {
            assert!((a - b).abs() < 1e-14, "{projection:?}: {a} and {b}");
        }
    }
    Ok(())
}

/// (7): the projection of a field in the span, the mean included, gives back its coefficients.
#[test]
fn projection_recovers_coefficients() -> Result<(), ReducedError> {
    let nodes = manufactured::nodes(1.0, 41);
    let modes = manufactured::reference_modes(&nodes, 2, 3);
    let mean: Vec<f64> = nodes.iter().map(|x| x * (1.0 - x)).collect();
    let basis = Basis::on_reference(&nodes, 2, modes.as_ref(), Some(&mean))?;
    let a = [0.3, -0.2, 0.7];
    let field: Vec<f64> = (0..41)
        .map(|k| mean[k] + a.iter().enumerate().map(|(n, a)| a * modes[(k, n)]).sum::<f64>())
        .collect();
    for (found, expected) in basis.project(&field)?.iter().zip(a) {
        assert!((found - expected).abs() < 1e-13, "{found} and {expected}");
    }
    Ok(())
}
