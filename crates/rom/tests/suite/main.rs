//! The reduced piston from outside: what a user of the crate can rely on.

mod bad_input;
mod checkpoint;
mod choices;
mod motion;
mod stability;

#[path = "../../src/manufactured.rs"]
mod manufactured;

use lumley_body::joint::Prismatic;
use lumley_fem::UniformGrid;
use lumley_rom::{
    Basis, ClosureKind, Integrator, ModelChoice, Multiplier, Penalty, PistonPhysics, PistonStart,
    ProjectionKind, ReducedError, ReducedPiston,
};

const LENGTH: f64 = 1.1;
const PENALTY: ProjectionKind = ProjectionKind::Penalty(Penalty { sigma: 30.0 });
const MULTIPLIER: ProjectionKind = ProjectionKind::Multiplier(Multiplier { beta: 50.0 });
const MAPPED: ProjectionKind = ProjectionKind::Mapped {};

/// The canonical piston, with a coupling factor.
fn physics(force_factor: f64) -> PistonPhysics {
    let joint = Prismatic { mass: 0.5, stiffness: 39.5, damping: 0.1, rest_length: 0.95 };
    PistonPhysics { viscosity: 0.2, force_factor, domain_length: LENGTH, joint }
}

/// The canonical start with a flow in some modes.
fn start(modes: usize) -> PistonStart {
    let coefficients = (0..modes).map(|n| 0.05 / (n as f64 + 1.0)).collect();
    PistonStart { coefficients, position: 0.9, velocity: 0.0 }
}

fn grid_basis(nodes: usize, modes: usize) -> Basis {
    let grid = UniformGrid::line(0.0, LENGTH, nodes);
    let modes = manufactured::grid_modes(&manufactured::nodes(LENGTH, nodes), modes);
    Basis::on_grid(&grid, modes.as_ref(), None).expect("orthonormal modes")
}

/// Four modes of the grid and a mean.
fn centred_basis() -> Basis {
    let nodes = manufactured::nodes(LENGTH, 61);
    let modes = manufactured::grid_modes(&nodes, 4);
    let mean: Vec<f64> = nodes.iter().map(|x| 0.1 * x).collect();
    let grid = UniformGrid::line(0.0, LENGTH, 61);
    Basis::on_grid(&grid, modes.as_ref(), Some(&mean)).expect("orthonormal modes")
}

fn reference_basis(modes: usize) -> Basis {
    let nodes = manufactured::nodes(1.0, 41);
    let modes = manufactured::reference_modes(&nodes, 2, modes);
    Basis::on_reference(&nodes, 2, modes.as_ref(), None).expect("homogeneous modes")
}

/// A basis of four modes in the frame of `projection`.
fn basis_for(projection: ProjectionKind) -> Basis {
    if projection == MAPPED { reference_basis(4) } else { grid_basis(61, 4) }
}

fn build(
    physics: &PistonPhysics,
    projection: ProjectionKind,
    integrator: Integrator,
    basis: &Basis,
) -> Result<ReducedPiston, ReducedError> {
    let model = ModelChoice { projection, closure: ClosureKind::default() };
    ReducedPiston::new(physics, &model, integrator, basis, &start(basis.modes()))
}

/// Moves to `end` in `steps` steps.
fn run(piston: &mut ReducedPiston, end: f64, steps: u32) -> Result<(), ReducedError> {
    (0..steps).try_for_each(|_| piston.step(end / f64::from(steps)))
}
