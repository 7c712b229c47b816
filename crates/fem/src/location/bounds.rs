use crate::{PlanarMesh, Point};

/// By how much of its extent the box of a cell is larger than the cell: more than the tolerance of the map's
/// inverse.
const MARGIN: f64 = 1e-8;

/// A box with sides along the axes, in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bounds {
    pub lower: Point,
    pub upper: Point,
}

impl Bounds {
    /// What contains nothing.
    pub const EMPTY: Self = Self { lower: [f64::INFINITY; 2], upper: [f64::NEG_INFINITY; 2] };

    /// A box round a curved cell, a little larger. Its edges are parabolas, which lie in the triangles of
    /// their control points; the cell lies within its edges.
    pub fn of_cell(mesh: &PlanarMesh, cell: usize) -> Self {
        let topology = mesh.topology();
        let (nodes, corners) = (topology.cell_nodes(cell), topology.kind(cell).vertices());
        let at = |k: usize| mesh.nodes()[nodes[k]];
        let mut bounds = Self::EMPTY;
        for k in 0..corners {
            let (a, b, middle) = (at(k), at((k + 1) % corners), at(corners + k));
            bounds.add(a);
            bounds.add([0, 1].map(|d| 2.0 * middle[d] - 0.5 * (a[d] + b[d])));
        }
        bounds.widened()
    }

    fn widened(self) -> Self {
        let ([a, b], [c, d]) = (self.lower, self.upper);
        let largest = a.abs().max(b.abs()).max(c.abs()).max(d.abs());
        let margin = MARGIN * (c - a).max(d - b) + 64.0 * f64::EPSILON * largest;
        Self { lower: self.lower.map(|x| x - margin), upper: self.upper.map(|x| x + margin) }
    }

    fn add(&mut self, point: Point) {
        self.lower = [0, 1].map(|d| self.lower[d].min(point[d]));
        self.upper = [0, 1].map(|d| self.upper[d].max(point[d]));
    }

    /// The smallest box round both.
    pub fn union(mut self, other: &Self) -> Self {
        self.add(other.lower);
        self.add(other.upper);
        self
    }

    pub fn contains(&self, point: Point) -> bool {
        (0..2).all(|d| self.lower[d] <= point[d] && point[d] <= self.upper[d])
    }

    /// Square of the distance of a point, zero inside, in m².
    pub fn square_distance(&self, point: Point) -> f64 {
        let beyond = |d: usize| (self.lower[d] - point[d]).max(point[d] - self.upper[d]).max(0.0);
        beyond(0) * beyond(0) + beyond(1) * beyond(1)
    }
}
