//! The flow solver.

mod bodies;
mod conditions;
mod exact;
mod loads;
mod manufactured;
mod pendulum;
mod reference;
mod restart;
mod setups;
mod trees;
mod trouble;
