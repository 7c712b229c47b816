use super::FlowError;

/// A step is not foreseen if it differs by more than this share of the largest velocity from the extrapolation.
const UNFORESEEN: f64 = 0.5;
/// So many of them one after another are no impulsive start.
const MOST_STEPS: usize = 10;
/// So much may the velocity grow in them: flows that are resolved badly in time, but go on, do not grow.
const LARGEST_GROWTH: f64 = 100.0;

/// Watches for a linearised scheme that has become unstable: it would go on to any size with finite numbers.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Stability {
    /// Steps one after another that were not foreseen.
    steps: usize,
    /// Largest velocity after the first of them, in m/s.
    first: f64,
}

impl Stability {
    /// Takes the step that ends at `time`, in s, with its extrapolation error and its largest velocity, in m/s.
    pub(super) fn watch(&mut self, time: f64, error: f64, largest: f64) -> Result<(), FlowError> {
        if error < UNFORESEEN {
            *self = Self::default();
            return Ok(());
        }
        if self.steps == 0 {
            self.first = largest;
        }
        self.steps += 1;
        let (steps, growth) = (self.steps, largest / self.first.max(f64::MIN_POSITIVE));
        if steps >= MOST_STEPS && growth > LARGEST_GROWTH {
            return Err(FlowError::Unstable { time, steps, growth });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Watches a velocity that is extrapolated linearly; says at which step it was refused.
    fn refused(velocity: impl Fn(i32) -> f64) -> Option<i32> {
        let mut stability = Stability::default();
        (1..200).find(|&n| {
            let [new, now, before] = [n, n - 1, n - 2].map(|n| velocity(n.max(0)));
            let error = (new - 2.0 * now + before).abs() / new.abs().max(f64::MIN_POSITIVE);
            stability.watch(f64::from(n), error, new.abs()).is_err()
        })
    }

    #[test]
    fn growth_that_no_step_foresees_is_refused() {
        assert_eq!(refused(|n| (-3.0_f64).powi(n)), Some(10));
        assert_eq!(refused(|n| 1e-9 * (-1.5_f64).powi(n)), Some(13));
    }

    #[test]
    fn flows_that_go_on_are_not() {
        assert_eq!(refused(|n| 1.02_f64.powi(n)), None, "the growth of an instability");
        assert_eq!(refused(|n| (-0.02 / f64::from(n)).exp()), None, "an impulsive start");
        assert_eq!(refused(|n| (-20.0 / f64::from(n)).exp()), None, "a start from nothing");
        assert_eq!(refused(|n| (2.1 * f64::from(n)).sin()), None, "three steps a period");
    }
}
