//! What a block of rows goes through: the work that grows with n M².

mod gram;
mod sketch;
mod substitution;

pub(crate) use gram::{add_gram, rows_per_block};
pub(crate) use sketch::{COPIES, Sketch};
pub(crate) use substitution::solve_right;
