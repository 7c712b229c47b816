//! The tree of bodies against closed formulas, exact motions and difference quotients.

mod bad_input;
mod case_files;
mod derivatives;
mod fixtures;
mod motion;
mod two_link;
