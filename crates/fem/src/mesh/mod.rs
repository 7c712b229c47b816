//! Meshes: the topology of cells and nodes, apart from the coordinates, which may move.

mod bernstein;
mod cells;
mod check;
mod description;
mod error;
pub mod generate;
mod jacobian;
mod line;
mod place;
mod planar;
mod quality;
mod topology;

pub(crate) use cells::entries;
pub use description::{MeshDescription, NamedBoundary};
pub use error::MeshError;
pub use line::LineMesh;
pub use place::{CellPlace, EdgePlace, NodePlace, NodeRole};
pub use planar::PlanarMesh;
pub use quality::{CellQuality, Extreme, MeshQuality};
pub use topology::{Boundary, Edge, Side, Topology};
