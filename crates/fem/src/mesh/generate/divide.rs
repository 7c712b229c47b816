use super::GenerateError;

/// Steps of the integration in a cell.
const STEPS: usize = 8;

/// Divides [0, 1] into the fewest cells that are no larger than `size`, by equidistribution: each has the same integral of dt/size(t). Returns their ends.
///
/// # Errors
/// [`GenerateError::TooManyCells`] when there would be more than `limit`.
pub(super) fn divide(size: impl Fn(f64) -> f64, limit: usize) -> Result<Vec<f64>, GenerateError> {
    let (mut t, mut integral) = (0.0, 0.0);
    let mut table = vec![(0.0, 0.0)];
    while t < 1.0 {
        if integral > limit as f64 || table.len() > STEPS * limit.saturating_add(64) {
            return Err(GenerateError::TooManyCells { limit });
        }
        let step = (size(t) / STEPS as f64).min(1.0 / 64.0);
        let next = if t + 1.5 * step < 1.0 { t + step } else { 1.0 };
        integral += (next - t) / size(0.5 * (t + next));
        t = next;
        table.push((t, integral));
    }
    let cells = whole((integral - 1e-9).ceil().max(1.0));
    let mut row = 1;
    let inner = (1..cells).map(|k| {
        let wanted = integral * k as f64 / cells as f64;
        row += table[row..].iter().take_while(|entry| entry.1 < wanted).count();
        let ((t0, i0), (t1, i1)) = (table[row - 1], table[row]);
        t0 + (t1 - t0) * (wanted - i0) / (i1 - i0)
    });
    Ok(std::iter::once(0.0).chain(inner.collect::<Vec<_>>()).chain([1.0]).collect())
}

/// A number without a fraction that is small enough to be counted to.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "limited, at least 0")]
pub(super) fn whole(number: f64) -> usize {
    number as usize
}

#[cfg(test)]
mod tests {
    use super::{divide, whole};

    /// size = h₀ + g t makes cells in geometric progression: N = ln(1 + g/h₀)/g.
    #[test]
    fn linear_growth_is_a_geometric_progression() {
        let t = divide(|t| 0.01 + 0.2 * t, 1000).expect("few cells");
        let expected = (21.0_f64.ln() / 0.2).ceil();
        assert_eq!(t.len() - 1, whole(expected));
        let ratios = t.windows(3).map(|w| (w[2] - w[1]) / (w[1] - w[0]));
        let exact = (21.0_f64.ln() / expected).exp();
        for ratio in ratios {
            assert!((ratio - exact).abs() < 2e-3, "{ratio}, expected {exact}");
        }
    }

    #[test]
    fn equal_cells_and_their_limit() {
        let t = divide(|_| 0.26, 100).expect("four cells");
        for (k, t) in t.iter().enumerate() {
            assert!((t - 0.25 * k as f64).abs() < 1e-15);
        }
        assert!(divide(|_| 0.001, 100).is_err());
        assert!(divide(|t| 1e-300 + t, 100).is_err());
    }
}
