//! A step allocates nothing.

// A global allocator is unsafe to write; this one counts and passes on.
#![allow(unsafe_code)]

mod canonical;

use lumley_fom::{Piston, PistonError, TimeScheme};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: every call goes to the system's allocator as it came.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        unsafe { System.dealloc(memory, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

#[test]
fn steps_allocate_nothing() -> Result<(), PistonError> {
    for scheme in [TimeScheme::ImplicitEuler, TimeScheme::CrankNicolson, TimeScheme::Bdf2] {
        for degree in [1, 2] {
            let start = ALLOCATIONS.get();
            let mut piston = Piston::new(&canonical::parameters(1.0), 50, degree, scheme)?;
            let built = ALLOCATIONS.get();
            assert!(built > start, "the counter counts");
            for _ in 0..100 {
                piston.step(1e-3)?;
            }
            assert_eq!(ALLOCATIONS.get(), built, "{scheme:?}, degree {degree}");
        }
    }
    Ok(())
}
