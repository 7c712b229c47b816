use crate::quadrature::gauss_legendre;
use crate::{MovingField, Point, UniformGrid};

/// Parts into which a cell of the grid is cut in each direction, so that a cell that the interface crosses
/// is integrated well enough.
const PARTS: usize = 4;

/// What is lost on the way to a grid.
///
/// ```
/// let error = lumley_fem::transfer::GridError { distance: 0.01, norm: 0.5 };
/// assert_eq!(error.distance / error.norm, 0.02);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GridError {
    /// `||v_h − v||` in L2 of the grid's domain, in m/s times m^(1/2) or m.
    pub distance: f64,
    /// `||v||`, in the same unit.
    pub norm: f64,
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
/// let error = grid_error(&Shear, &grid, &[0.0, 1.5, 3.0]);
/// assert!(error.distance < 1e-15);
/// assert!((error.norm - 3_f64.sqrt()).abs() < 1e-14);
/// ```
///
/// # Panics
/// If `values` has not one entry for each component at each node.
pub fn grid_error(field: &dyn MovingField, grid: &UniformGrid, values: &[f64]) -> GridError {
    let components = field.components();
    assert_eq!(values.len(), components * grid.len(), "one value for each component and node");
    let [line, column] = [0, 1].map(|d| points(grid.nodes()[d]));
    let (spacing, lower) = (grid.spacing(), grid.bounds().0);
    let cell_size: f64 = spacing[..grid.dimension()].iter().product();
    let mut exact = vec![0.0; components];
    let (mut distance, mut norm) = (0.0, 0.0);
    for (y, wy) in &column {
        for (x, wx) in &line {
            let point = [0, 1].map(|d| lower[d] + [x, y][d] * spacing[d]);
            global_velocity_at(field, point, &mut exact);
            for (c, exact) in exact.iter().enumerate() {
                let v = interpolate(&values[c * grid.len()..][..grid.len()], grid, [*x, *y]);
                distance += wx * wy * (v - exact) * (v - exact);
                norm += wx * wy * exact * exact;
            }
        }
    }
    GridError { distance: (distance * cell_size).sqrt(), norm: (norm * cell_size).sqrt() }
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

fn global_velocity_at(field: &dyn MovingField, point: Point, v: &mut [f64]) {
    if !field.is_fluid(point) || field.fluid_velocity(point, v).is_none() {
        field.solid_velocity(point, v);
    }
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
            let error = grid_error(&Cubic, &grid, &values);
            assert!((error.norm - 15_f64.sqrt().recip()).abs() < 1e-5, "{}", error.norm);
            error.distance
        };
        let order = (error(4) / error(8)).log2();
        assert!((order - 2.0).abs() < 0.02, "order {order}");
    }
}
