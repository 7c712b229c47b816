use crate::Point;

/// The functions of the discontinuous linear pressure on a cell: 1, `(x − x_c)/h`, `(y − y_c)/h`.
///
/// They are linear in space, not on the reference cell: mapped ones lose an order on quadrilaterals
/// that are not parallelograms (Boffi and Gastaldi 2002, Int. J. Numer. Methods Fluids 39, 1001-1011).
/// With `x_c` the centroid the first coefficient is the mean pressure of the cell; `h` is the root of
/// its area.
///
/// ```
/// use lumley_fem::space::LinearPressure;
/// // The square from (0, 0) to (2, 2), by a rule of one point.
/// let pressure = LinearPressure::centred([([1.0, 1.0], 4.0)]);
/// assert_eq!(pressure.values([2.0, 0.5]), [1.0, 0.5, -0.25]);
/// assert_eq!(pressure.gradients()[1], [0.5, 0.0]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearPressure {
    centre: Point,
    scale: f64,
}

impl LinearPressure {
    /// On the cell with these quadrature points, in m, and weights, in m²: their mean and the root of the
    /// weights' sum.
    ///
    /// Centroid and area are exact if the quadrature is exact to degree 4 on triangles, 5 on squares.
    pub fn centred(points: impl IntoIterator<Item = (Point, f64)>) -> Self {
        let (mut area, mut moment) = (0.0, [0.0; 2]);
        for (point, weight) in points {
            area += weight;
            moment = [0, 1].map(|d| moment[d] + weight * point[d]);
        }
        Self { centre: moment.map(|m| m / area), scale: area.sqrt() }
    }

    /// The centroid of the cell, in m.
    pub fn centre(&self) -> Point {
        self.centre
    }

    /// The functions at a point in m.
    pub fn values(&self, [x, y]: Point) -> [f64; 3] {
        [1.0, (x - self.centre[0]) / self.scale, (y - self.centre[1]) / self.scale]
    }

    /// The pressure with these coefficients at a point in m of the cell.
    ///
    /// ```
    /// use lumley_fem::space::LinearPressure;
    /// let of_cell = LinearPressure::centred([([1.0, 1.0], 4.0)]);
    /// assert_eq!(of_cell.pressure(&[3.0, 1.0, -2.0], [2.0, 0.5]), 4.0);
    /// ```
    pub fn pressure(&self, coefficients: &[f64; 3], point: Point) -> f64 {
        let [one, x, y] = self.values(point);
        coefficients[0] * one + coefficients[1] * x + coefficients[2] * y
    }

    /// The gradients of the functions, per m.
    pub fn gradients(&self) -> [Point; 3] {
        [[0.0; 2], [1.0 / self.scale, 0.0], [0.0, 1.0 / self.scale]]
    }
}
