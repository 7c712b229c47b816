use super::{Stepper, System, offset};
use crate::Divergence;

/// The classical explicit Runge-Kutta method of order 4 with a constant step.
///
/// Stable for `λ dt` in its stability region, which reaches to −2.785 on the real axis. The last
/// evaluation of a step is the first of the next: four a step.
pub(crate) struct Rk4 {
    stage: Vec<f64>,
    slope: Vec<f64>,
    sum: Vec<f64>,
}

impl Rk4 {
    pub fn new(size: usize) -> Self {
        let [stage, slope, sum] = [(); 3].map(|()| vec![0.0; size]);
        Self { stage, slope, sum }
    }
}

impl Stepper for Rk4 {
    fn step(
        &mut self,
        system: &mut dyn System,
        y: &mut [f64],
        rates: &mut [f64],
        dt: f64,
    ) -> Result<(), Divergence> {
        self.sum.copy_from_slice(rates);
        self.slope.copy_from_slice(rates);
        for (reach, weight) in [(0.5, 2.0), (0.5, 2.0), (1.0, 1.0)] {
            offset(y, reach * dt, &self.slope, &mut self.stage);
            system.rates(&self.stage, &mut self.slope);
            for (sum, k) in self.sum.iter_mut().zip(&self.slope) {
                *sum += weight * k;
            }
        }
        for (y, sum) in y.iter_mut().zip(&self.sum) {
            *y += dt / 6.0 * sum;
        }
        system.rates(y, rates);
        Ok(())
    }

    fn is_explicit(&self) -> bool {
        true
    }
}
