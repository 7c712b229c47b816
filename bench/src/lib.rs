//! Benchmarks of lumley, one file each in `benches/` and `src/bin/`, and the bindings to libraries beside which it is timed.
#![deny(unsafe_code)]

#[cfg(feature = "mumps")]
pub mod mumps;
