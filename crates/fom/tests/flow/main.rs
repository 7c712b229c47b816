//! The flow solver.

mod conditions;
mod exact;
mod loads;
mod manufactured;
mod restart;
mod setups;
