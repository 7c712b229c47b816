use super::System;
use crate::basis::norm;

/// Where the stability region of RK4 ends on the negative real axis: `1 + z + z²/2 + z³/6 + z⁴/24 = 1`.
const REAL_BOUND: f64 = 2.785_293_563_405_282;
/// Power iterations; the growth is averaged over the second half.
const ITERATIONS: u32 = 200;

/// Longest step in s for which RK4 is stable on `y' = f(y)` linearised at `y`: 2.785 over the spectral
/// radius of the Jacobian.
///
/// The radius comes from the power method on differences of `f`, accurate to a few per cent, from below. It
/// is right for systems whose fastest part decays, as viscosity and interface forces do; the region
/// reaches about as far (2.83) along the imaginary axis. The differences are small against `size`, over which
/// the rates must be smooth: the position of the body, say.
pub(crate) fn stable_step(system: &mut dyn System, y: &[f64], size: f64) -> f64 {
    let n = y.len();
    let [mut base, mut ahead, mut state] = [(); 3].map(|()| vec![0.0; n]);
    system.rates(y, &mut base);
    let mut direction: Vec<f64> = (0..n).map(|i| 1.0 + (i as f64).sin()).collect();
    let scale = 1e-7 * size;
    let mut growth = 0.0;
    for iteration in 0..ITERATIONS {
        let length = norm(&direction);
        if !length.is_normal() {
            return f64::INFINITY;
        }
        super::offset(y, scale / length, &direction, &mut state);
        system.rates(&state, &mut ahead);
        for ((d, a), b) in direction.iter_mut().zip(&ahead).zip(&base) {
            *d = (a - b) / scale;
        }
        if iteration >= ITERATIONS / 2 {
            growth += norm(&direction).ln();
        }
    }
    REAL_BOUND / (growth / f64::from(ITERATIONS - ITERATIONS / 2)).exp()
}
