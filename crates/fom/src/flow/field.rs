use lumley_fem::Point;

/// A vector that depends on place and time: a given velocity in m/s, or a body force in m/s².
///
/// Every closure of that signature is one.
///
/// ```
/// use lumley_fom::flow::VectorField;
/// let shear = |[_, y]: [f64; 2], _time: f64| [2.0 * y, 0.0];
/// assert_eq!(shear.value([0.0, 0.5], 0.0), [1.0, 0.0]);
/// ```
pub trait VectorField: Send + Sync {
    /// The vector at a point in m, at a time in s.
    fn value(&self, at: Point, time: f64) -> Point;
}

impl<F: Fn(Point, f64) -> Point + Send + Sync> VectorField for F {
    fn value(&self, at: Point, time: f64) -> Point {
        self(at, time)
    }
}
