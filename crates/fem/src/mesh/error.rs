use super::place::{CellPlace, EdgePlace, NodePlace, NodeRole};

/// What is wrong with a mesh, where, and what to do.
///
/// ```
/// use lumley_fem::{MeshDescription, MeshError, PlanarMesh};
/// assert_eq!(PlanarMesh::new(MeshDescription::default()).unwrap_err(), MeshError::NoCells);
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// Nothing to compute on.
    #[error("the mesh has no cells: give at least one triangle or quadrilateral")]
    NoCells,
    /// A coordinate that is NaN, infinite or beyond 1e75 m.
    #[error("{0}: coordinates must be finite numbers of a sensible size")]
    NotFinite(NodePlace),
    /// A cell with a node that is not there.
    #[error("cell {cell} has the node {node}, but the mesh has {nodes} nodes, numbered from 0")]
    CellIndex {
        /// The cell.
        cell: usize,
        /// The node that it names.
        node: usize,
        /// Number of nodes.
        nodes: usize,
    },
    /// A boundary with a node that is not there.
    #[error(
        "boundary \"{name}\" has the node {node}, but the mesh has {nodes} nodes, numbered from 0"
    )]
    BoundaryIndex {
        /// The boundary.
        name: String,
        /// The node that it names.
        node: usize,
        /// Number of nodes.
        nodes: usize,
    },
    /// A cell that has one node twice.
    #[error(
        "{node} stands twice in cell {cell}: a quadratic cell needs all its nodes, each at its own place"
    )]
    RepeatedNode {
        /// The cell.
        cell: usize,
        /// The node.
        node: NodePlace,
    },
    /// Nodes that no cell has.
    #[error(
        "{first} belongs to no cell, one of {count} such nodes: remove them or their cells are missing"
    )]
    Dangling {
        /// The first of them.
        first: NodePlace,
        /// How many there are.
        count: usize,
    },
    /// Two nodes in one place.
    #[error(
        "{first} and node {second} are in the same place: merge them, or the mesh has an open seam there"
    )]
    DuplicateNodes {
        /// One of them.
        first: NodePlace,
        /// The other.
        second: usize,
    },
    /// Two cells with the same corners.
    #[error("{first} and cell {second} have the same corners: remove one of them")]
    DuplicateCells {
        /// One of them.
        first: CellPlace,
        /// The other.
        second: usize,
    },
    /// A cell that is inside out, flat or folded.
    #[error(
        "{cell}: the determinant of its map is {determinant:e} m² there, expected above 0: list the corners counterclockwise; if they are, the cell is flat, tangled or its curved edge too strongly bent: straighten the edge, refine there, or move the mesh less"
    )]
    Inverted {
        /// The cell, with the place where it is worst.
        cell: CellPlace,
        /// Determinant of the map from the reference cell there, in m².
        determinant: f64,
    },
    /// More than two cells on one edge.
    #[error("{edge} belongs to more than two cells, {cells:?}: they overlap, remove one")]
    CrowdedEdge {
        /// The edge.
        edge: EdgePlace,
        /// The first three of its cells.
        cells: [usize; 3],
    },
    /// Two cells on the same side of their edge.
    #[error("cells {} and {} lie on the same side of {edge}: they overlap, remove one", .cells[0], .cells[1])]
    Overlap {
        /// The edge.
        edge: EdgePlace,
        /// The cells.
        cells: [usize; 2],
    },
    /// Two cells that do not agree on the middle of their edge.
    #[error(
        "cells {} and {} share {edge}, but its middle is node {} for one and node {} for the other: give both the same",
        .cells[0], .cells[1], .middles[0], .middles[1]
    )]
    Middles {
        /// The edge.
        edge: EdgePlace,
        /// The cells.
        cells: [usize; 2],
        /// The middle of each.
        middles: [usize; 2],
    },
    /// A node that is one thing for one cell and another thing for the next.
    #[error(
        "{node} is {} and also {}: neighbours must share whole edges (no hanging nodes)",
        .roles[0], .roles[1]
    )]
    TwoRoles {
        /// The node.
        node: NodePlace,
        /// What it is.
        roles: [NodeRole; 2],
    },
    /// A boundary without a name.
    #[error("boundary number {0} (from 0) has no name: conditions refer to boundaries by name")]
    BlankName(usize),
    /// Two boundaries of one name.
    #[error("two boundaries are called \"{0}\": merge them or rename one")]
    NameTwice(String),
    /// A boundary without edges.
    #[error("boundary \"{0}\" has no edges: remove it or name the edges that belong to it")]
    EmptyBoundary(String),
    /// A boundary edge that joins what no cell joins.
    #[error("boundary \"{name}\" has {edge}, which is the edge of no cell")]
    NoSuchEdge {
        /// The boundary.
        name: String,
        /// The edge.
        edge: EdgePlace,
    },
    /// A boundary edge whose middle is not that of its cell.
    #[error(
        "boundary \"{name}\" gives {edge} the middle node {given}, its cell gives it {expected}: give both the same"
    )]
    BoundaryMiddle {
        /// The boundary.
        name: String,
        /// The edge.
        edge: EdgePlace,
        /// The boundary's middle.
        given: usize,
        /// The cell's middle.
        expected: usize,
    },
    /// A boundary edge with cells on both sides.
    #[error(
        "boundary \"{name}\" has {edge}, which is inside of the domain, between cells {} and {}: only the rim has boundaries",
        .cells[0], .cells[1]
    )]
    BoundaryInside {
        /// The boundary.
        name: String,
        /// The edge.
        edge: EdgePlace,
        /// The cells on its sides.
        cells: [usize; 2],
    },
    /// A rim edge with two names, or twice in one boundary.
    #[error(
        "{edge} belongs to boundary \"{}\" and to \"{}\": every edge of the rim needs exactly one name",
        .names[0], .names[1]
    )]
    NamedTwice {
        /// The edge.
        edge: EdgePlace,
        /// The boundaries.
        names: [String; 2],
    },
    /// Rim edges that belong to no boundary.
    #[error(
        "{first} is on the rim but in no boundary, one of {count} such edges: name them, or close the seam between cells that should touch there"
    )]
    Unnamed {
        /// The first of them.
        first: EdgePlace,
        /// How many there are.
        count: usize,
    },
}
