use super::{TransferError, finite_element};
use crate::quadrature::gauss_legendre;
use crate::{MovingField, Point, UniformGrid};

/// Parts into which a cell of the grid is cut in each direction, so that a cell that the interface crosses
/// is integrated well enough.
const PARTS: usize = 4;

/// What is lost on the way to a grid.
///
/// ```
/// let error = lumley_fem::transfer::GridError { norm: 0.5, distance: 0.01, ..Default::default() };
/// assert_eq!(error.distance / error.norm, 0.02);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct GridError {
    /// `||v_h − v||` in L2 of the grid's domain, in m/s times m^(1/2) or m.
    pub distance: f64,
    /// `||v||`, in the same unit.
    pub norm: f64,
    /// The largest `|v_h − v|` at a point of the quadrature, in m/s.
    pub largest_distance: f64,
    /// The largest `|v|` at one, in m/s.
    pub largest: f64,
}

/// Adds up squares at points of a quadrature.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Squares {
    sums: [f64; 2],
    largest: [f64; 2],
}

impl Squares {
    /// A point of this weight, with the squares of `v_h − v` and `v` there.
    pub fn add(&mut self, weight: f64, squares: [f64; 2]) {
        for ((sum, largest), square) in self.sums.iter_mut().zip(&mut self.largest).zip(squares) {
            *sum += weight * square;
            *largest = largest.max(square);
        }
    }

    /// The error, where weights are counted in this unit.
    pub fn error(&self, unit: f64) -> GridError {
        let [distance, norm] = self.sums.map(|sum| (unit * sum).sqrt());
        let [largest_distance, largest] = self.largest.map(f64::sqrt);
        GridError { distance, norm, largest_distance, largest }
    }
}

/// How far the (bi)linear field `v_h` with nodal values `values` is from the global velocity `v` of
/// `field`, paper eq. (29), by Gauss quadrature on parts of the grid's cells.
///
/// Component c at node i stands in `values[c * grid.len() + i]`, in m/s.
///
/// ```
/// use lumley_fem::{MovingField, Point, UniformGrid, transfer::grid_error};
/// struct Shear;
/// impl MovingField for Shear {
///     fn components(&self) -> usize { 1 }
///     fn nodes(&self) -> usize { 0 }
///     fn position(&self, _: usize) -> Point { unreachable!("it has no nodes") }
///     fn nodal_velocity(&self, _: usize, _: &mut [f64]) {}
///     fn is_fluid(&self, _: Point) -> bool { true }
///     fn fluid_velocity(&self, x: Point, v: &mut [f64]) -> Option<()> { v[0] = 3.0 * x[0]; Some(()) }
///     fn solid_velocity(&self, _: Point, _: &mut [f64]) {}
/// }
/// let grid = UniformGrid::line(0.0, 1.0, 3);
/// let error = grid_error(&Shear, &grid, &[0.0, 1.5, 3.0])?;
/// assert!(error.distance < 1e-15);
/// assert!((error.norm - 3_f64.sqrt()).abs() < 1e-14);
/// # Ok::<(), lumley_fem::transfer::TransferError>(())
/// ```
///
/// # Errors
/// [`TransferError::NotCovered`] where a point of the fluid lies in no cell of the mesh.
///
/// # Panics
/// If `values` has not one entry for each component at each node.
pub fn grid_error(
    field: &dyn MovingField,
    grid: &UniformGrid,
    values: &[f64],
) -> Result<GridError, TransferError> {
    let components = field.components();
    assert_eq!(values.len(), components * grid.len(), "one value for each component and node");
    let [line, column] = [0, 1].map(|d| points(grid.nodes()[d]));
    let (spacing, lower) = (grid.spacing(), grid.bounds().0);
    let cell_size: f64 = spacing[..grid.dimension()].iter().product();
    let mut exact = vec![0.0; components];
    let mut sum = Squares::default();
    for (y, wy) in &column {
        for (x, wx) in &line {
            let point = [0, 1].map(|d| lower[d] + [x, y][d] * spacing[d]);
            global_velocity_at(field, point, &mut exact)?;
            sum.add(wx * wy, squares(grid, values, [*x, *y], &exact));
        }
    }
    Ok(sum.error(cell_size))
}

/// `|v_h − v|²` and `|v|²` at a point counted in cells from the lower corner.
pub(super) fn squares(grid: &UniformGrid, values: &[f64], at: Point, exact: &[f64]) -> [f64; 2] {
    let components = values.chunks_exact(grid.len()).zip(exact);
    components.fold([0.0; 2], |[distance, norm], (values, exact)| {
        let v = interpolate(values, grid, at);
        [distance + (v - exact) * (v - exact), norm + exact * exact]
    })
}

/// Quadrature points of all cells of a direction with this many nodes, in cells; weights add up to their
/// number. One node, the missing direction of an interval, is a point of weight one.
fn points(nodes: usize) -> Vec<(f64, f64)> {
    let rule = gauss_legendre(2);
    let parts = PARTS as f64;
    let part = |k: usize| rule.iter().map(move |(s, w)| ((k as f64 + s) / parts, w / parts));
    match nodes {
        1 => vec![(0.0, 1.0)],
        n => (0..(n - 1) * PARTS).flat_map(part).collect(),
    }
}

/// Paper eq. (30) by the finite elements of the mesh.
fn global_velocity_at(
    field: &dyn MovingField,
    point: Point,
    v: &mut [f64],
) -> Result<(), TransferError> {
    if field.is_fluid(point) {
        return finite_element::interpolate(field, point, v);
    }
    field.solid_velocity(point, v);
    Ok(())
}

/// The (bi)linear field at a point counted in cells from the lower corner.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "inside of the grid")]
fn interpolate(values: &[f64], grid: &UniformGrid, at: Point) -> f64 {
    let nodes = grid.nodes();
    let cell = [0, 1].map(|d| (at[d] as usize).min(nodes[d].saturating_sub(2)));
    let along = |row: usize| {
        let first = row * nodes[0] + cell[0];
        let t = at[0] - cell[0] as f64;
        values[first] * (1.0 - t) + values[first + 1] * t
    };
    if grid.dimension() == 1 {
        return along(0);
    }
    let t = at[1] - cell[1] as f64;
    along(cell[1]) * (1.0 - t) + along(cell[1] + 1) * t
}

#[cfg(test)]
mod tests {
    use super::*;

    /// v = x y² in two dimensions, everywhere fluid.
    struct Cubic;

    impl MovingField for Cubic {
        fn components(&self) -> usize {
            1
        }
        fn nodes(&self) -> usize {
            0
        }
        fn position(&self, _: usize) -> Point {
            unreachable!("it has no nodes")
        }
        fn nodal_velocity(&self, _: usize, _: &mut [f64]) {}
        fn is_fluid(&self, _: Point) -> bool {
            true
        }
        fn fluid_velocity(&self, [x, y]: Point, v: &mut [f64]) -> Option<()> {
            v[0] = x * y * y;
            Some(())
        }
        fn solid_velocity(&self, _: Point, _: &mut [f64]) {}
    }

    /// The norm of x y² on the unit square is 1/sqrt(15); interpolation in y² errs by h²/4 at most
    /// and converges with the square of h.
    #[test]
    fn interpolation_converges_with_order_two_on_a_rectangle() {
        let error = |n: usize| {
            let grid = UniformGrid::rectangle([0.0; 2], [1.0; 2], [n + 1, n + 1]);
            let values: Vec<f64> =
                (0..grid.len()).map(|k| grid.point(k)).map(|[x, y]| x * y * y).collect();
            let error = grid_error(&Cubic, &grid, &values).expect("fluid everywhere");
            assert!((error.norm - 15_f64.sqrt().recip()).abs() < 1e-5, "{}", error.norm);
            assert!(error.largest < 1.0 && error.largest > 0.9, "{}", error.largest);
            // h²/4 at most, in the middle between two nodes at the right.
            let bound = 0.25 / (n * n) as f64;
            assert!((0.8 * bound..bound).contains(&error.largest_distance), "{error:?}");
            error.distance
        };
        let order = (error(4) / error(8)).log2();
        assert!((order - 2.0).abs() < 0.02, "order {order}");
    }

    /// Fluid up to `end` on a line, v = x/end; a solid with v = 1 beyond. The mesh ends at `covered`.
    struct Stretched {
        end: f64,
        covered: f64,
    }

    impl MovingField for Stretched {
        fn components(&self) -> usize {
            1
        }
        fn nodes(&self) -> usize {
            0
        }
        fn position(&self, _: usize) -> Point {
            unreachable!("it has no nodes")
        }
        fn nodal_velocity(&self, _: usize, _: &mut [f64]) {}
        fn is_fluid(&self, [x, _]: Point) -> bool {
            x <= self.end
        }
        fn fluid_velocity(&self, [x, _]: Point, v: &mut [f64]) -> Option<()> {
            v[0] = (x <= self.covered).then_some(x / self.end)?;
            Some(())
        }
        fn solid_velocity(&self, _: Point, v: &mut [f64]) {
            v[0] = 1.0;
        }
    }

    fn stretched(field: &Stretched, nodes: usize) -> Result<GridError, TransferError> {
        let grid = UniformGrid::line(0.0, 1.0, nodes);
        let at = |k: usize| (grid.point(k)[0] / field.end).min(1.0);
        grid_error(field, &grid, &(0..nodes).map(at).collect::<Vec<_>>())
    }

    /// `||v||² = end/3 + (1 − end)`. In the middle of a cell of length h, a kink of the slope s leaves
    /// `v_h − v = s h/4` there, linear to zero at the cell's ends: `distance² = h (s h/4)²/3`.
    #[test]
    fn a_solid_counts_and_a_kink_inside_of_a_cell_is_seen() -> Result<(), TransferError> {
        let on_node = stretched(&Stretched { end: 0.5, covered: 0.5 }, 5)?;
        assert!(on_node.distance < 1e-15, "{}", on_node.distance);
        assert!((on_node.norm - (0.5_f64 / 3.0 + 0.5).sqrt()).abs() < 1e-14, "{}", on_node.norm);
        for cells in [5, 15, 45] {
            let found = stretched(&Stretched { end: 0.5, covered: 0.5 }, cells + 1)?;
            let h = 1.0 / cells as f64;
            let expected = (h / 3.0).sqrt() * 2.0 * h / 4.0;
            assert!((found.distance / expected - 1.0).abs() < 1e-12, "{cells}: {found:?}");
        }
        Ok(())
    }

    #[test]
    fn fluid_outside_of_the_mesh_is_an_error() {
        let error = stretched(&Stretched { end: 0.8, covered: 0.6 }, 11).expect_err("a hole");
        let TransferError::NotCovered([x, _]) = error else { panic!("{error}") };
        assert!(x > 0.6 && x < 0.7, "{x}");
    }
}
