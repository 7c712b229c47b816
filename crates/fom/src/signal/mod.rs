//! Statistics of signals that become periodic, such as the loads on a body in a stream.
//!
//! Frequency and extremes are those of the last full periods: what was before belongs to the start.
//!
//! ```
//! use lumley_fom::signal::{Periods, Signal};
//! use std::f64::consts::TAU;
//! let times: Vec<f64> = (0..4000).map(|k| 0.005 * k as f64).collect();
//! let lift: Vec<f64> = times.iter().map(|t| 0.1 + (TAU * 0.8 * t).sin()).collect();
//! let drag: Vec<f64> = times.iter().map(|t| 3.0 + 0.02 * (TAU * 1.6 * t).cos()).collect();
//! let (lift, drag) = (Signal::new(&times, &lift)?, Signal::new(&times, &drag)?);
//! let periods = Periods::of(&lift);
//! assert!((periods.frequency().expect("periodic") - 0.8).abs() < 1e-6);
//! let window = periods.window().unwrap_or(lift.last_half());
//! assert!((lift.statistics(window).rms - 0.5_f64.sqrt()).abs() < 1e-5);
//! assert!((drag.statistics(window).max - 3.02).abs() < 1e-5);
//! # Ok::<(), lumley_fom::signal::SignalError>(())
//! ```

mod error;
mod line;
mod periods;
mod spectrum;
mod statistics;

pub use error::SignalError;
pub use periods::Periods;
pub use spectrum::Spectrum;
pub use statistics::Statistics;

use serde::Serialize;

/// Values at instants, and straight lines between them; steps of any lengths.
///
/// ```
/// use lumley_fom::signal::Signal;
/// let signal = Signal::new(&[0.0, 1.0, 4.0], &[0.0, 2.0, 2.0])?;
/// assert_eq!((signal.last_half().start, signal.at(0.5)), (2.0, 1.0));
/// # Ok::<(), lumley_fom::signal::SignalError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Signal<'a> {
    times: &'a [f64],
    values: &'a [f64],
}

/// A part of a signal.
///
/// ```
/// use lumley_fom::signal::Window;
/// let window = Window { start: 2.0, end: 5.0 };
/// assert_eq!(window.duration(), 3.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Window {
    /// Its beginning, in s.
    pub start: f64,
    /// Its end, in s.
    pub end: f64,
}

impl Window {
    /// How long it is, in s.
    pub fn duration(&self) -> f64 {
        self.end - self.start
    }
}

impl<'a> Signal<'a> {
    /// A signal of these `times`, in s, and as many values.
    ///
    /// # Errors
    /// Every variant of [`SignalError`].
    pub fn new(times: &'a [f64], values: &'a [f64]) -> Result<Self, SignalError> {
        if times.is_empty() || times.len() != values.len() {
            return Err(SignalError::Count { times: times.len(), values: values.len() });
        }
        for (index, (&time, &value)) in times.iter().zip(values).enumerate() {
            if !(time.is_finite() && value.is_finite()) {
                return Err(SignalError::NotFinite { index, time, value });
            }
            if index > 0 && time <= times[index - 1] {
                return Err(SignalError::Order { index, time, previous: times[index - 1] });
            }
        }
        Ok(Self { times, values })
    }

    /// All of it.
    pub fn whole(&self) -> Window {
        Window { start: self.times[0], end: self.times[self.times.len() - 1] }
    }

    /// The later half, by time.
    pub fn last_half(&self) -> Window {
        let Window { start, end } = self.whole();
        Window { start: 0.5 * (start + end), end }
    }

    /// The value at a time, in s; before the first and after the last instant that of these.
    pub fn at(&self, time: f64) -> f64 {
        let next = self.times.partition_point(|&t| t < time);
        if next == 0 || next == self.times.len() {
            return self.values[next.saturating_sub(1)];
        }
        let (t, value) = (self.times[next - 1], self.values[next - 1]);
        value + (self.values[next] - value) * (time - t) / (self.times[next] - t)
    }

    /// Times and values of a window, its ends among them.
    fn samples(&self, window: Window) -> impl Iterator<Item = (f64, f64)> + Clone + use<'a> {
        let Window { start, end } = window;
        let first = self.times.partition_point(|&t| t <= start);
        let inside = first..self.times.partition_point(|&t| t < end).max(first);
        let (times, values) = (&self.times[inside.clone()], &self.values[inside]);
        let ends = [start, end].map(|time| (time, self.at(time)));
        let between = times.iter().copied().zip(values.iter().copied());
        std::iter::once(ends[0]).chain(between).chain(std::iter::once(ends[1]))
    }

    /// Mean in time of `f(time, value)` over a window, by the trapezoidal rule.
    fn mean(&self, window: Window, f: impl Fn(f64, f64) -> f64) -> f64 {
        let mut samples = self.samples(window).map(|(t, value)| (t, f(t, value)));
        let (mut t, first) = samples.next().expect("the start of the window");
        // Relative to the first value, so that a constant has exactly its value for a mean.
        let (mut before, mut sum) = (0.0, 0.0);
        for (time, value) in samples {
            sum += 0.5 * (time - t) * (before + (value - first));
            (t, before) = (time, value - first);
        }
        if sum == 0.0 { first } else { first + sum / window.duration() }
    }
}
