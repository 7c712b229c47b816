/// Why a file of gmsh, read without an error, is not a mesh that can be used.
///
/// ```
/// use lumley::format::gmsh::GmshError;
/// let error = GmshError::NotPlanar { node: 7, z: 0.5 };
/// assert!(error.to_string().contains("node 7 has z = 0.5"));
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GmshError {
    /// More bytes than this machine can address.
    #[error("{bytes} bytes are more than this machine can address")]
    TooLong {
        /// Bytes of the file.
        bytes: u64,
    },
    /// A node out of the plane.
    #[error(
        "node {node} has z = {z}, expected 0\n  help: a mesh of the plane is needed; write one in x and y"
    )]
    NotPlanar {
        /// Number of the node in the file.
        node: u64,
        /// Its z, in m.
        z: f64,
    },
    /// There is no triangle and no quadrilateral.
    #[error(
        "no triangles and no quadrilaterals\n  help: give the surface a physical group, or set Mesh.SaveAll = 1"
    )]
    NoCells,
    /// A cell or a line of a node that is not in the file.
    #[error(
        "element {element} has node {node}, which is not in the file\n  help: the file is damaged; write it again"
    )]
    NoSuchNode {
        /// Number of the element in the file.
        element: u64,
        /// Number of the node.
        node: u64,
    },
    /// Two nodes of the same number.
    #[error("node {node} stands twice in the file\n  help: the file is damaged; write it again")]
    NodeTwice {
        /// Number of the node in the file.
        node: u64,
    },
    /// Two cells, or a cell and a line, that do not share the middle of their common edge.
    #[error("the edge from ({}, {}) to ({}, {}) m has two different middle nodes\n  help: let gmsh remove duplicate nodes (Coherence Mesh) and write the file again", ends[0][0], ends[0][1], ends[1][0], ends[1][1])]
    TwoMiddles {
        /// Its ends, in m.
        ends: [[f64; 2]; 2],
    },
    /// Edges of the rim that are in no physical group with a name.
    #[error("{count} edges of the rim have no name, the first from ({}, {}) to ({}, {}) m\n  help: put them in a physical group with a name: Physical Curve(\"wall\") = {{...}};", first[0][0], first[0][1], first[1][0], first[1][1])]
    Unnamed {
        /// How many.
        count: usize,
        /// Ends of the first of them, in m.
        first: [[f64; 2]; 2],
    },
    /// An edge of the rim that is in two physical groups.
    #[error("the edge from ({}, {}) to ({}, {}) m is in the physical groups {first} and {second}\n  help: put it in one of them only", ends[0][0], ends[0][1], ends[1][0], ends[1][1])]
    TwoNames {
        /// Its ends, in m.
        ends: [[f64; 2]; 2],
        /// A group.
        first: String,
        /// The other.
        second: String,
    },
}
