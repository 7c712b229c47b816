//! Axes: what they say, and how data become positions.

use super::ticks::{self, Ticks};
use crate::report::number;

/// Beyond this size a value is drawn as if it did not exist: ranges of larger ones overflow.
pub(super) const LARGEST: f64 = 1e300;

/// What an axis measures.
///
/// ```
/// use lumley::report::figure::Axis;
///
/// let time = Axis::new("time *t*", "s");
/// let error = Axis::new("Res(*N*)", "%").log().range(0.01, 100.0);
/// assert_eq!(time.title(0), "time *t* (s)");
/// assert_eq!(error.title(-3), "Res(*N*) (10^{−3} %)");
/// ```
#[derive(Debug, Clone)]
pub struct Axis {
    name: String,
    unit: String,
    log: bool,
    count: bool,
    range: Option<(f64, f64)>,
}

impl Axis {
    /// An axis for `name` in `unit` (both in markup; no unit when empty), fitted to the data.
    pub fn new(name: &str, unit: &str) -> Self {
        Self { name: name.into(), unit: unit.into(), log: false, count: false, range: None }
    }

    /// Logarithmic: values that are not positive are not drawn.
    #[must_use]
    pub fn log(mut self) -> Self {
        self.log = true;
        self
    }

    /// For counts: ticks at whole numbers only.
    #[must_use]
    pub fn count(mut self) -> Self {
        self.count = true;
        self
    }

    /// Shows `lo` to `hi` whatever the data are; what lies outside is clipped. A range that is
    /// empty, not finite, or not positive on a logarithmic axis is ignored.
    #[must_use]
    pub fn range(mut self, lo: f64, hi: f64) -> Self {
        self.range = (lo < hi).then_some((lo, hi));
        self
    }

    /// The title with its unit, labels being divided by 10 to the power `exponent`.
    pub fn title(&self, exponent: i32) -> String {
        let power = match exponent {
            0 => String::new(),
            _ => format!("10^{{{}}} ", number::integer(exponent)),
        };
        let unit = format!("{power}{}", self.unit);
        match unit.trim() {
            "" => self.name.clone(),
            unit => format!("{} ({unit})", self.name),
        }
    }

    /// The scale over `pixels` that shows the set range or else all of `data`, with a `margin`
    /// (a fraction of the range) at both ends.
    pub(super) fn fit(
        &self,
        data: impl IntoIterator<Item = f64>,
        margin: f64,
        pixels: (f64, f64),
    ) -> Scale {
        let drawable = |v: &f64| v.abs() <= LARGEST && (!self.log || *v > 0.0);
        let coordinate = |v: f64| if self.log { v.log10() } else { v };
        let (lo, hi) = self
            .range
            .filter(|(lo, hi)| drawable(lo) && drawable(hi))
            .map(|(lo, hi)| (coordinate(lo), coordinate(hi)))
            .filter(|&(lo, hi)| resolvable(lo, hi))
            .unwrap_or_else(|| {
                let data = data.into_iter().filter(drawable).map(coordinate);
                widen(extent(data), self.log, margin)
            });
        Scale { lo, hi, log: self.log, count: self.count, pixels }
    }
}

/// Smallest and largest value, `None` without values.
fn extent(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.fold(None, |range, v| match range {
        None => Some((v, v)),
        Some((lo, hi)) => Some((v.min(lo), v.max(hi))),
    })
}

/// Whether a range is wide enough for doubles to tell positions in it apart.
fn resolvable(lo: f64, hi: f64) -> bool {
    hi - lo > 1e-9 * lo.abs().max(hi.abs()) && hi - lo > 1e-280
}

/// A range that can be drawn: whole decades on a logarithmic axis; elsewhere never empty, whether
/// the data are constant to round-off or missing.
fn widen(range: Option<(f64, f64)>, log: bool, margin: f64) -> (f64, f64) {
    let Some((lo, hi)) = range else { return (0.0, 1.0) };
    if log {
        let (lo, hi) = ((lo + 1e-9).floor(), (hi - 1e-9).ceil());
        let (lo, hi) = if lo < hi { (lo, hi) } else { (hi - 1.0, hi + 1.0) };
        let pad = margin * (hi - lo) / 2.0;
        return (lo - pad, hi + pad);
    }
    let size = lo.abs().max(hi.abs());
    let pad = if resolvable(lo, hi) {
        margin * (hi - lo)
    } else if size > 1e-280 {
        size / 2.0
    } else {
        1.0
    };
    (lo - pad, hi + pad)
}

/// The map from data to positions along an axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scale {
    lo: f64,
    hi: f64,
    log: bool,
    count: bool,
    pixels: (f64, f64),
}

impl Scale {
    /// Position of `value`; `None` for what cannot be drawn. Far outside the range positions
    /// stop growing, so that any finite value has one.
    pub(super) fn position(&self, value: f64) -> Option<f64> {
        let drawable = value.abs() <= LARGEST && (!self.log || value > 0.0);
        let coordinate = if self.log { value.log10() } else { value };
        let (from, to) = self.pixels;
        let fraction = ((coordinate - self.lo) / (self.hi - self.lo)).clamp(-100.0, 100.0);
        drawable.then_some(from + fraction * (to - from))
    }

    /// Value at the fraction `s` of a linear axis.
    pub(super) fn value(&self, s: f64) -> f64 {
        self.lo + s * (self.hi - self.lo)
    }

    /// Where a linear axis begins and ends.
    pub(super) fn range(&self) -> (f64, f64) {
        (self.lo, self.hi)
    }

    /// How much an axis shows.
    pub(super) fn length(&self) -> f64 {
        self.hi - self.lo
    }

    /// About one tick every `spacing` units.
    pub(super) fn ticks(&self, spacing: f64) -> Ticks {
        let length = (self.pixels.1 - self.pixels.0).abs();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small, ≥ 0")]
        let target = (length / if self.count { spacing / 2.0 } else { spacing }) as usize;
        if self.log {
            return ticks::decades(self.lo, self.hi, target);
        }
        ticks::linear(self.lo, self.hi, target, if self.count { 1.0 } else { 0.0 })
    }

    /// The same scale over other pixels.
    pub(super) fn over(self, pixels: (f64, f64)) -> Self {
        Self { pixels, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fitted(axis: &Axis, data: &[f64]) -> (f64, f64) {
        axis.fit(data.iter().copied(), 0.0, (0.0, 100.0)).range()
    }

    #[test]
    fn ranges_of_difficult_data() {
        let linear = Axis::new("", "");
        assert_eq!(fitted(&linear, &[1.0, f64::NAN, 3.0, f64::INFINITY]), (1.0, 3.0));
        assert_eq!(fitted(&linear, &[]), (0.0, 1.0));
        assert_eq!(fitted(&linear, &[0.0, 0.0]), (-1.0, 1.0));
        assert_eq!(fitted(&linear, &[4.0]), (2.0, 6.0));
        assert_eq!(fitted(&linear, &[f64::MAX, 2.0]), (1.0, 3.0));
        let log = Axis::new("", "").log();
        assert_eq!(fitted(&log, &[0.0, -1.0, 0.02, 30.0]), (-2.0, 2.0));
        assert_eq!(fitted(&log, &[10.0]), (0.0, 2.0));
    }

    #[test]
    fn a_set_range_wins_unless_it_cannot_be_drawn() {
        assert_eq!(fitted(&Axis::new("", "").range(-2.0, 2.0), &[5.0, 9.0]), (-2.0, 2.0));
        for (lo, hi) in [(2.0, f64::NAN), (0.0, 5e-324), (1.0, 1.0 + f64::EPSILON), (2.0, 1.0)] {
            assert_eq!(fitted(&Axis::new("", "").range(lo, hi), &[5.0, 9.0]), (5.0, 9.0));
        }
        assert_eq!(fitted(&Axis::new("", "").log().range(0.0, 9.0), &[1.0, 10.0]), (0.0, 1.0));
    }

    #[test]
    fn positions_run_over_the_pixels_and_stay_finite() {
        let scale = Axis::new("", "").fit([0.0, 10.0], 0.0, (300.0, 100.0));
        assert_eq!(scale.position(0.0), Some(300.0));
        assert_eq!(scale.position(7.5), Some(150.0));
        assert_eq!(scale.position(f64::NAN), None);
        assert!(scale.position(1e299).is_some_and(f64::is_finite));
    }
}
