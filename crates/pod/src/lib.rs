//! Proper orthogonal decomposition (POD) of snapshots in any inner product, paper eqs. (1)-(10).
//!
//! This crate knows no mesh, no body, no time scheme and no file: it reads snapshots through
//! [`SnapshotSource`] and measures with an [`InnerProduct`].

mod inner_product;
mod snapshots;

pub use inner_product::InnerProduct;
pub use snapshots::{MemorySnapshots, SnapshotSource};
