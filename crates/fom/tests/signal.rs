//! Statistics of periodic signals with known answers.

use lumley_fom::signal::{Periods, Signal, SignalError};
use std::f64::consts::TAU;

/// Numbers in (−1, 1) that look random.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

fn uniform(step: f64, count: usize) -> Vec<f64> {
    (0..count).map(|k| step * k as f64).collect()
}

/// Steps that differ by a factor of up to three from one to the next.
fn unequal(step: f64, count: usize) -> Vec<f64> {
    let (mut noise, mut time) = (Noise(7), 0.0);
    let next = |_| {
        time += step * (1.0 + 0.5 * noise.next());
        time
    };
    (0..count).map(next).collect()
}

fn values(times: &[f64], f: impl FnMut(&f64) -> f64) -> Vec<f64> {
    times.iter().map(f).collect()
}

fn frequency(times: &[f64], values: &[f64]) -> Option<f64> {
    Periods::of(&Signal::new(times, values).expect("a signal")).frequency()
}

fn assert_close(found: f64, expected: f64, relative: f64) {
    let error = (found / expected - 1.0).abs();
    assert!(error < relative, "{found} for {expected}: {error:e}");
}

#[test]
fn sine_with_drift_and_noise() {
    let mut noise = Noise(1);
    let times = uniform(0.01, 6000);
    let wave = values(&times, |t| 2.0 + (TAU * 0.3 * t).sin() + 0.01 * t + 0.02 * noise.next());
    assert_close(frequency(&times, &wave).expect("periodic"), 0.3, 1e-4);
}

/// Loads that start from an impulse and grow into their oscillation, sampled at unequal steps.
#[test]
fn unequal_steps_and_a_start() {
    for per_period in [20, 60, 200] {
        let times = unequal(1.0 / 0.17 / per_period as f64, 40 * per_period);
        let growth = |t: f64| 1.0 / (1.0 + (-(t - 60.0) / 10.0).exp());
        let wave =
            values(&times, |t| 50.0 * (-20.0 * t).exp() + growth(*t) * (TAU * 0.17 * t).cos());
        assert_close(frequency(&times, &wave).expect("periodic"), 0.17, 1e-4);
    }
}

/// Only the last ten of the periods count: this wave was slower before.
#[test]
fn the_last_ten_periods_count() {
    let times = uniform(0.01, 10_000);
    let wave =
        values(&times, |&t| (TAU * if t < 60.0 { 0.5 * t } else { 30.0 + 0.8 * (t - 60.0) }).sin());
    let signal = Signal::new(&times, &wave).expect("a signal");
    let periods = Periods::of(&signal);
    assert_eq!((periods.count(), periods.instants().len()), (10, 11));
    assert_close(periods.frequency().expect("periodic"), 0.8, 1e-5);
    assert!(periods.amplitude_change(&signal).expect("ten") < 1e-3);
}

/// Statistics over full periods do not know where the record begins and ends.
#[test]
fn statistics_of_full_periods() {
    for (phase, per_period, count) in
        [(0.0, 40.0, 504), (1.0, 41.3, 520), (2.0, 97.7, 1231), (4.5, 300.1, 3781)]
    {
        let times = uniform(1.0 / per_period, count);
        let wave = values(&times, |t| 3.0 - 0.5 * (TAU * t + phase).sin());
        let signal = Signal::new(&times, &wave).expect("a signal");
        let window = Periods::of(&signal).window().expect("periods");
        let found = signal.statistics(window);
        assert_close(window.duration(), 10.0, 1e-5);
        assert_close(found.mean, 3.0, 1e-5);
        assert_close(found.rms, 0.5 * 0.5_f64.sqrt(), 1e-3);
        assert_close(found.amplitude(), 0.5, 5.0 / (per_period * per_period));
        assert_close(found.max, 3.5, 1e-3);
    }
}

/// The larger sets the period; both have their peaks in the spectrum.
#[test]
fn two_frequencies() {
    let times = unequal(0.02, 10_000);
    let wave = values(&times, |t| (TAU * 0.5 * t).sin() + 0.3 * (TAU * 1.35 * t + 0.4).sin());
    let signal = Signal::new(&times, &wave).expect("a signal");
    let periods = Periods::of(&signal);
    assert_eq!(periods.count(), 10);
    // Where periods begin depends on the other wave: by 0.3/(2π) of one at each end, at most.
    assert_close(periods.frequency().expect("periodic"), 0.5, 0.6 / TAU / 10.0);
    let spectrum = signal.spectrum(signal.whole());
    for (frequency, amplitude) in [(0.5, 1.0), (1.35, 0.3)] {
        let near = spectrum.frequencies.iter().zip(&spectrum.amplitudes);
        let near = near.filter(|(f, _)| (*f - frequency).abs() < 0.2);
        let (peak, height) = near.max_by(|a, b| a.1.total_cmp(b.1)).expect("frequencies there");
        let step = spectrum.frequencies[1];
        assert!((peak - frequency).abs() < step, "{peak}");
        assert_close(*height, amplitude, 0.04);
    }
    let far = spectrum.frequencies.iter().zip(&spectrum.amplitudes).filter(|(f, _)| **f > 1.6);
    assert!(far.map(|(_, a)| *a).fold(0.0, f64::max) < 0.01);
}

/// With the period a multiple of the window's, the peak is the amplitude.
#[test]
fn amplitudes_of_a_spectrum() {
    let times = uniform(0.05, 401);
    let wave = values(&times, |t| -7.0 + 2.0 * (TAU * 0.4 * t + 1.0).sin());
    let signal = Signal::new(&times, &wave).expect("a signal");
    let spectrum = signal.spectrum(signal.whole());
    assert_eq!(spectrum.frequencies.len(), 401);
    assert!((spectrum.frequencies[400] - 10.0).abs() < 1e-12, "the Nyquist frequency");
    assert_close(spectrum.amplitudes[16], 2.0, 1e-6);
    assert!(spectrum.amplitudes[0] < 1e-6, "the mean is left out");
    // The window's side lobes: sin(πx)/(πx(1 − x²)) of the peak at a distance of x/T.
    assert!(spectrum.amplitudes[20..].iter().all(|a| *a < 0.05));
    assert!(spectrum.amplitudes[25..].iter().all(|a| *a < 0.01));
}

#[test]
fn a_constant_has_no_period() {
    let times = unequal(0.1, 500);
    let still = vec![0.1 + 0.2; 500];
    let signal = Signal::new(&times, &still).expect("a signal");
    let periods = Periods::of(&signal);
    assert_eq!((periods.count(), periods.frequency(), periods.window()), (0, None, None));
    let found = signal.statistics(signal.last_half());
    assert_eq!([found.max, found.min, found.mean], [0.1 + 0.2; 3]);
    assert_eq!((found.rms, found.amplitude(), periods.amplitude_change(&signal)), (0.0, 0.0, None));
    assert!(signal.spectrum(signal.whole()).amplitudes.iter().all(|a| *a == 0.0));
    let mut noise = Noise(3);
    let round_off = values(&times, |_| 5.6 * (1.0 + 1e-15 * noise.next()));
    assert_eq!(frequency(&times, &round_off), None);
}

#[test]
fn noise_alone_has_no_period() {
    for seed in 0..20 {
        let (mut noise, times) = (Noise(seed), uniform(0.1, 500));
        let noisy = values(&times, |_| noise.next());
        assert_eq!(frequency(&times, &noisy), None, "seed {seed}");
    }
}

#[test]
fn less_than_three_periods_have_no_frequency() {
    for (samples, count) in [(50, 0), (160, 1), (260, 2), (360, 3)] {
        let times = uniform(0.01, samples);
        let wave = values(&times, |t| -(TAU * t).cos());
        let signal = Signal::new(&times, &wave).expect("a signal");
        let periods = Periods::of(&signal);
        assert_eq!(periods.count(), count, "{samples}");
        assert_eq!(periods.frequency().is_some(), count == 3);
        assert_eq!(periods.amplitude_change(&signal).is_some(), count == 3);
    }
}

/// One instant, as a steady flow has it.
#[test]
fn a_single_instant_is_a_signal() {
    let signal = Signal::new(&[2.0], &[5.5]).expect("a signal");
    let found = signal.statistics(signal.last_half());
    assert_eq!([found.max, found.min, found.mean, found.rms], [5.5, 5.5, 5.5, 0.0]);
    assert_eq!(Periods::of(&signal).count(), 0);
    assert!(signal.spectrum(signal.whole()).frequencies.is_empty());
}

#[test]
fn an_oscillation_that_grows_shows_it() {
    let times = uniform(0.01, 2000);
    let wave = values(&times, |t| (0.05 * t).exp() * (TAU * t).sin());
    let signal = Signal::new(&times, &wave).expect("a signal");
    let periods = Periods::of(&signal);
    // From the middle of the first to that of the last of the periods.
    let span = (periods.count() - 1) as f64;
    let change = periods.amplitude_change(&signal).expect("periods");
    assert_close(change, 1.0 - (-0.05 * span).exp(), 1e-3);
    let amplitudes = periods.amplitudes(&signal);
    assert!(amplitudes.windows(2).all(|pair| pair[0] < pair[1]));
}

#[test]
fn wrong_signals_are_refused_with_the_entry() {
    let refused = |times: &[f64], values: &[f64]| Signal::new(times, values).expect_err("wrong");
    assert_eq!(refused(&[], &[]), SignalError::Count { times: 0, values: 0 });
    assert_eq!(refused(&[0.0], &[1.0, 2.0]), SignalError::Count { times: 1, values: 2 });
    let error = refused(&[0.0, 1.0, 1.0], &[0.0; 3]);
    assert_eq!(error, SignalError::Order { index: 2, time: 1.0, previous: 1.0 });
    let error = refused(&[0.0, 1.0], &[0.0, f64::NAN]);
    assert!(matches!(error, SignalError::NotFinite { index: 1, .. }), "{error}");
    assert!(matches!(refused(&[f64::INFINITY], &[0.0]), SignalError::NotFinite { index: 0, .. }));
}

/// A flow that begins with a peak, and sheds vortices later: the peak is not the beginning of a period.
#[test]
fn a_peak_at_the_start_is_no_period() -> Result<(), SignalError> {
    let times: Vec<f64> = (1..=450).map(|k| 0.01 * f64::from(k)).collect();
    let grows = |t: f64| 1.0 / (1.0 + (-4.0 * (t - 1.5)).exp());
    let value = |&t: &f64| {
        grows(t) * (TAU * 3.0 * t).sin() + 2.0 * (-t / 0.02).exp() - 2.0 * (-t / 0.01).exp()
    };
    let lift: Vec<f64> = times.iter().map(value).collect();
    let mut late = lift.clone();
    late[..5].copy_from_slice(&[-0.6, 0.9, 0.1, 0.1, 0.1]);
    for signal in [&lift, &late] {
        let periods = Periods::of(&Signal::new(&times, signal)?);
        let frequency = periods.frequency().expect("periodic");
        assert!((frequency - 3.0).abs() < 0.03, "{frequency} Hz");
    }
    Ok(())
}
