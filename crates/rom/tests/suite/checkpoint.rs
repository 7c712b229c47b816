//! A model goes on from its checkpoint bit for bit, and refuses damaged ones.

use crate::{
    LENGTH, MAPPED, MULTIPLIER, PENALTY, basis_for, build, centred_basis, grid_basis, physics, run,
    start,
};
use lumley_rom::{
    Basis, ClosureKind, EddyViscosity, Integrator, ModelChoice, Penalty, PistonPhysics,
    ProjectionKind, ReducedError, ReducedPiston, Rosenbrock,
};
use std::error::Error;

fn bits(piston: &ReducedPiston) -> Vec<u64> {
    let body = piston.body();
    let scalars = [piston.time(), piston.traction(), body.position[0], body.velocity[0]];
    piston.coefficients().iter().chain(&scalars).map(|v| v.to_bits()).collect()
}

#[test]
fn restored_models_go_on_bit_for_bit() -> Result<(), Box<dyn Error>> {
    let implicit = Integrator::Rosenbrock(Rosenbrock { tolerance: 1e-6 });
    for (projection, integrator) in
        [(PENALTY, Integrator::Rk4 {}), (MAPPED, Integrator::Rk4 {}), (MULTIPLIER, implicit)]
    {
        let fresh = || build(&physics(1.0), projection, integrator, &basis_for(projection));
        let mut piston = fresh()?;
        run(&mut piston, 0.1, 100)?;
        let mut checkpoint = Vec::new();
        piston.save(&mut checkpoint)?;

        let mut restored = fresh()?;
        restored.restore(&mut checkpoint.as_slice())?;
        assert_eq!(bits(&restored), bits(&piston));
        run(&mut piston, 0.1, 100)?;
        run(&mut restored, 0.1, 100)?;
        assert_eq!(bits(&restored), bits(&piston), "{projection:?}");
    }
    Ok(())
}

#[test]
fn damaged_checkpoints_are_refused_and_change_nothing() -> Result<(), Box<dyn Error>> {
    let mut piston = build(&physics(1.0), PENALTY, Integrator::Rk4 {}, &basis_for(PENALTY))?;
    run(&mut piston, 0.1, 100)?;
    let mut good = Vec::new();
    piston.save(&mut good)?;
    run(&mut piston, 0.1, 100)?;
    let before = bits(&piston);

    for place in 0..good.len() {
        let mut damaged = good.clone();
        damaged[place] ^= 0x10;
        assert!(piston.restore(&mut damaged.as_slice()).is_err(), "byte {place}");
        assert!(piston.restore(&mut &good[..place]).is_err(), "cut at {place}");
    }
    assert_eq!(bits(&piston), before);

    let mut other = build(&physics(1.0), PENALTY, Integrator::Rk4 {}, &grid_basis(61, 3))?;
    let error = other.restore(&mut good.as_slice()).expect_err("a model of another size");
    assert!(error.to_string().contains("its number of modes differs"), "{error}");
    Ok(())
}

/// The canonical piston with one part exchanged, as `new` takes it.
struct Parts {
    physics: PistonPhysics,
    model: ModelChoice,
    integrator: Integrator,
    basis: Basis,
}

impl Parts {
    fn build(&self) -> Result<ReducedPiston, ReducedError> {
        ReducedPiston::new(&self.physics, &self.model, self.integrator, &self.basis, &start(4))
    }

    fn canonical() -> Self {
        let model = ModelChoice { projection: PENALTY, closure: ClosureKind::default() };
        let integrator = Integrator::Rk4 {};
        Self { physics: physics(1.0), model, integrator, basis: basis_for(PENALTY) }
    }
}

#[test]
fn checkpoints_of_other_models_are_refused_by_name() -> Result<(), Box<dyn Error>> {
    type Change = fn(&mut Parts);
    let changes: [(&str, Change); 12] = [
        ("mean", |p| p.basis = centred_basis()),
        ("basis", |p| p.basis = grid_basis(71, 4)),
        ("projection", |p| p.model.projection = MULTIPLIER),
        ("projection", |p| p.model.projection = ProjectionKind::Penalty(Penalty { sigma: 31.0 })),
        ("closure", |p| p.model.closure = ClosureKind::EddyViscosity(EddyViscosity::default())),
        ("integrator", |p| p.integrator = Integrator::Rosenbrock(Rosenbrock::default())),
        ("viscosity", |p| p.physics.viscosity = 0.3),
        ("force factor", |p| p.physics.force_factor = 0.0),
        ("mass", |p| p.physics.joint.mass = 0.6),
        ("stiffness", |p| p.physics.joint.stiffness = 39.0),
        ("damping", |p| p.physics.joint.damping = 0.0),
        ("rest length", |p| p.physics.joint.rest_length = 0.94),
    ];
    let mut checkpoint = Vec::new();
    Parts::canonical().build()?.save(&mut checkpoint)?;
    for (name, change) in changes {
        let mut parts = Parts::canonical();
        change(&mut parts);
        let mut other = parts.build()?;
        let before = bits(&other);
        let error = other.restore(&mut checkpoint.as_slice()).expect_err(name);
        assert!(error.to_string().contains(&format!("its {name} differs")), "{name}: {error}");
        assert_eq!(bits(&other), before);
    }
    Parts::canonical().build()?.restore(&mut checkpoint.as_slice())?;
    Ok(())
}

/// Values that no run can reach, under a checksum that fits.
#[test]
fn values_without_sense_are_refused() -> Result<(), Box<dyn Error>> {
    let mut piston = Parts::canonical().build()?;
    let before = bits(&piston);
    let mut good = Vec::new();
    piston.save(&mut good)?;
    let last = good.len() / 8 - 1;
    let (time, coefficient, position, velocity) = (last - 8, last - 6, last - 2, last - 1);
    for (place, value, expected) in [
        (time, -1.0, "negative"),
        (coefficient, f64::NAN, "finite"),
        (velocity, f64::INFINITY, "finite"),
        (position, 0.0, "outside"),
        (position, LENGTH, "outside"),
    ] {
        let mut words: Vec<u64> = good
            .chunks_exact(8)
            .map(|word| u64::from_le_bytes(std::array::from_fn(|i| word[i])))
            .collect();
        words[place] = f64::to_bits(value);
        words[last] = words[..last]
            .iter()
            .fold(0xcbf2_9ce4_8422_2325, |hash, word| (hash ^ word).wrapping_mul(0x0100_0000_01b3));
        let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        let error = piston.restore(&mut bytes.as_slice()).expect_err(expected);
        assert!(error.to_string().contains(expected), "{error}");
        assert_eq!(bits(&piston), before);
    }
    Ok(())
}
