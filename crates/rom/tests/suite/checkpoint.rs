//! A model goes on from its checkpoint bit for bit, and refuses damaged ones.

use crate::{MAPPED, MULTIPLIER, PENALTY, basis_for, build, grid_basis, physics, run};
use lumley_rom::{Integrator, ReducedPiston, Rosenbrock};
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
    assert!(error.to_string().contains("6 unknowns, the model 5"), "{error}");
    Ok(())
}
