use super::lu::Lu;
use super::{Stepper, System};
use crate::{Divergence, ReducedError};
use serde::{Deserialize, Serialize};

/// The adaptive Rosenbrock method RODAS of order 4(3), L-stable (Hairer and Wanner, Solving Ordinary
/// Differential Equations II, section IV.7).
///
/// Each accepted step keeps the estimated error of component `y` under `tolerance (1 + |y|)`, in SI units,
/// in the mean over the components. The Jacobian is taken by differences; stiffness does not bound
/// the step.
///
/// ```
/// use lumley_rom::Rosenbrock;
/// assert_eq!(Rosenbrock::default().tolerance, 1e-8);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Rosenbrock {
    /// Error tolerance of a step, absolute and relative, between 1e-12 and 0.1.
    pub tolerance: f64,
}

impl Default for Rosenbrock {
    fn default() -> Self {
        Self { tolerance: 1e-8 }
    }
}

impl Rosenbrock {
    pub(crate) fn validate(self) -> Result<(), ReducedError> {
        if (1e-12..=0.1).contains(&self.tolerance) {
            return Ok(());
        }
        let (name, expected) = ("integrator.tolerance", "between 1e-12 and 0.1");
        Err(ReducedError::Parameter { name, value: self.tolerance, unit: "", expected })
    }
}

/// Stages of RODAS.
const STAGES: usize = 6;
/// Diagonal coefficient γ.
const GAMMA: f64 = 0.25;
/// Row i: weights of the earlier stages in the state at which stage i is evaluated.
const STATE: [[f64; 5]; STAGES] = [
    [0.0; 5],
    [1.544, 0.0, 0.0, 0.0, 0.0],
    [0.946_678_528_081_582_6, 0.255_701_169_898_328_4, 0.0, 0.0, 0.0],
    [3.314_825_187_068_521, 2.896_124_015_972_201, 0.998_641_913_997_781_7, 0.0, 0.0],
    [
        1.221_224_509_226_641,
        6.019_134_481_288_629,
        12.537_083_329_320_87,
        -0.687_886_036_105_895,
        0.0,
    ],
    [
        1.221_224_509_226_641,
        6.019_134_481_288_629,
        12.537_083_329_320_87,
        -0.687_886_036_105_895,
        1.0,
    ],
];
/// Row i: weights, over dt, of the earlier stages on the right-hand side of stage i.
const RIGHT: [[f64; 5]; STAGES] = [
    [0.0; 5],
    [-5.6688, 0.0, 0.0, 0.0, 0.0],
    [-2.430_093_356_833_875, -0.206_359_915_709_191_5, 0.0, 0.0, 0.0],
    [-0.107_352_905_815_137_5, -9.594_562_251_023_355, -20.470_286_148_096_16, 0.0, 0.0],
    [
        7.496_443_313_967_647,
        -10.246_804_314_643_52,
        -33.999_903_528_199_05,
        11.708_908_932_061_6,
        0.0,
    ],
    [
        8.083_246_795_921_522,
        -7.981_132_988_064_893,
        -31.521_594_328_743_71,
        16.319_305_431_231_36,
        -6.058_818_238_834_054,
    ],
];
/// Smallest substep, as a part of the step asked for.
const SMALLEST: f64 = 1e-12;
/// Most substeps, rejected ones included, in the step asked for.
const MOST: usize = 1_000_000;

/// The work space of [`Rosenbrock`].
pub(super) struct Rodas4 {
    tolerance: f64,
    suggestion: f64,
    /// Jacobian, row by row.
    jacobian: Vec<f64>,
    lu: Lu,
    stages: [Vec<f64>; STAGES],
    state: Vec<f64>,
    slope: Vec<f64>,
}

impl Rodas4 {
    pub fn new(size: usize, tolerance: f64) -> Self {
        Self {
            tolerance,
            suggestion: 0.0,
            jacobian: vec![0.0; size * size],
            lu: Lu::new(size),
            stages: [(); STAGES].map(|()| vec![0.0; size]),
            state: vec![0.0; size],
            slope: vec![0.0; size],
        }
    }

    /// Jacobian at `y` by forward differences.
    fn linearise(&mut self, system: &mut dyn System, y: &[f64], rates: &[f64]) {
        let n = y.len();
        self.state.copy_from_slice(y);
        for (j, value) in y.iter().enumerate() {
            let shift = f64::EPSILON.sqrt() * value.abs().max(1e-3);
            self.state[j] = value + shift;
            system.rates(&self.state, &mut self.slope);
            let column = self.jacobian[j..].iter_mut().step_by(n);
            for ((entry, ahead), here) in column.zip(&self.slope).zip(rates) {
                *entry = (ahead - here) / shift;
            }
            self.state[j] = *value;
        }
    }

    /// One step of length `h` from `y`: leaves the new state in `state` and returns its error over the
    /// tolerance; an error that is not finite is a step that failed.
    fn attempt(&mut self, system: &mut dyn System, y: &[f64], rates: &[f64], h: f64) -> f64 {
        let n = y.len();
        for (entry, derivative) in self.lu.matrix().iter_mut().zip(&self.jacobian) {
            *entry = -derivative;
        }
        for entry in self.lu.matrix().iter_mut().step_by(n + 1) {
            *entry += 1.0 / (GAMMA * h);
        }
        self.lu.factor();
        self.slope.copy_from_slice(rates);
        for i in 0..STAGES {
            let (done, rest) = self.stages.split_at_mut(i);
            if i > 0 {
                self.state.copy_from_slice(y);
                combine(&STATE[i], 1.0, done, &mut self.state);
                system.rates(&self.state, &mut self.slope);
            }
            combine(&RIGHT[i], 1.0 / h, done, &mut self.slope);
            self.lu.solve(&mut self.slope);
            rest[0].copy_from_slice(&self.slope);
        }
        // The last stage is the difference to the embedded method of order 3.
        let last = &self.stages[STAGES - 1];
        let mut sum = 0.0;
        for ((state, error), y) in self.state.iter_mut().zip(last).zip(y) {
            *state += error;
            let scaled = error / (self.tolerance * (1.0 + y.abs().max(state.abs())));
            sum += scaled * scaled;
        }
        (sum / n as f64).sqrt()
    }
}

impl Stepper for Rodas4 {
    fn step(
        &mut self,
        system: &mut dyn System,
        y: &mut [f64],
        rates: &mut [f64],
        dt: f64,
    ) -> Result<(), Divergence> {
        let mut left = dt;
        let mut wanted = if self.suggestion > 0.0 { self.suggestion } else { 1e-3 * dt };
        self.linearise(system, y, rates);
        for _ in 0..MOST {
            let h = left / (left / wanted).ceil().max(1.0);
            let error = self.attempt(system, y, rates, h);
            wanted =
                h * if error.is_finite() { (0.9 / error.powf(0.25)).clamp(0.2, 5.0) } else { 0.1 };
            if error <= 1.0 {
                y.copy_from_slice(&self.state);
                system.rates(y, rates);
                left = if h < left { left - h } else { 0.0 };
                self.suggestion = wanted;
                if left == 0.0 {
                    return Ok(());
                }
                self.linearise(system, y, rates);
            } else if wanted < SMALLEST * dt {
                return Err(Divergence::StepUnderflow { tried: h });
            }
        }
        Err(Divergence::Substeps { count: MOST, left })
    }

    fn suggestion(&self) -> f64 {
        self.suggestion
    }

    fn resume(&mut self, suggestion: f64) {
        self.suggestion = suggestion;
    }

    fn is_explicit(&self) -> bool {
        false
    }
}

/// `out += scale * sum_j weights_j stages_j`.
fn combine(weights: &[f64], scale: f64, stages: &[Vec<f64>], out: &mut [f64]) {
    for (weight, stage) in weights.iter().zip(stages) {
        for (o, k) in out.iter_mut().zip(stage) {
            *o += scale * weight * k;
        }
    }
}
