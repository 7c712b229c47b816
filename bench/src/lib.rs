//! Benchmarks of lumley, one file each in `benches/`.
