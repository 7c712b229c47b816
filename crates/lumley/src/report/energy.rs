//! What eigenvalues say: energies, cumulative energies and projection errors, (31).

/// The share of the energy by which the paper picks the number of modes.
pub(super) const TARGET: f64 = 0.9999;

/// What the first modes up to one hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Share {
    /// λ of the last of them.
    pub eigenvalue: f64,
    /// Its share of the energy, in %.
    pub percent: f64,
    /// E, the share of all of them, in %.
    pub cumulative_percent: f64,
    /// √(1 − E), the relative RMS error of the projection on them, in %.
    pub rms_percent: f64,
}

/// The shares of modes with these eigenvalues, largest first, in an energy of `total`.
///
/// What is left out is summed from the smallest on: 1 − E has no digits left when E is near 1.
pub(super) fn shares(eigenvalues: &[f64], total: f64) -> Vec<Share> {
    let mut rest = (total - eigenvalues.iter().sum::<f64>()).max(0.0);
    if rest < 1e-14 * total {
        rest = 0.0;
    }
    let share = |&eigenvalue: &f64| {
        let share = Share {
            eigenvalue,
            percent: 100.0 * eigenvalue / total,
            cumulative_percent: 100.0 * (1.0 - rest / total),
            rms_percent: 100.0 * (rest.max(0.0) / total).sqrt(),
        };
        rest += eigenvalue;
        share
    };
    let mut shares: Vec<Share> = eigenvalues.iter().rev().map(share).collect();
    shares.reverse();
    shares
}

/// The smallest number of modes that hold the share [`TARGET`] of the energy.
pub(super) fn modes_for_target(shares: &[Share]) -> Option<usize> {
    shares.iter().position(|s| s.cumulative_percent >= 100.0 * TARGET).map(|i| i + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_of_known_eigenvalues() {
        let all = shares(&[75.0, 24.0, 1.0], 100.0);
        let second =
            Share { eigenvalue: 24.0, percent: 24.0, cumulative_percent: 99.0, rms_percent: 10.0 };
        assert_eq!(all[1], second);
        assert_eq!(all[2].rms_percent, 0.0);
        let kept = shares(&[75.0, 24.0], 100.0);
        assert_eq!(kept, all[..2]);
    }

    #[test]
    fn small_errors_keep_their_digits() {
        let all = shares(&[1.0, 1e-20, 1e-24], 1.0 + 1e-20);
        assert!((all[0].rms_percent / 1e-8 - 1.0).abs() < 1e-3, "{:e}", all[0].rms_percent);
        assert!((all[1].rms_percent / 1e-10 - 1.0).abs() < 1e-9, "{:e}", all[1].rms_percent);
    }

    #[test]
    fn modes_that_hold_the_target() {
        assert_eq!(modes_for_target(&shares(&[99.0, 0.98, 0.015, 0.005], 100.0)), Some(3));
        assert_eq!(modes_for_target(&shares(&[99.0], 100.0)), None);
        assert_eq!(modes_for_target(&shares(&[0.0], 0.0)), None);
        assert_eq!(modes_for_target(&[]), None);
    }
}
