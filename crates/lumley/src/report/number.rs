//! Numbers as a reader of tables and axes wants them: a real minus sign, powers of ten, no `NaN`.

/// What stands in a table for a number that does not exist.
pub(super) const NOTHING: &str = "–";

/// `value` with a fixed number of decimals.
pub(super) fn fixed(value: f64, decimals: usize) -> String {
    if !value.is_finite() {
        return NOTHING.into();
    }
    let text = format!("{value:.decimals$}");
    let is_zero = text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    match text.strip_prefix('-') {
        Some(digits) if is_zero => digits.into(),
        Some(digits) => format!("−{digits}"),
        None => text,
    }
}

/// `value` with `digits` significant digits, as m × 10^{e} outside 10⁻³ … 10⁵.
pub(super) fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return NOTHING.into();
    }
    if value == 0.0 {
        return "0".into();
    }
    let (_, exponent) = decompose(value, digits);
    if !(-3..5).contains(&exponent) {
        return scientific(value, digits);
    }
    let decimals = i32::try_from(digits).unwrap_or(i32::MAX) - 1 - exponent;
    fixed(value, usize::try_from(decimals).unwrap_or(0))
}

/// `value` with all its digits, as a user wrote it.
pub(super) fn exact(value: f64) -> String {
    if !value.is_finite() {
        return NOTHING.into();
    }
    if value == 0.0 || (1e-4..1e6).contains(&value.abs()) {
        return value.to_string().replace('-', "−");
    }
    let text = format!("{value:e}").replace('-', "−");
    let (mantissa, exponent) = text.split_once('e').expect("the format writes an exponent");
    format!("{mantissa} × 10^{{{exponent}}}")
}

/// `value` rounded to five significant digits, without zeros at its end.
pub(super) fn short(value: f64) -> String {
    exact(format!("{value:.4e}").parse().expect("a printed number can be read"))
}

/// `value` with `digits` significant digits as m × 10^{e}, whatever its size.
pub(super) fn scientific(value: f64, digits: usize) -> String {
    if !value.is_finite() || value == 0.0 {
        return fixed(value, 0);
    }
    let (mantissa, exponent) = decompose(value, digits);
    format!("{} × 10^{{{}}}", mantissa.replace('-', "−"), integer(exponent))
}

/// An integer with a real minus sign.
pub(super) fn integer(value: i32) -> String {
    value.to_string().replace('-', "−")
}

/// A count with a thin space between groups of three digits from five digits on: 40 000 but 4000.
pub(super) fn count(value: usize) -> String {
    let digits = value.to_string();
    if digits.len() < 5 {
        return digits;
    }
    let mut out = String::new();
    for (i, c) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push('\u{202f}');
        }
        out.push(c);
    }
    out
}

/// A duration given in seconds, in the unit that reads best.
pub(super) fn duration(seconds: f64) -> String {
    let (factor, unit) = match seconds {
        s if s < 1e-3 => (1e6, "µs"),
        s if s < 1.0 => (1e3, "ms"),
        s if s < 120.0 => (1.0, "s"),
        _ => (1.0 / 60.0, "min"),
    };
    format!("{}\u{a0}{unit}", significant(seconds * factor, 3))
}

/// Mantissa and exponent of `value` rounded to `digits` digits.
fn decompose(value: f64, digits: usize) -> (String, i32) {
    let text = format!("{value:.*e}", digits.saturating_sub(1));
    let (mantissa, exponent) = text.split_once('e').expect("the format writes an exponent");
    (mantissa.into(), exponent.parse().expect("the format writes an integer exponent"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn significant_digits_and_powers_of_ten() {
        assert_eq!(significant(18.255, 5), "18.255");
        assert_eq!(significant(8.393e-2, 4), "0.08393");
        assert_eq!(significant(7.804e-4, 4), "7.804 × 10^{−4}");
        assert_eq!(significant(-123_456.0, 3), "−1.23 × 10^{5}");
        assert_eq!(significant(9.9996, 4), "10.00");
        assert_eq!(significant(0.0, 3), "0");
        assert_eq!(scientific(0.006_185, 4), "6.185 × 10^{−3}");
        assert_eq!(
            [short(100.000_000_1), short(0.1 + 0.2), short(f64::NAN)],
            ["100", "0.3", NOTHING]
        );
        assert_eq!([exact(39.5), exact(-0.1), exact(2e-7)], ["39.5", "−0.1", "2 × 10^{−7}"]);
    }

    #[test]
    fn no_number_and_no_negative_zero() {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(fixed(value, 2), NOTHING);
            assert_eq!(significant(value, 3), NOTHING);
        }
        assert_eq!(fixed(-0.001, 2), "0.00");
        assert_eq!(fixed(-0.25, 2), "−0.25");
    }

    #[test]
    fn counts_and_durations() {
        assert_eq!(count(4000), "4000");
        assert_eq!(count(1_234_567), "1\u{202f}234\u{202f}567");
        assert_eq!(duration(1.93e-6), "1.93\u{a0}µs");
        assert_eq!(duration(0.25), "250\u{a0}ms");
        assert_eq!(duration(2.5), "2.50\u{a0}s");
        assert_eq!(duration(600.0), "10.0\u{a0}min");
    }
}
