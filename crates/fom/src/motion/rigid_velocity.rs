use lumley_fem::Point;

/// The velocity of a rigid body: `v + ω × (x − centre)`, paper eq. (23) differentiated.
///
/// ```
/// use lumley_fom::motion::RigidVelocity;
/// // Three points of a wheel that rolls along x with 2 m/s and turns clockwise with 4 rad/s.
/// let points = [[0.0, 1.0], [0.5, 0.5], [-0.5, 0.5]];
/// let velocities = [[4.0, 0.0], [2.0, -2.0], [2.0, 2.0]];
/// let wheel = RigidVelocity::fit(points.into_iter().zip(velocities));
/// let [u, v] = wheel.at([0.0, 0.0]);
/// assert!(u.abs() < 1e-15 && v.abs() < 1e-15, "it touches the ground");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RigidVelocity {
    /// A point of the body, in m.
    pub centre: Point,
    /// Its velocity, in m/s.
    pub velocity: Point,
    /// Angular velocity ω, counterclockwise, in rad/s.
    pub rate: f64,
}

impl RigidVelocity {
    /// The rigid velocity that is nearest, in least squares, to these velocities at these points; zero
    /// without points.
    pub fn fit(samples: impl Iterator<Item = (Point, Point)> + Clone) -> Self {
        let mut sums = [0.0; 4];
        let mut count = 0.0_f64;
        for ([x, y], [u, v]) in samples.clone() {
            sums.iter_mut().zip([x, y, u, v]).for_each(|(sum, value)| *sum += value);
            count += 1.0;
        }
        let [x, y, u, v] = sums.map(|sum| sum / count.max(1.0));
        let (mut turning, mut inertia) = (0.0, 0.0);
        for ([px, py], [pu, pv]) in samples {
            let (arm, relative) = ([px - x, py - y], [pu - u, pv - v]);
            turning += arm[0] * relative[1] - arm[1] * relative[0];
            inertia += arm[0] * arm[0] + arm[1] * arm[1];
        }
        let rate = if inertia > 0.0 { turning / inertia } else { 0.0 };
        Self { centre: [x, y], velocity: [u, v], rate }
    }

    /// The velocity at a point in m, in m/s.
    pub fn at(&self, [x, y]: Point) -> Point {
        let Self { centre, velocity: [u, v], rate } = self;
        [u - rate * (y - centre[1]), v + rate * (x - centre[0])]
    }
}

#[cfg(test)]
mod tests {
    use super::RigidVelocity;

    #[test]
    fn a_body_at_rest_has_no_velocity_at_all() {
        let samples = [[0.1, 0.2], [0.7, -0.3]].into_iter().zip([[0.0; 2]; 2]);
        let at_rest = RigidVelocity::fit(samples);
        assert_eq!(at_rest.at([3.0, 5.0]), [0.0; 2]);
        assert_eq!(RigidVelocity::fit(std::iter::empty()), RigidVelocity::default());
    }

    #[test]
    fn what_is_not_rigid_is_left_out() {
        // A disc that turns with 3 rad/s about its centre and grows.
        let points = (0..8).map(|k| {
            let (sin, cos) = (f64::from(k) * std::f64::consts::FRAC_PI_4).sin_cos();
            [1.0 + cos, 2.0 + sin]
        });
        let velocity = |[x, y]: [f64; 2]| {
            let [a, b] = [x - 1.0, y - 2.0];
            [0.5 * a - 3.0 * b, 0.5 * b + 3.0 * a]
        };
        let fitted = RigidVelocity::fit(points.map(|p| (p, velocity(p))));
        assert!((fitted.rate - 3.0).abs() < 1e-14);
        let [u, v] = fitted.at([1.0, 2.0]);
        assert!(u.abs() < 1e-14 && v.abs() < 1e-14);
    }
}
