use super::PlanarMesh;
use super::planar::{length, length_rule};
use crate::Point;
use crate::element::{Cell, Element, Q2, TriangleP2};
use crate::geometry::{Mapped, Tabulated};
use crate::quadrature::rule;
use serde::Serialize;

/// How good a cell is.
///
/// ```
/// use lumley_fem::{MeshDescription, PlanarMesh};
/// let mesh = PlanarMesh::new(MeshDescription::structured([1, 1], |_| false, |[x, y]| [3.0 * x, y]))?;
/// let cell = mesh.cell_qualities()[0];
/// assert!((cell.aspect - 3.0).abs() < 1e-12 && (cell.scaled_jacobian - 1.0).abs() < 1e-12);
/// assert!((cell.shortest_edge - 1.0).abs() < 1e-12 && (cell.area - 3.0).abs() < 1e-12);
/// # Ok::<(), lumley_fem::MeshError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CellQuality {
    /// Area, in m².
    pub area: f64,
    /// Smallest over largest determinant of the cell's map at its nodes (Persson and Peraire 2009, AIAA
    /// paper 2009-949): 1 for an affine cell, 0 for one about to fold.
    pub scaled_jacobian: f64,
    /// Largest ratio, at the nodes, of the singular values of the map from the equilateral triangle or the
    /// square: how much longer than wide. It is the condition number of Knupp (2001, SIAM J. Sci. Comput.
    /// 23, 193-218) in the spectral norm; 1 is best.
    pub aspect: f64,
    /// Length of the shortest edge, in m.
    pub shortest_edge: f64,
    /// Length of the longest edge, in m.
    pub longest_edge: f64,
}

/// A value with the cell that has it.
///
/// ```
/// let worst = lumley_fem::Extreme { value: 0.2, cell: 17 };
/// assert_eq!(worst.cell, 17);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Extreme {
    /// The value.
    pub value: f64,
    /// The cell; triangles count first.
    pub cell: usize,
}

/// The quality of a mesh in numbers for a report.
///
/// ```
/// use lumley_fem::{MeshDescription, PlanarMesh};
/// let mesh = PlanarMesh::new(MeshDescription::structured([4, 2], |[i, _]| i < 2, |p| p))?;
/// let quality = mesh.quality();
/// assert_eq!((quality.triangles, quality.quadrilaterals), (8, 4));
/// assert!((quality.area - 1.0).abs() < 1e-14 && (quality.shortest_edge.value - 0.25).abs() < 1e-14);
/// # Ok::<(), lumley_fem::MeshError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MeshQuality {
    /// Number of triangles.
    pub triangles: usize,
    /// Number of quadrilaterals.
    pub quadrilaterals: usize,
    /// Number of geometry nodes.
    pub nodes: usize,
    /// Area of the domain, in m².
    pub area: f64,
    /// The worst scaled Jacobian, see [`CellQuality`].
    pub scaled_jacobian: Extreme,
    /// The largest aspect, see [`CellQuality`].
    pub aspect: Extreme,
    /// The shortest edge, in m.
    pub shortest_edge: Extreme,
    /// The longest edge, in m.
    pub longest_edge: Extreme,
}

impl PlanarMesh {
    /// The quality of every cell.
    pub fn cell_qualities(&self) -> Vec<CellQuality> {
        let edges = length_rule();
        let lengths: Vec<f64> =
            (0..self.topology().edges().len()).map(|e| length(&self.edge(e), &edges)).collect();
        let (triangle, quadrilateral) = (Gauge::new(&TriangleP2), Gauge::new(&Q2));
        let triangles = self.topology().triangles().len();
        (0..self.topology().cells())
            .map(|cell| {
                let of_edges = self.topology().cell_edges(cell).iter().map(|&edge| lengths[edge]);
                match cell.checked_sub(triangles) {
                    None => triangle.measure(&self.triangle(cell), of_edges),
                    Some(q) => quadrilateral.measure(&self.quadrilateral(q), of_edges),
                }
            })
            .collect()
    }

    /// The quality of the mesh as a whole.
    pub fn quality(&self) -> MeshQuality {
        let cells = self.cell_qualities();
        let all = |value: fn(&CellQuality) -> f64| {
            let of_cell = move |(cell, quality)| Extreme { value: value(quality), cell };
            cells.iter().enumerate().map(of_cell)
        };
        MeshQuality {
            triangles: self.topology().triangles().len(),
            quadrilaterals: self.topology().quadrilaterals().len(),
            nodes: self.topology().nodes(),
            area: cells.iter().map(|cell| cell.area).sum(),
            scaled_jacobian: least(all(|cell| cell.scaled_jacobian)),
            aspect: greatest(all(|cell| cell.aspect)),
            shortest_edge: least(all(|cell| cell.shortest_edge)),
            longest_edge: greatest(all(|cell| cell.longest_edge)),
        }
    }
}

/// The first of the smallest values of a mesh, which has a cell.
fn least(values: impl Iterator<Item = Extreme>) -> Extreme {
    let first = Extreme { value: f64::INFINITY, cell: 0 };
    values.fold(first, |a, b| if b.value < a.value { b } else { a })
}

fn greatest(values: impl Iterator<Item = Extreme>) -> Extreme {
    let opposite = least(values.map(|e| Extreme { value: -e.value, ..e }));
    Extreme { value: -opposite.value, ..opposite }
}

/// What the quality of a kind of cell is measured with.
struct Gauge<const N: usize> {
    kind: Cell,
    at_nodes: Vec<Tabulated<N>>,
    area: Vec<Tabulated<N>>,
}

impl<const N: usize> Gauge<N> {
    fn new(element: &'static dyn Element) -> Self {
        let kind = element.layout().cell;
        Self {
            kind,
            at_nodes: Tabulated::at_nodes(element, element),
            area: Tabulated::on(element, &rule(kind, 3)),
        }
    }

    fn measure(&self, nodes: &[Point; N], edges: impl Iterator<Item = f64> + Clone) -> CellQuality {
        let mapped = || self.at_nodes.iter().map(|at| Mapped::new(nodes, at));
        let determinants = || mapped().map(|m| m.determinant);
        CellQuality {
            area: self.area.iter().map(|at| Mapped::new(nodes, at).weight).sum(),
            scaled_jacobian: determinants().fold(f64::INFINITY, f64::min)
                / determinants().fold(f64::NEG_INFINITY, f64::max),
            aspect: mapped().map(|m| singular_ratio(self.against_ideal(&m))).fold(1.0, f64::max),
            shortest_edge: edges.clone().fold(f64::INFINITY, f64::min),
            longest_edge: edges.fold(0.0, f64::max),
        }
    }

    /// The Jacobian of the map from the best cell of this kind.
    fn against_ideal(&self, mapped: &Mapped) -> [[f64; 2]; 2] {
        match self.kind {
            Cell::Triangle => {
                let height = 0.75_f64.sqrt();
                mapped.jacobian.map(|[a, b]| [a, (b - 0.5 * a) / height])
            }
            _ => mapped.jacobian,
        }
    }
}

/// Larger over smaller singular value, r, from `(r + 1/r)/2 = |A|²/(2 det A)`.
fn singular_ratio([[a, b], [c, d]]: [[f64; 2]; 2]) -> f64 {
    let mean = (a * a + b * b + c * c + d * d) / (2.0 * (a * d - b * c).abs());
    mean + (mean * mean - 1.0).max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MeshDescription;

    fn mesh(cut: bool, map: impl Fn(Point) -> Point) -> PlanarMesh {
        PlanarMesh::new(MeshDescription::structured([2, 2], |_| cut, map)).expect("valid")
    }

    /// A rhombus with two equilateral halves. Close to one, the aspect has the root of the round-off.
    #[test]
    fn equilateral_triangles_and_squares_are_best() {
        let rhombus = |[x, y]: Point| [x - 0.5 * y, 0.75_f64.sqrt() * y];
        for best in [mesh(true, rhombus), mesh(false, |[x, y]| [3.0 - y, x])] {
            for cell in best.cell_qualities() {
                assert!((cell.aspect - 1.0).abs() < 1e-7, "{cell:?}");
                assert!((cell.scaled_jacobian - 1.0).abs() < 1e-14, "{cell:?}");
                assert!((cell.longest_edge - cell.shortest_edge).abs() < 1e-15, "{cell:?}");
            }
        }
    }

    /// The right-angled triangle: `J W⁻¹ = [[1, −1/√3], [0, 2/√3]]` has singular values of ratio √3.
    #[test]
    fn aspect_of_a_right_angled_triangle_is_the_root_of_three() {
        for cell in mesh(true, |p| p).cell_qualities() {
            assert!((cell.aspect - 3.0_f64.sqrt()).abs() < 1e-12, "{cell:?}");
        }
    }

    /// Under `x ↦ x + x²/2` on (0, 1) in two columns, the determinant is `1 + x` up to a factor.
    #[test]
    fn scaled_jacobian_of_a_stretched_row() {
        let quality = mesh(false, |[x, y]| [x + 0.5 * x * x, y]).quality();
        assert!((quality.scaled_jacobian.value - 1.0 / 1.5).abs() < 1e-14, "{quality:?}");
        assert_eq!(quality.scaled_jacobian.cell, 0);
        assert!((quality.area - 1.5).abs() < 1e-14);
        assert!((quality.longest_edge.value - (1.5 - 0.625)).abs() < 1e-14);
        assert!((quality.aspect.value - 2.0).abs() < 1e-12, "{quality:?}");
    }
}
