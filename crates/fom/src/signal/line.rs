/// A straight line, `value + slope (t − centre)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Line {
    pub centre: f64,
    pub value: f64,
    pub slope: f64,
}

impl Line {
    /// The line of least squares through some points; horizontal if they have all one time.
    pub fn through(points: &(impl Iterator<Item = (f64, f64)> + Clone)) -> Self {
        let mean = |f: &dyn Fn((f64, f64)) -> f64| {
            let (count, sum) = points.clone().fold((0.0, 0.0), |(n, sum), p| (n + 1.0, sum + f(p)));
            sum / count
        };
        let (centre, value) = (mean(&|(t, _)| t), mean(&|(_, y)| y));
        let square = mean(&|(t, _)| (t - centre).powi(2));
        let product = mean(&|(t, y)| (t - centre) * (y - value));
        Self { centre, value, slope: if square > 0.0 { product / square } else { 0.0 } }
    }

    pub fn at(&self, time: f64) -> f64 {
        self.value + self.slope * (time - self.centre)
    }

    /// Where a line that rises crosses zero.
    pub fn upward_root(&self) -> Option<f64> {
        (self.slope > 0.0).then(|| self.centre - self.value / self.slope)
    }
}
