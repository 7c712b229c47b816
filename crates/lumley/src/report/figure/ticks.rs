//! Ticks at round numbers.

use crate::report::number;

/// Positions and labels of the ticks of one axis.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Ticks {
    /// Positions, in the units of the data, ascending.
    pub values: Vec<f64>,
    /// What stands beside each tick, in markup.
    pub labels: Vec<String>,
    /// The labels are the values divided by 10 to this power.
    pub exponent: i32,
}

/// About `target` ticks, and three at least, at multiples of 1, 2 or 5 times a power of ten within
/// `lo < hi`.
///
/// `smallest` bounds the step from below (1 for counts, 0 otherwise).
pub(super) fn linear(lo: f64, hi: f64, target: usize, smallest: f64) -> Ticks {
    let mut steps =
        (target.max(2)..).map(|n| nice_step((hi - lo) / n as f64).max(smallest)).take(8);
    // Within eight tries the step is a third of the range, unless `smallest` forbids it.
    let step = steps.find(|&step| multiples(lo, hi, step).count() > 2).unwrap_or(smallest);
    let values: Vec<f64> = multiples(lo, hi, step).collect();

    let largest = values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let exponent = match magnitude(largest) {
        e if (-3..5).contains(&e) || largest == 0.0 => 0,
        e => e,
    };
    let decimals = usize::try_from(exponent - magnitude(step)).unwrap_or(0);
    // The scaling is split because 10^308 and beyond would overflow in one factor.
    let half = exponent / 2;
    let scaled = |v: f64| v / 10_f64.powi(half) / 10_f64.powi(exponent - half);
    let labels = values.iter().map(|&v| number::fixed(scaled(v), decimals)).collect();
    Ticks { values, labels, exponent }
}

/// Powers of ten with exponents from `lo` to `hi`, every one or every few so that about `target`
/// remain.
pub(super) fn decades(lo: f64, hi: f64, target: usize) -> Ticks {
    #[expect(clippy::cast_possible_truncation, reason = "exponents of doubles fit")]
    let (first, last) = ((lo - 1e-6).ceil() as i32, (hi + 1e-6).floor() as i32);
    let stride = (last - first).max(0).unsigned_abs() as usize / target.max(1) + 1;
    let exponents: Vec<i32> = (first..=last).step_by(stride).collect();
    Ticks {
        values: exponents.iter().map(|&e| 10_f64.powi(e)).collect(),
        labels: exponents.iter().map(|&e| power_of_ten(e)).collect(),
        exponent: 0,
    }
}

/// 10^e in markup, written out from 0.01 to 100.
fn power_of_ten(exponent: i32) -> String {
    match exponent {
        -2..=-1 => number::fixed(10_f64.powi(exponent), exponent.unsigned_abs() as usize),
        0..=2 => number::fixed(10_f64.powi(exponent), 0),
        _ => format!("10^{{{}}}", number::integer(exponent)),
    }
}

/// The multiples of `step` within `lo` and `hi`; the slack keeps one that round-off would push just
/// outside.
fn multiples(lo: f64, hi: f64, step: f64) -> impl Iterator<Item = f64> {
    let (first, last) = ((lo / step - 1e-6).ceil(), (hi / step + 1e-6).floor());
    let count = (last - first).max(-1.0) + 1.0;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small, ≥ 0")]
    let count = count as usize;
    (0..count).map(move |k| (first + k as f64) * step)
}

/// The smallest of 1, 2, 5, 10 × 10^k that is no less than `raw`.
fn nice_step(raw: f64) -> f64 {
    let unit = 10_f64.powi(magnitude(raw));
    let factor = [1.0, 2.0, 5.0].into_iter().find(|f| raw <= f * unit * (1.0 + 1e-9));
    factor.unwrap_or(10.0) * unit
}

/// ⌊log₁₀ value⌋, right at the powers of ten; 0 for 0.
fn magnitude(value: f64) -> i32 {
    if value <= 0.0 {
        return 0;
    }
    #[expect(clippy::cast_possible_truncation, reason = "exponents of doubles fit")]
    let exponent = (value.log10() + 1e-9).floor() as i32;
    exponent
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_one_two_or_five() {
        let steps = [(0.9, 1.0), (1.1, 2.0), (2.0, 2.0), (3.0, 5.0), (6.0, 10.0), (0.003, 0.005)];
        for (raw, nice) in steps {
            assert!((nice_step(raw) / nice - 1.0).abs() < 1e-12, "{raw}: {}", nice_step(raw));
        }
    }

    #[test]
    fn labels_of_a_linear_axis() {
        let t = linear(0.88, 1.02, 5, 0.0);
        assert_eq!(t.labels, ["0.90", "0.95", "1.00"]);
        let t = linear(-0.31, 0.42, 5, 0.0);
        assert_eq!(t.labels, ["−0.2", "0.0", "0.2", "0.4"]);
        let t = linear(1.0, 10.0, 20, 1.0);
        assert_eq!(t.labels, ["1", "2", "3", "4", "5", "6", "7", "8", "9", "10"]);
    }

    #[test]
    fn small_and_large_numbers_share_an_exponent() {
        let t = linear(0.0, 4e-5, 4, 0.0);
        assert_eq!((t.exponent, t.labels.join(" ")), (-5, "0 1 2 3 4".into()));
        let t = linear(0.0, 2.5e6, 5, 0.0);
        assert_eq!((t.exponent, t.labels.join(" ")), (6, "0.0 0.5 1.0 1.5 2.0 2.5".into()));
    }

    #[test]
    fn ticks_lie_inside_and_are_few_at_every_scale() {
        for e in -250..250 {
            for (lo, hi) in [(0.0, 1.0), (-0.7, 1.3), (0.13, 0.29), (-9.0, -2.0)] {
                let (lo, hi) = (lo * 10_f64.powi(e), hi * 10_f64.powi(e));
                let t = linear(lo, hi, 6, 0.0);
                let slack = 1e-5 * (hi - lo);
                assert!((3..=8).contains(&t.values.len()), "{lo:e} {hi:e} {:?}", t.values);
                assert!(t.values.iter().all(|&v| lo - slack <= v && v <= hi + slack));
                assert!(
                    t.labels
                        .iter()
                        .all(|l| l.len() < 8 && l.parse::<f64>().is_ok() || l.starts_with('−'))
                );
            }
        }
    }

    #[test]
    fn decades_thin_out() {
        assert_eq!(decades(-1.3, 2.3, 8).labels, ["0.1", "1", "10", "100"]);
        let t = decades(-16.0, 0.0, 6);
        assert_eq!(t.values.len(), 6);
        assert_eq!(t.labels[0], "10^{−16}");
    }
}
