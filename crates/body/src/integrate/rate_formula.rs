/// How an implicit scheme makes a rate of values: `y'₊ = new y₊ + now y + before y₋`, in 1/s.
///
/// A flow and the bodies in it use the same formula, so that they are one scheme.
///
/// ```
/// use lumley_body::RateFormula;
/// let euler = RateFormula { new: 10.0, now: -10.0, before: 0.0 };
/// assert_eq!(euler.rate(3.0, 2.0, 7.0), 10.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RateFormula {
    /// Weight of the new value, above 0.
    pub new: f64,
    /// Weight of the value before the step.
    pub now: f64,
    /// Weight of the value before the step before.
    pub before: f64,
}

impl RateFormula {
    /// The part of the rate that is known before the step.
    pub fn known(&self, now: f64, before: f64) -> f64 {
        self.now * now + self.before * before
    }

    /// The rate at the new instant.
    pub fn rate(&self, new: f64, now: f64, before: f64) -> f64 {
        self.new * new + self.known(now, before)
    }
}
