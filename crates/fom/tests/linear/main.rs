//! The linear solvers against faer's, on random cells and on saddle points.

mod gmres;
mod lagged;
mod oseen;
mod random;
mod saddle_point;
mod singular;
