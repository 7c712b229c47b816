//! The flow solver.

mod conditions;
mod exact;
mod manufactured;
mod restart;
mod setups;
