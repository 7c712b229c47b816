use crate::Point;
use std::fmt;

/// A node and where it is.
///
/// ```
/// let node = lumley_fem::NodePlace { node: 7, place: [0.5, 2.0] };
/// assert_eq!(node.to_string(), "node 7 at (0.5, 2) m");
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NodePlace {
    /// Its number, from 0.
    pub node: usize,
    /// Where it is, in m.
    pub place: Point,
}

impl fmt::Display for NodePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "node {} at ({}, {}) m", self.node, self.place[0], self.place[1])
    }
}

/// A cell and where it is. Cells are numbered from 0, triangles first.
///
/// ```
/// let cell = lumley_fem::CellPlace { cell: 7, place: [0.5, 2.0] };
/// assert_eq!(cell.to_string(), "cell 7 near (0.5, 2) m");
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellPlace {
    /// Its number, from 0, triangles first.
    pub cell: usize,
    /// A point of it, in m.
    pub place: Point,
}

impl fmt::Display for CellPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "cell {} near ({}, {}) m", self.cell, self.place[0], self.place[1])
    }
}

/// An edge, by the nodes at its ends, and where it is.
///
/// ```
/// let edge = lumley_fem::EdgePlace { ends: [3, 7], place: [0.5, 2.0] };
/// assert_eq!(edge.to_string(), "the edge from node 3 to node 7 near (0.5, 2) m");
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgePlace {
    /// Nodes at its ends, from 0.
    pub ends: [usize; 2],
    /// Half way between its ends, in m.
    pub place: Point,
}

impl fmt::Display for EdgePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([a, b], [x, y]) = (self.ends, self.place);
        write!(f, "the edge from node {a} to node {b} near ({x}, {y}) m")
    }
}

/// What a node is in a cell that uses it.
///
/// ```
/// assert_eq!(lumley_fem::NodeRole::Middle.to_string(), "the middle of an edge");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NodeRole {
    /// A corner.
    Corner,
    /// The middle of an edge.
    Middle,
    /// The centre of a quadrilateral.
    Centre,
}

impl fmt::Display for NodeRole {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Corner => "a corner",
            Self::Middle => "the middle of an edge",
            Self::Centre => "the centre of a cell",
        })
    }
}
