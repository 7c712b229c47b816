use std::f64::consts::PI;

/// The Gauss-Legendre rule of `n` points on the interval from 0 to 1: pairs of point and weight.
///
/// Exact for polynomials of degree `2 n − 1`. The points are the zeros of the Legendre polynomial,
/// found by Newton's method from Tricomi's estimate; accurate to a few units in the last place.
///
/// # Panics
/// If `n` is zero.
///
/// ```
/// let rule = lumley_fem::quadrature::gauss_legendre(3);
/// let integral: f64 = rule.iter().map(|(x, w)| w * x.powi(5)).sum();
/// assert!((integral - 1.0 / 6.0).abs() < 1e-15);
/// ```
pub fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    assert!(n > 0, "a quadrature rule needs a point");
    (0..n).map(|i| zero_and_weight(n, i)).collect()
}

/// Zero number `i` of the Legendre polynomial of degree `n`, moved to (0, 1), and its weight.
fn zero_and_weight(n: usize, i: usize) -> (f64, f64) {
    let mut x = -(PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
    let mut slope = 1.0;
    // Newton doubles the digits: from a good estimate five steps are more than enough.
    for _ in 0..5 {
        let value;
        (value, slope) = legendre(n, x);
        x -= value / slope;
    }
    (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope))
}

/// Value and slope at `x` of the Legendre polynomial of degree `n`, by its three-term recurrence.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (0.0, 1.0);
    for k in 0..n {
        let k = k as f64;
        (before, value) = (value, ((2.0 * k + 1.0) * x * value - k * before) / (k + 1.0));
    }
    (value, n as f64 * (before - x * value) / (1.0 - x * x))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_to_degree_2n_minus_1_and_no_further() {
        for n in 1_usize..=8 {
            let rule = gauss_legendre(n);
            for degree in 0..=2 * n {
                let power = i32::try_from(degree).expect("small");
                let sum: f64 = rule.iter().map(|(x, w)| w * x.powi(power)).sum();
                let error = (sum - 1.0 / (degree as f64 + 1.0)).abs();
                if degree < 2 * n {
                    assert!(error < 1e-15, "n = {n}, x^{degree}: {error:e}");
                } else {
                    assert!(error > 1e-12, "n = {n}, x^{degree}: {error:e}");
                }
            }
        }
    }

    #[test]
    fn points_increase_and_mirror() {
        let rule = gauss_legendre(7);
        assert!(rule.windows(2).all(|w| w[0].0 < w[1].0));
        for (a, b) in rule.iter().zip(rule.iter().rev()) {
            assert!((a.0 + b.0 - 1.0).abs() < 1e-15 && (a.1 - b.1).abs() < 1e-15);
        }
    }
}
