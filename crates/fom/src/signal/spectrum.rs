use super::{Signal, Window};
use std::f64::consts::TAU;

/// Frequencies of a spectrum, at most.
const MOST: usize = 1000;

/// Amplitude over frequency.
///
/// ```
/// use lumley_fom::signal::Signal;
/// use std::f64::consts::TAU;
/// let times: Vec<f64> = (0..=1000).map(|k| 0.01 * k as f64).collect();
/// let values: Vec<f64> = times.iter().map(|t| 5.0 + 0.3 * (TAU * 2.0 * t).cos()).collect();
/// let signal = Signal::new(&times, &values)?;
/// let spectrum = signal.spectrum(signal.whole());
/// // Every twentieth of a hertz.
/// assert!((spectrum.frequencies[40] - 2.0).abs() < 1e-12 && (spectrum.amplitudes[40] - 0.3).abs() < 1e-9);
/// # Ok::<(), lumley_fom::signal::SignalError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    /// Frequencies, in Hz, from 0 in equal steps.
    pub frequencies: Vec<f64>,
    /// Amplitude of the fluctuation at each of them, in the unit of the signal.
    pub amplitudes: Vec<f64>,
}

impl Signal<'_> {
    /// The single-sided amplitude spectrum of the fluctuation about the mean, with a Hann window:
    ///
    /// ```text
    /// A(f) = 2 |∫ h(t) (v − v̄) exp(−2πi f t) dt| / ∫ h(t) dt
    /// ```
    ///
    /// by the trapezoidal rule, so that a sine has its own amplitude for its peak. With the duration T of the window,
    /// frequencies are multiples of 1/(2 T) up to half of the mean rate of the samples, 1000 of them at most; a peak is
    /// ±2/T wide. Of a window without duration the spectrum is empty.
    pub fn spectrum(&self, window: Window) -> Spectrum {
        let samples: Vec<(f64, f64)> = self.samples(window).collect();
        let count = if window.duration() > 0.0 { samples.len().min(MOST) } else { 0 };
        let step = 0.5 / window.duration();
        let mean = self.mean(window, |_, value| value);
        let (mut sums, mut total) = (vec![[0.0; 2]; count], 0.0);
        for (k, &(time, value)) in samples.iter().enumerate() {
            let next = samples[(k + 1).min(samples.len() - 1)].0;
            let weight = 0.5 * (next - samples[k.saturating_sub(1)].0);
            let turns = (time - window.start) / window.duration();
            let hann = 0.5 * (1.0 - (TAU * turns).cos());
            total += weight * hann;
            add_harmonics(&mut sums, weight * hann * (value - mean), 0.5 * TAU * turns);
        }
        Spectrum {
            frequencies: (0..count).map(|k| step * k as f64).collect(),
            amplitudes: sums.iter().map(|[re, im]| 2.0 * re.hypot(*im) / total).collect(),
        }
    }
}

/// `sums[k] ← sums[k] + value exp(i k angle)`, each by turning the one before.
fn add_harmonics(sums: &mut [[f64; 2]], value: f64, angle: f64) {
    let (sin, cos) = angle.sin_cos();
    let [mut re, mut im] = [value, 0.0];
    for sum in sums {
        sum[0] += re;
        sum[1] += im;
        [re, im] = [re * cos - im * sin, re * sin + im * cos];
    }
}
