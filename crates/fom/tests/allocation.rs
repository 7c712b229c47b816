//! A step allocates nothing.

mod canonical;
#[path = "../../fem/tests/counting/mod.rs"]
mod counting;

use counting::allocations;
use lumley_fom::{Piston, PistonError, TimeScheme};

#[test]
fn steps_allocate_nothing() -> Result<(), PistonError> {
    for scheme in [TimeScheme::ImplicitEuler, TimeScheme::CrankNicolson, TimeScheme::Bdf2] {
        for degree in [1, 2] {
            let start = allocations();
            let mut piston = Piston::new(&canonical::parameters(1.0), 50, degree, scheme)?;
            let built = allocations();
            assert!(built > start, "the counter counts");
            for _ in 0..100 {
                piston.step(1e-3)?;
            }
            assert_eq!(allocations(), built, "{scheme:?}, degree {degree}");
        }
    }
    Ok(())
}
