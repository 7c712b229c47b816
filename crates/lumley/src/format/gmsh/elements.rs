/// What an element of a file is to a mesh of the plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Point,
    Line,
    Triangle,
    Quadrilateral,
}

/// gmsh's number of a type of elements: what it is, and its nodes.
const TYPES: [(i32, Kind, usize); 8] = [
    (15, Kind::Point, 1),
    (1, Kind::Line, 2),
    (8, Kind::Line, 3),
    (2, Kind::Triangle, 3),
    (9, Kind::Triangle, 6),
    (3, Kind::Quadrilateral, 4),
    (16, Kind::Quadrilateral, 8),
    (10, Kind::Quadrilateral, 9),
];

/// What the elements with this number of gmsh's are and how many nodes they have, if they can be used.
pub(super) fn find(number: i32) -> Option<(Kind, usize)> {
    TYPES.into_iter().find(|row| row.0 == number).map(|(_, kind, nodes)| (kind, nodes))
}

/// For error messages.
pub(super) const EXPECTED: &str = "the type of points, lines, triangles or quadrilaterals of first or second order (15, 1, 8, 2, 9, 3, 16, 10)";
