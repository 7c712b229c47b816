use crate::Note;
use faer::Mat;

/// A decomposition but for its modes, paper eqs. (5)-(8): what is small whatever the size of the grid.
///
/// ```
/// use lumley_pod::{Execution, Identity, MemoryModes, MemorySnapshots, Options, ALGORITHMS};
/// let x = MemorySnapshots::new(faer::mat![[3.0, 0.0], [0.0, 4.0]], vec![0.0, 1.0]);
/// let modes = MemoryModes::default();
/// let options = Options { residuals: true, ..Options::default() };
/// let found = (ALGORITHMS[0].stream)(&x, &Identity::new(2), &options, Execution::default(), &modes)?;
/// assert!((found.total_energy - 12.5).abs() < 1e-14 && found.residuals[1] < 1e-14);
/// # Ok::<(), lumley_pod::PodError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Decomposition {
    /// Name of the algorithm that found it.
    pub algorithm: &'static str,
    /// The r eigenvalues `lambda_n`, largest first: the mean energy `<a_n²>` of each mode.
    pub eigenvalues: Vec<f64>,
    /// `sigma_n = sqrt(M lambda_n)`: with time weights 1/M, the singular values of `W^(1/2) X`.
    pub singular_values: Vec<f64>,
    /// The temporal coefficients `a_n(t_j) = (u_j - <u>, Phi_n)`, r x M, paper eq. (7).
    pub coefficients: Mat<f64>,
    /// `Res(N) = max_t |u - u_N| / max_t |u|`, N = 1..r, a fraction, paper eq. (32), measured on the
    /// modes; empty unless the [`Options`](crate::Options) ask for it.
    pub residuals: Vec<f64>,
    /// Every eigenvalue that was computed, largest first; those at or under
    /// [`noise_floor`](Self::noise_floor) are noise.
    pub spectrum: Vec<f64>,
    /// Mean energy `<(u, u)>` of the snapshots (less their mean, where subtracted): the sum of the
    /// spectrum, and of what an approximation left out.
    pub total_energy: f64,
    /// Energy that an approximation left out, up to round-off: every eigenvalue lies at most this far
    /// above the one found in its place, or above zero where none was, and none lies below. Nothing
    /// for the exact algorithms. See [`APPROXIMATIONS`](crate::APPROXIMATIONS).
    pub error_bound: Option<f64>,
    /// Eigenvalue that the algorithm cannot tell from zero.
    pub noise_floor: f64,
    /// Number of eigenvalues above the noise floor: the rank of the snapshots as far as this
    /// algorithm can see.
    pub rank: usize,
    /// Times `t_j` of the M snapshots, in s.
    pub times: Vec<f64>,
    /// Weights `q_j` of the time average, with the sum 1.
    pub time_weights: Vec<f64>,
    /// Passes over the snapshots that it took.
    pub passes: usize,
    /// What to know besides the numbers.
    pub notes: Vec<Note>,
}

impl Decomposition {
    /// Number r of modes.
    pub fn size(&self) -> usize {
        self.eigenvalues.len()
    }

    /// Mean energy that the modes leave of the snapshots, the discarded eigenvalues added up.
    pub fn energy_left(&self) -> f64 {
        self.spectrum[self.size()..].iter().sum::<f64>() + self.error_bound.unwrap_or(0.0)
    }

    /// Share of the energy in each mode, in %.
    pub fn energy_percent(&self) -> Vec<f64> {
        self.eigenvalues.iter().map(|l| 100.0 * l / self.total_energy).collect()
    }

    /// Share `E_N` of the energy in the first N modes, N = 1..r, in %, paper eq. (31).
    pub fn cumulative_percent(&self) -> Vec<f64> {
        let add = |sum: &mut f64, l: &f64| {
            *sum += l;
            Some(100.0 * *sum / self.total_energy)
        };
        self.eigenvalues.iter().scan(0.0, add).collect()
    }

    /// RMS error `sqrt(1 - E_N)` of the projection on the first N modes, N = 1..r, relative to the
    /// RMS of the snapshots; a fraction. The discarded eigenvalues are added up: nothing cancels.
    pub fn rms_projection_error(&self) -> Vec<f64> {
        let add = |tail: &mut f64, l: &f64| {
            let error = (*tail / self.total_energy).sqrt();
            *tail += l;
            Some(error)
        };
        let unseen = self.error_bound.unwrap_or(0.0);
        let mut errors: Vec<f64> = self.spectrum.iter().rev().scan(unseen, add).collect();
        errors.reverse();
        errors.truncate(self.size());
        errors
    }
}
