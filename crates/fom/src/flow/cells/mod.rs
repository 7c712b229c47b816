//! Cell by cell: integrals, elimination of the interior unknowns and their recovery, for both kinds of cells.

#![expect(
    clippy::inline_always,
    reason = "loops become vectors only inside the dispatch over instruction sets"
)]
#![expect(clippy::needless_range_loop, reason = "indices run over several arrays at once")]

mod condense;
mod group;
mod integrals;
mod lanes;

pub use condense::{INTERIOR, recover, recovery, rim};
pub use group::{Group, NodalFields, Output};
pub use integrals::{Terms, reference_points};
