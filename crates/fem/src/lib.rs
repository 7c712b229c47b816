//! The ground under the models: grids, meshes, reference elements, quadrature, spaces, fields, and the
//! transfer of a field from a moving mesh to a fixed grid.
//!
//! This crate knows no equation, no body dynamics, no POD and no file.

mod characteristic;
pub mod element;
mod field;
pub mod geometry;
mod grid;
mod grid_divergence;
mod location;
mod mesh;
pub mod quadrature;
pub mod space;
pub mod transfer;

pub use characteristic::characteristic;
pub use field::MovingField;
pub use grid::UniformGrid;
pub use grid_divergence::{DivergenceSquares, GridDivergence};
pub use location::{Location, PointLocator};
pub use mesh::{
    Boundary, CellPlace, CellQuality, Edge, EdgePlace, Extreme, LineMesh, MeshDescription,
    MeshError, MeshQuality, NamedBoundary, NodePlace, NodeRole, PlanarMesh, Side, Topology,
    generate,
};

/// A point of the plane, in m. On a line the second coordinate is zero.
pub type Point = [f64; 2];
