/// Maxima that run side by side: one alone would wait for itself at every item.
const LANES: usize = 8;

/// Largest magnitude of the items' values; 0 if there are none, NaN if one is NaN.
pub(super) fn largest_magnitude<T>(items: &[T], value: impl Fn(&T) -> f64) -> f64 {
    let mut lanes = [0.0; LANES];
    let (chunks, rest) = items.as_chunks::<LANES>();
    for chunk in chunks {
        for (lane, item) in lanes.iter_mut().zip(chunk) {
            *lane = larger(*lane, value(item).abs());
        }
    }
    lanes.into_iter().chain(rest.iter().map(|item| value(item).abs())).fold(0.0, larger)
}

/// The larger of two, or NaN if one is: `f64::max` would lose it.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_largest_and_keeps_nan_wherever_it_is() {
        let values: Vec<f64> = (0..21).map(|k| -f64::from(k)).collect();
        for length in 0..=values.len() {
            let expected = length.saturating_sub(1) as f64;
            assert_eq!(largest_magnitude(&values[..length], |v| *v), expected);
        }
        for place in 0..values.len() {
            let mut damaged = values.clone();
            damaged[place] = f64::NAN;
            assert!(largest_magnitude(&damaged, |v| *v).is_nan(), "at {place}");
        }
    }
}
