//! The flow solver.

mod conditions;
mod exact;
mod loads;
mod manufactured;
mod reference;
mod restart;
mod setups;
