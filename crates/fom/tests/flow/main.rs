//! The flow solver.

mod exact;
mod manufactured;
mod setups;
