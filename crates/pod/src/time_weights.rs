//! Weights of snapshots in the time average `<u> = sum_j q_j u(t_j)`, `sum_j q_j = 1`.

/// Why weights do not make a time average.
///
/// ```
/// use lumley_pod::{TimeWeightsError, time_weights};
/// let error = time_weights::trapezoid(&[0.0, 0.2, 0.1]);
/// assert!(matches!(error, Err(TimeWeightsError::NotIncreasing { index: 2, .. })));
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TimeWeightsError {
    /// There is not one weight for each snapshot.
    #[error("{weights} time weights for {snapshots} snapshots: give one for each")]
    Length {
        /// Number of weights.
        weights: usize,
        /// Number of snapshots.
        snapshots: usize,
    },
    /// A weight is not positive and finite.
    #[error("time weight {index}, counted from 0, is {value}: it must be positive and finite")]
    Value {
        /// Index of the weight, from 0.
        index: usize,
        /// The weight.
        value: f64,
    },
    /// A weight is nothing beside the others.
    #[error(
        "time weight {index}, counted from 0, is {share:e} of the sum of all: \
         it must be at least 1e-30; leave such a snapshot out"
    )]
    Negligible {
        /// Index of the weight, from 0.
        index: usize,
        /// The weight divided by the sum of all.
        share: f64,
    },
    /// The trapezoid rule needs an interval.
    #[error("{times} times make no interval: the trapezoid rule needs at least 2")]
    TooFew {
        /// Number of times.
        times: usize,
    },
    /// Times go back, stand still or are not numbers.
    #[error(
        "time {index}, counted from 0, is {after} s after {before} s: times must increase; sort \
         the snapshots and remove repeated ones"
    )]
    NotIncreasing {
        /// Index of the time, from 0.
        index: usize,
        /// The time before it, in s.
        before: f64,
        /// The time itself, in s.
        after: f64,
    },
}

/// Weights of the trapezoid rule over unequal steps, with the sum 1:
/// `q_j = (t_(j+1) - t_(j-1)) / (2 (t_(M-1) - t_0))`, halves at the ends.
///
/// * `times`: at least two increasing times, in s
///
/// # Errors
/// [`TimeWeightsError::TooFew`], [`TimeWeightsError::NotIncreasing`].
///
/// ```
/// let q = lumley_pod::time_weights::trapezoid(&[0.0, 1.0, 4.0])?;
/// assert_eq!(q, [0.125, 0.5, 0.375]);
/// # Ok::<(), lumley_pod::TimeWeightsError>(())
/// ```
pub fn trapezoid(times: &[f64]) -> Result<Vec<f64>, TimeWeightsError> {
    let m = times.len();
    if m < 2 {
        return Err(TimeWeightsError::TooFew { times: m });
    }
    for (k, pair) in times.windows(2).enumerate() {
        let (before, after) = (pair[0], pair[1]);
        if !(after - before > 0.0 && (after - before).is_finite()) {
            return Err(TimeWeightsError::NotIncreasing { index: k + 1, before, after });
        }
    }
    let span = times[m - 1] - times[0];
    let weight = |j: usize| times[(j + 1).min(m - 1)] - times[j.saturating_sub(1)];
    Ok((0..m).map(|j| weight(j) / (2.0 * span)).collect())
}

/// Coefficients are divided by the root of a share, which must not vanish.
const LEAST_SHARE: f64 = 1e-30;

/// The weights of M snapshots, scaled to the sum 1: 1/M each where none are given.
pub(crate) fn normalised(
    given: Option<&[f64]>,
    snapshots: usize,
) -> Result<Vec<f64>, TimeWeightsError> {
    let Some(weights) = given else {
        return Ok(vec![1.0 / snapshots as f64; snapshots]);
    };
    if weights.len() != snapshots {
        return Err(TimeWeightsError::Length { weights: weights.len(), snapshots });
    }
    let bad = |&(_, &q): &(usize, &f64)| !(q > 0.0 && q.is_finite());
    if let Some((index, &value)) = weights.iter().enumerate().find(bad) {
        return Err(TimeWeightsError::Value { index, value });
    }
    // Divided by the largest first, the sum neither overflows nor vanishes.
    let largest = weights.iter().fold(0.0, |a: f64, &q| a.max(q));
    let sum: f64 = weights.iter().map(|q| q / largest).sum();
    let shares: Vec<f64> = weights.iter().map(|q| q / largest / sum).collect();
    match shares.iter().position(|share| *share < LEAST_SHARE) {
        Some(index) => Err(TimeWeightsError::Negligible { index, share: shares[index] }),
        None => Ok(shares),
    }
}
