//! Meshes: the topology of cells and nodes, apart from the coordinates, which may move.

mod line;

pub use line::LineMesh;
