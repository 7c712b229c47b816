use crate::Point;

/// A planar mesh of quadratic cells as generators and files give it: unchecked.
///
/// Every cell lists its corners counterclockwise, then the middle of each edge from a corner to the
/// next, a quadrilateral also its centre. Middles lie anywhere on a curved edge.
///
/// ```
/// use lumley_fem::{MeshDescription, PlanarMesh};
/// // Two by one cells on a rectangle of 2 m x 1 m, the second cell cut into two triangles.
/// let cut = |[i, _]: [usize; 2]| i == 1;
/// let description = MeshDescription::structured([2, 1], cut, |[x, y]| [2.0 * x, y]);
/// assert_eq!((description.quadrilaterals.len(), description.triangles.len()), (1, 2));
/// let mesh = PlanarMesh::new(description)?;
/// assert_eq!(mesh.topology().boundaries()[3].name, "left");
/// # Ok::<(), lumley_fem::MeshError>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MeshDescription {
    /// Geometry nodes, in m.
    pub points: Vec<Point>,
    /// Corners, then the middles of the edges.
    pub triangles: Vec<[usize; 6]>,
    /// Corners, the middles of the edges, the centre.
    pub quadrilaterals: Vec<[usize; 9]>,
    /// The rim of the domain: each of its edges belongs to exactly one.
    pub boundaries: Vec<NamedBoundary>,
}

/// A part of the rim of the domain, with the name that boundary conditions refer to.
///
/// ```
/// use lumley_fem::NamedBoundary;
/// let inlet = NamedBoundary { name: "inlet".into(), edges: vec![[0, 3, 7]] };
/// assert_eq!(inlet.edges[0][2], 7, "the middle comes last");
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct NamedBoundary {
    /// Its name.
    pub name: String,
    /// Nodes of its edges: one end, the other, the middle.
    pub edges: Vec<[usize; 3]>,
}

impl MeshDescription {
    /// `cells[0] x cells[1]` quadrilaterals on the image of the unit square under `map`, in m; where `cut`
    /// says so of a column and a row, two triangles stand in their place.
    ///
    /// The boundaries are bottom, right, top and left, as the square has them. `map` must keep
    /// orientation.
    pub fn structured(
        cells: [usize; 2],
        cut: impl Fn([usize; 2]) -> bool,
        map: impl Fn(Point) -> Point,
    ) -> Self {
        let lattice = Lattice { cells };
        let mut description = Self {
            points: lattice.points().map(map).collect(),
            boundaries: lattice.boundaries(),
            ..Self::default()
        };
        for row in 0..cells[1] {
            for column in 0..cells[0] {
                let [v0, v1, v2, v3, m0, m1, m2, m3, centre] = lattice.cell(column, row);
                if cut([column, row]) {
                    description.triangles.push([v0, v1, v2, m0, m1, centre]);
                    description.triangles.push([v0, v2, v3, centre, m2, m3]);
                } else {
                    let nodes = [v0, v1, v2, v3, m0, m1, m2, m3, centre];
                    description.quadrilaterals.push(nodes);
                }
            }
        }
        description
    }
}

/// The nodes of a structured mesh, row by row, two steps a cell.
struct Lattice {
    cells: [usize; 2],
}

impl Lattice {
    fn node(&self, i: usize, j: usize) -> usize {
        j * (2 * self.cells[0] + 1) + i
    }

    fn points(&self) -> impl Iterator<Item = Point> {
        let [nx, ny] = self.cells.map(|n| 2 * n);
        let fraction = |k: usize, n: usize| k as f64 / n as f64;
        (0..=ny).flat_map(move |j| (0..=nx).map(move |i| [fraction(i, nx), fraction(j, ny)]))
    }

    fn cell(&self, column: usize, row: usize) -> [usize; 9] {
        let (i, j) = (2 * column, 2 * row);
        [[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [2, 1], [1, 2], [0, 1], [1, 1]]
            .map(|[a, b]| self.node(i + a, j + b))
    }

    fn boundaries(&self) -> Vec<NamedBoundary> {
        let [nx, ny] = self.cells.map(|n| 2 * n);
        let side = |name: &str, steps: usize, node: &dyn Fn(usize) -> usize| NamedBoundary {
            name: name.into(),
            edges: (0..steps).step_by(2).map(|k| [node(k), node(k + 2), node(k + 1)]).collect(),
        };
        vec![
            side("bottom", nx, &|k| self.node(k, 0)),
            side("right", ny, &|k| self.node(nx, k)),
            side("top", nx, &|k| self.node(nx - k, ny)),
            side("left", ny, &|k| self.node(0, ny - k)),
        ]
    }
}
