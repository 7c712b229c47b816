//! A block that moves at once in a fluid at rest: u jumps at the interface when the motion starts.

mod canonical;

use lumley_fom::{InitialFlow, Piston, PistonError, PistonParameters, TimeScheme};

const PROBES: [usize; 3] = [0, 1, 2];
/// Differences between the extrapolated probes, a tenth of those on the finest meshes.
const LIMIT_TOLERANCES: [f64; 3] = [5e-5, 5e-4, 2e-4];

/// X, X' and u in the middle at t = 0.5 s, on a mesh and with steps that `level` halves.
fn probes(scheme: TimeScheme, degree: usize, level: u32) -> Result<[f64; 3], PistonError> {
    let parameters = PistonParameters {
        initial_velocity: -0.8,
        initial_flow: InitialFlow::Zero,
        ..canonical::parameters(1.0)
    };
    let refined = 1 << level;
    let mut piston = Piston::new(&parameters, 10 * refined, degree, scheme)?;
    let steps = 50 * refined;
    for _ in 0..steps {
        piston.step(0.5 / steps as f64)?;
        assert!(piston.velocities().all(f64::is_finite) && piston.traction().is_finite());
    }
    let x = piston.interface();
    Ok([x, piston.body().velocity[0], piston.velocity_at(0.5 * x)])
}

/// The jump leaves the first order of any scheme and degree, and all have the same limit.
#[test]
fn a_rough_start_stays_finite_and_converges() -> Result<(), PistonError> {
    let mut limits = Vec::new();
    for scheme in [TimeScheme::ImplicitEuler, TimeScheme::CrankNicolson, TimeScheme::Bdf2] {
        for degree in [1, 2] {
            let at = |level| probes(scheme, degree, level);
            let levels = [at(0)?, at(1)?, at(2)?, at(3)?];
            let gaps = [0, 1, 2].map(|l| PROBES.map(|k| (levels[l + 1][k] - levels[l][k]).abs()));
            let shrinks =
                |pair: &[[f64; 3]]| PROBES.iter().all(|&k| pair[1][k] < 0.75 * pair[0][k]);
            assert!(gaps.windows(2).all(shrinks), "{scheme:?}, degree {degree}: {gaps:?}");
            limits.push(PROBES.map(|k| 2.0 * levels[3][k] - levels[2][k]));
        }
    }
    for limit in &limits {
        let near = |k: usize| (limit[k] - limits[0][k]).abs() < LIMIT_TOLERANCES[k];
        assert!(PROBES.into_iter().all(near), "{limit:?} and {:?}", limits[0]);
    }
    Ok(())
}
