use serde::{Deserialize, Serialize};

/// How time derivatives become differences. Each scheme gives the rate at the new instant as
///
/// ```text
/// y'₊ = c y₊ + (weights of what is known),
/// ```
///
/// and the equations hold at the new instant; the schemes differ in this one formula.
///
/// ```
/// use lumley_fom::TimeScheme;
/// assert_eq!(TimeScheme::default(), TimeScheme::Bdf2);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TimeScheme {
    /// `y'₊ = (y₊ − y)/dt`: first order, very damping; the paper's.
    ImplicitEuler,
    /// `y'₊ = 2 (y₊ − y)/dt − y'`, the trapezoidal rule: second order, the most accurate here, but it
    /// damps nothing, so that rough data ring.
    CrankNicolson,
    /// Backward differences over two steps of any lengths: second order, damping. The first step,
    /// and one more than twice as long as the step before it, is by Crank-Nicolson: beyond a ratio
    /// of `1 + √2` the formula is unstable (Grigorieff, 1983).
    #[default]
    Bdf2,
}

/// Largest ratio of a step to the one before that BDF2 takes; short of the limit `1 + √2`.
const LARGEST_GROWTH: f64 = 2.0;

/// The weights in `y'₊ = new y₊ + now y + before y₋ + rate y'`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RateFormula {
    pub new: f64,
    pub now: f64,
    pub before: f64,
    pub rate: f64,
}

impl RateFormula {
    /// The same for bodies, where the formula takes no rate.
    pub(crate) fn of_bodies(self) -> lumley_body::RateFormula {
        let Self { new, now, before, .. } = self;
        lumley_body::RateFormula { new, now, before }
    }
}

impl TimeScheme {
    /// The formula for a step `dt` after the step `previous`, both in s.
    pub(crate) fn formula(self, dt: f64, previous: Option<f64>) -> RateFormula {
        match (self, previous) {
            (Self::ImplicitEuler, _) => {
                RateFormula { new: 1.0 / dt, now: -1.0 / dt, before: 0.0, rate: 0.0 }
            }
            (Self::Bdf2, Some(previous)) if dt <= LARGEST_GROWTH * previous => {
                bdf2(dt, dt / previous)
            }
            _ => RateFormula { new: 2.0 / dt, now: -2.0 / dt, before: 0.0, rate: -1.0 },
        }
    }

    /// The same for a flow, whose impulsive start Crank-Nicolson would not damp: where BDF2 cannot be taken,
    /// implicit Euler is.
    pub(crate) fn damping_formula(self, dt: f64, previous: Option<f64>) -> RateFormula {
        match previous.filter(|previous| dt <= LARGEST_GROWTH * previous) {
            Some(_) => self.formula(dt, previous),
            None => Self::ImplicitEuler.formula(dt, None),
        }
    }
}

/// BDF2 with the step ratio `r`.
fn bdf2(dt: f64, r: f64) -> RateFormula {
    RateFormula {
        new: (1.0 + 2.0 * r) / ((1.0 + r) * dt),
        now: -(1.0 + r) / dt,
        before: r * r / ((1.0 + r) * dt),
        rate: 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How many of the monomials 1, t, t², ... the formula differentiates exactly.
    fn exact(formula: RateFormula, dt: f64, previous: f64) -> usize {
        let exact = |p: i32| {
            let slope = |t: f64| if p == 0 { 0.0 } else { f64::from(p) * t.powi(p - 1) };
            let by_formula = formula.new * dt.powi(p)
                + formula.now * 0.0_f64.powi(p)
                + formula.before * (-previous).powi(p)
                + formula.rate * slope(0.0);
            (by_formula - slope(dt)).abs() < 1e-12
        };
        (0..5).take_while(|&p| exact(p)).count()
    }

    #[test]
    fn orders_for_equal_and_unequal_steps() {
        for (dt, previous) in [(0.1, 0.1), (0.1, 0.06), (0.03, 0.1)] {
            for (scheme, expected) in [
                (TimeScheme::ImplicitEuler, 1),
                (TimeScheme::CrankNicolson, 2),
                (TimeScheme::Bdf2, 2),
            ] {
                let formula = scheme.formula(dt, Some(previous));
                assert_eq!(
                    exact(formula, dt, previous),
                    1 + expected,
                    "{scheme:?}, {dt} {previous}"
                );
            }
        }
    }

    #[test]
    fn bdf2_restarts_where_it_would_be_unstable() {
        let restart = TimeScheme::CrankNicolson.formula(0.1, None);
        assert_eq!(TimeScheme::Bdf2.formula(0.1, None), restart);
        assert_eq!(TimeScheme::Bdf2.formula(0.1, Some(0.04)), restart);
        assert_ne!(TimeScheme::Bdf2.formula(0.1, Some(0.06)), restart);
    }
}
