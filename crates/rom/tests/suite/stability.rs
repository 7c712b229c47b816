//! Stable steps, and what happens beyond them.

use crate::{LENGTH, MAPPED, MULTIPLIER, PENALTY, basis_for, build, manufactured, physics, run};
use lumley_fem::UniformGrid;
use lumley_rom::{
    Basis, ClosureKind, Divergence, Integrator, ModelChoice, Penalty, PistonPhysics, PistonStart,
    ProjectionKind, ReducedError, ReducedPiston, Rosenbrock,
};

/// A block that nothing moves, so that the stable step is one number.
fn still() -> PistonPhysics {
    let mut physics = physics(0.0);
    (physics.joint.stiffness, physics.joint.damping) = (0.0, 0.0);
    physics
}

fn still_piston(projection: ProjectionKind) -> Result<ReducedPiston, ReducedError> {
    let model = ModelChoice { projection, closure: ClosureKind::default() };
    let start = PistonStart { coefficients: vec![1e-3; 4], position: 0.92, velocity: 0.0 };
    ReducedPiston::new(&still(), &model, Integrator::Rk4 {}, &basis_for(projection), &start)
}

/// A step just below the stable one holds for long, one just above it does not.
#[test]
fn stable_step_separates_decay_from_divergence() -> Result<(), ReducedError> {
    for projection in [PENALTY, MULTIPLIER, MAPPED] {
        let stable = still_piston(projection)?.stable_step();
        let long = |factor: f64| run(&mut still_piston(projection)?, factor * stable * 5e3, 5000);
        long(0.98)?;
        let error = long(1.02).expect_err("a step beyond the stable one");
        assert!(matches!(error, ReducedError::Diverged { .. }), "{projection:?}: {error}");
    }
    Ok(())
}

/// A strong penalty alone bounds the step, `σ |Φ(X)|² dt < 2.785` for an uncoupled block.
#[test]
fn stable_step_of_a_strong_penalty_is_known() -> Result<(), ReducedError> {
    let modes = manufactured::grid_modes(&manufactured::nodes(LENGTH, 61), 4);
    let t = 0.92 / (LENGTH / 60.0) - 50.0;
    let square: f64 =
        (0..4).map(|n| ((1.0 - t) * modes[(50, n)] + t * modes[(51, n)]).powi(2)).sum();
    let sigma = 1e5;
    let stable = still_piston(ProjectionKind::Penalty(Penalty { sigma }))?.stable_step();
    let ratio = stable * sigma * square / 2.785;
    assert!((ratio - 1.0).abs() < 1e-2, "{ratio}");
    Ok(())
}

/// A divergence names the time, the step and the stable step, and leaves the state before the step.
#[test]
fn divergence_says_what_to_do_and_keeps_the_state() -> Result<(), ReducedError> {
    let mut piston = build(&physics(1.0), PENALTY, Integrator::Rk4 {}, &basis_for(PENALTY))?;
    let dt = 3.0 * piston.stable_step();
    let error = (0..100_000).find_map(|_| piston.step(dt).err()).expect("a divergence");
    let ReducedError::Diverged { time, step, stable_step: Some(stable), .. } = error else {
        panic!("another error: {error}");
    };
    assert_eq!((time, step), (piston.time(), dt));
    assert!(stable < dt);
    let text = error.to_string();
    assert!(text.contains("exceeds the stable step") && text.contains("rosenbrock"), "{text}");
    assert!(piston.coefficients().iter().all(|a| a.is_finite()));
    piston.step(1e-6 * stable)?;
    Ok(())
}

/// The printed system is unstable at any step: the error says that the step is not the cause.
#[test]
fn printed_diverges_and_is_told_from_a_long_step() -> Result<(), ReducedError> {
    let grid = UniformGrid::line(0.0, LENGTH, 101);
    // Uniformly stretched flows with the interface at 0.90 m, 0.92 m and so on.
    let modes = manufactured::orthonormal(&manufactured::nodes(LENGTH, 101), 1, 6, |k, x| {
        (x / (0.9 + 0.02 * k as f64)).min(1.0)
    });
    let basis = Basis::on_grid(&grid, modes.as_ref(), None)?;
    for integrator in [Integrator::Rk4 {}, Integrator::Rosenbrock(Rosenbrock::default())] {
        let mut piston = build(&physics(1.0), ProjectionKind::Printed {}, integrator, &basis)?;
        let error = run(&mut piston, 2.0, 8000).expect_err("the printed system blows up");
        assert!(error.to_string().contains("the model itself is unstable"), "{error}");
    }
    Ok(())
}

/// A spring that pulls the block out of the domain.
#[test]
fn leaving_the_domain_is_an_error() -> Result<(), ReducedError> {
    let mut physics = physics(0.0);
    physics.joint.rest_length = 1.05;
    let mut piston = build(&physics, MAPPED, Integrator::Rk4 {}, &basis_for(MAPPED))?;
    let error = run(&mut piston, 1.0, 1000).expect_err("X passes L");
    let ReducedError::Diverged { cause: Divergence::Outside { position, length }, .. } = error
    else {
        panic!("another error: {error}");
    };
    assert!(position >= length && length == LENGTH, "{position}");
    Ok(())
}

/// The advice fits what was seen, and never is to take what one has.
#[test]
fn remedies_follow_the_cause() {
    let outside = Divergence::Outside { position: 1.2, length: LENGTH };
    let speed = Divergence::Speed { norm: 9.0, limit: 2.0 };
    let underflow = Divergence::StepUnderflow { tried: 1e-14 };
    let substeps = Divergence::Substeps { count: 1_000_000, left: 1e-3 };
    let unstable = "model itself is unstable";
    for (cause, stable_step, expected) in [
        (outside, Some(1.0), "take a longer domain or a slower start"),
        (outside, None, "take a longer domain or a slower start"),
        (outside, Some(1e-3), "exceeds the stable step"),
        (speed, Some(1e-3), "exceeds the stable step"),
        (speed, Some(1.0), unstable),
        (speed, None, unstable),
        (Divergence::NotFinite, None, unstable),
        (underflow, None, "take a larger tolerance; if that does not help"),
        (substeps, None, "take a larger tolerance or a shorter step"),
    ] {
        for projection in [MAPPED, PENALTY] {
            let (time, step) = (0.5, 0.01);
            let text = ReducedError::Diverged { time, step, stable_step, projection, cause };
            let text = text.to_string();
            assert!(text.contains(expected), "{text}");
            assert!(text.contains(&cause.to_string()), "{text}");
            assert!(projection != MAPPED || !text.contains("`mapped`"), "{text}");
        }
    }
}

/// The L-stable integrator takes steps far beyond the stable one of RK4.
#[test]
fn rosenbrock_is_not_bound_by_the_stable_step() -> Result<(), ReducedError> {
    let stiff = ProjectionKind::Penalty(Penalty { sigma: 1e7 });
    let integrator = Integrator::Rosenbrock(Rosenbrock { tolerance: 1e-6 });
    let basis = basis_for(stiff);
    let mut piston = build(&physics(1.0), stiff, integrator, &basis)?;
    assert!(piston.stable_step() < 1e-7, "stiff: {}", piston.stable_step());
    run(&mut piston, 0.2, 20)?;
    let slip = {
        let mut v = [0.0; 2];
        let position = piston.body().position[0];
        piston.sample(&UniformGrid::line(position, LENGTH, 2), &mut v)?;
        v[0] - piston.body().velocity[0]
    };
    assert!(slip.abs() < 1e-4, "a strong penalty leaves no slip: {slip}");
    Ok(())
}
