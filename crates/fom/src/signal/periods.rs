use super::line::Line;
use super::{Signal, Window};

/// Full periods that statistics are taken over, at most.
const MOST: usize = 10;
/// Full periods without which there is no frequency.
const FEWEST: usize = 3;
/// A period begins where the signal rises from under to over its mean, by this part of its rms.
const HYSTERESIS: f64 = 0.5;
/// Fluctuations under this part of the largest value are round-off.
const ROUND_OFF: f64 = 1e-12;
/// Largest ratio of the standard deviation of the periods to their mean; white noise has about 0.6.
const LARGEST_SCATTER: f64 = 0.25;
/// How often level and periods are found from each other; they no longer change after two or three times.
const PASSES: usize = 4;

/// The last full periods of a signal, ten or as many as there are.
///
/// A period begins at an upward crossing of the mean; where the means of the periods drift, of the line through them.
/// A crossing leads from half an rms under the mean to half an rms over it, which noise does not, and its instant is
/// where the line of least squares through all samples between is zero. A signal whose periods scatter by more than
/// a quarter is not periodic and has none.
///
/// ```
/// use lumley_fom::signal::{Periods, Signal};
/// let times: Vec<f64> = (0..100).map(f64::from).collect();
/// let wave: Vec<f64> = times.iter().map(|t| (0.5 * t).sin()).collect();
/// let periods = Periods::of(&Signal::new(&times, &wave)?);
/// assert_eq!(periods.count(), 6, "the first crossing is at 4π");
/// assert!((periods.frequency().expect("six") - 0.25 / std::f64::consts::PI).abs() < 1e-5);
/// # Ok::<(), lumley_fom::signal::SignalError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Periods {
    instants: Vec<f64>,
}

impl Periods {
    /// The periods of a signal.
    pub fn of(signal: &Signal<'_>) -> Self {
        let half = signal.last_half();
        let (mut window, mut instants) = (half, Vec::new());
        let mean = signal.mean(half, |_, value| value);
        let mut level = Line { centre: half.start, value: mean, slope: 0.0 };
        for _ in 0..PASSES {
            let rms = signal.mean(window, |t, value| (value - level.at(t)).powi(2)).sqrt();
            if rms <= ROUND_OFF * largest(signal) {
                instants.clear();
                break;
            }
            instants = upward_crossings(signal, level, HYSTERESIS * rms);
            instants.drain(..instants.len().saturating_sub(MOST + 1));
            // What a start left behind, early in the signal, is no period.
            while scatter(&instants) > LARGEST_SCATTER && instants[0] < half.start {
                instants.remove(0);
            }
            let &[start, .., end] = &instants[..] else { break };
            window = Window { start, end };
            level = Line::through(&windows(&instants).map(|period| {
                (0.5 * (period.start + period.end), signal.mean(period, |_, value| value))
            }));
        }
        if scatter(&instants) > LARGEST_SCATTER {
            instants.clear();
        }
        Self { instants }
    }

    /// How many there are, at most ten.
    pub fn count(&self) -> usize {
        self.instants.len().saturating_sub(1)
    }

    /// Where each begins, and where the last ends, in s.
    pub fn instants(&self) -> &[f64] {
        &self.instants
    }

    /// From the beginning of the first to the end of the last; `None` if there is none.
    pub fn window(&self) -> Option<Window> {
        let (&start, &end) = (self.instants.first()?, self.instants.last()?);
        (self.count() > 0).then_some(Window { start, end })
    }

    /// Periods a second, in Hz; `None` if there are less than three.
    pub fn frequency(&self) -> Option<f64> {
        let window = self.window().filter(|_| self.count() >= FEWEST)?;
        Some(self.count() as f64 / window.duration())
    }

    /// The amplitude of `signal` in each period.
    pub fn amplitudes(&self, signal: &Signal<'_>) -> Vec<f64> {
        windows(&self.instants).map(|period| signal.statistics(period).amplitude()).collect()
    }

    /// How far the amplitude of `signal` in a period is from that in the last one, at most, relative to this:
    /// near zero when the oscillation is established. `None` if there are less than three periods.
    pub fn amplitude_change(&self, signal: &Signal<'_>) -> Option<f64> {
        let amplitudes = self.amplitudes(signal);
        let last = *amplitudes.last().filter(|last| amplitudes.len() >= FEWEST && **last > 0.0)?;
        Some(amplitudes.iter().map(|a| (a - last).abs() / last).fold(0.0, f64::max))
    }
}

fn windows(instants: &[f64]) -> impl Iterator<Item = Window> + Clone {
    instants.windows(2).map(|pair| Window { start: pair[0], end: pair[1] })
}

fn largest(signal: &Signal<'_>) -> f64 {
    signal.values.iter().fold(0.0, |largest, value| value.abs().max(largest))
}

/// Where the signal rises from under `level − band` to over `level + band`.
fn upward_crossings(signal: &Signal<'_>, level: Line, band: f64) -> Vec<f64> {
    let above = |k: usize| signal.values[k] - level.at(signal.times[k]);
    let (mut instants, mut last_under) = (Vec::new(), None);
    for k in 0..signal.times.len() {
        if above(k) < -band {
            last_under = Some(k);
        } else if above(k) > band
            && let Some(first) = last_under.take()
        {
            let line = Line::through(&(first..=k).map(|j| (signal.times[j], above(j))));
            let (start, end) = (signal.times[first], signal.times[k]);
            // A signal that lingers in the band may have a line that falls there.
            let instant = line.upward_root().unwrap_or(0.5 * (start + end));
            instants.push(instant.clamp(start, end));
        }
    }
    instants
}

/// Standard deviation of the lengths of the periods over their mean.
fn scatter(instants: &[f64]) -> f64 {
    let lengths = || windows(instants).map(|period| period.duration());
    let count = lengths().count().max(1) as f64;
    let mean = lengths().sum::<f64>() / count;
    let square = lengths().map(|length| (length - mean).powi(2)).sum::<f64>() / count;
    if mean > 0.0 { square.sqrt() / mean } else { 0.0 }
}
