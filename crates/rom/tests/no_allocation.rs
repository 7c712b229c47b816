//! A step of a reduced model allocates nothing.

#[path = "../../fem/tests/counting/mod.rs"]
mod counting;
#[path = "../src/manufactured.rs"]
mod manufactured;

use counting::allocations;
use lumley_body::joint::Prismatic;
use lumley_fem::UniformGrid;
use lumley_rom::{
    Basis, ClosureKind, EddyViscosity, Integrator, ModelChoice, Multiplier, Penalty, PistonPhysics,
    PistonStart, ProjectionKind, ReducedError, ReducedPiston, Rosenbrock,
};

/// Four modes in the frame of `projection`, and a mean if they are `centred`.
fn basis(projection: ProjectionKind, centred: bool) -> Result<Basis, ReducedError> {
    if projection.reference_frame() {
        let nodes = manufactured::nodes(1.0, 41);
        let modes = manufactured::reference_modes(&nodes, 2, 4);
        let mean: Vec<f64> = nodes.iter().map(|xi| 0.1 * xi * (1.0 - xi)).collect();
        return Basis::on_reference(&nodes, 2, modes.as_ref(), centred.then_some(&mean));
    }
    let nodes = manufactured::nodes(1.1, 61);
    let modes = manufactured::grid_modes(&nodes, 4);
    let mean: Vec<f64> = nodes.iter().map(|x| 0.1 * x * (1.1 - x)).collect();
    let grid = UniformGrid::line(0.0, 1.1, 61);
    Basis::on_grid(&grid, modes.as_ref(), centred.then_some(&mean))
}

/// Steps until the block has crossed three cells of the grid; returns the allocations on the way.
fn allocations_over_three_cells(piston: &mut ReducedPiston) -> Result<usize, ReducedError> {
    let start = piston.body().position[0];
    let before = allocations();
    assert!(before > 0, "the allocator counts");
    while piston.body().position[0] < start + 3.0 * 1.1 / 60.0 {
        assert!(piston.time() < 1.0, "the block does not move");
        piston.step(2e-4)?;
    }
    Ok(allocations() - before)
}

#[test]
fn stepping_allocates_nothing() -> Result<(), ReducedError> {
    let joint = Prismatic { mass: 0.5, stiffness: 39.5, damping: 0.1, rest_length: 0.95 };
    let physics = PistonPhysics { viscosity: 0.2, force_factor: 0.1, domain_length: 1.1, joint };
    let closure = ClosureKind::EddyViscosity(EddyViscosity::default());
    let start = PistonStart { coefficients: vec![0.01; 4], position: 0.9, velocity: 0.0 };
    for projection in [
        ProjectionKind::Printed {},
        ProjectionKind::Corrected {},
        ProjectionKind::Multiplier(Multiplier::default()),
        ProjectionKind::Penalty(Penalty::default()),
        ProjectionKind::Mapped {},
    ] {
        for integrator in [Integrator::Rk4 {}, Integrator::Rosenbrock(Rosenbrock::default())] {
            for centred in [false, true] {
                let model = ModelChoice { projection, closure };
                let basis = basis(projection, centred)?;
                let mut piston = ReducedPiston::new(&physics, &model, integrator, &basis, &start)?;
                let found = allocations_over_three_cells(&mut piston)?;
                assert_eq!(found, 0, "{projection:?} with {integrator:?}, centred {centred}");
            }
        }
    }
    Ok(())
}
