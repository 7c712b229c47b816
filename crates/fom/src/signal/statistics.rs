use super::{Signal, Window};
use serde::Serialize;

/// Extremes and means over a window.
///
/// ```
/// use lumley_fom::signal::Signal;
/// let signal = Signal::new(&[0.0, 1.0, 2.0], &[1.0, 3.0, 1.0])?;
/// let statistics = signal.statistics(signal.whole());
/// assert_eq!((statistics.mean, statistics.amplitude()), (2.0, 1.0));
/// # Ok::<(), lumley_fom::signal::SignalError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Statistics {
    /// The largest value.
    pub max: f64,
    /// The smallest value.
    pub min: f64,
    /// The mean in time.
    pub mean: f64,
    /// The root of the mean square of the fluctuation about the mean.
    pub rms: f64,
}

impl Statistics {
    /// Half of the distance from the smallest to the largest value.
    pub fn amplitude(&self) -> f64 {
        0.5 * (self.max - self.min)
    }
}

impl Signal<'_> {
    /// Statistics over a window; of a window without duration, those of the value there.
    ///
    /// Means are by the trapezoidal rule, which is accurate to a high order over full periods of equal steps.
    pub fn statistics(&self, window: Window) -> Statistics {
        let values = self.samples(window).map(|(_, value)| value);
        let mean = self.mean(window, |_, value| value);
        Statistics {
            max: values.clone().fold(f64::NEG_INFINITY, f64::max),
            min: values.fold(f64::INFINITY, f64::min),
            mean,
            rms: self.mean(window, |_, value| (value - mean).powi(2)).sqrt(),
        }
    }
}
