use crate::ensemble::subtract_from_columns;
use crate::product::{product, transposed_product};
use crate::{InnerProduct, Note};
use faer::{Mat, MatRef};

/// POD modes with their energies and temporal coefficients, paper eqs. (5)-(8).
///
/// ```text
/// u(x, t_j) = <u>(x) + sum_n a_n(t_j) Phi_n(x),   (Phi_i, Phi_k) = delta_ik,   <a_i a_k> = delta_ik lambda_i
/// ```
///
/// The mean `<u>` stands there only where it was subtracted. Of each mode, the first entry whose
/// magnitude is within 1e-6 of the largest is positive.
///
/// ```
/// use lumley_pod::{Identity, MemorySnapshots, Options, Truncation, svd};
/// let x = faer::mat![[3.0, 0.0], [0.0, -4.0], [0.0, 0.0]];
/// let snapshots = MemorySnapshots::new(x.clone(), vec![0.0, 1.0]);
/// let options = Options { truncation: Truncation::Modes(2), ..Options::default() };
/// let basis = svd(&snapshots, &Identity::new(3), &options)?;
/// assert!((basis.singular_values[0] - 4.0).abs() < 1e-14);
/// assert!((basis.energy_percent()[0] - 64.0).abs() < 1e-12);
/// assert!((basis.reconstruct(basis.coefficients.as_ref()) - x).norm_max() < 1e-14);
/// # Ok::<(), lumley_pod::PodError>(())
/// ```
#[derive(Debug, Clone)]
pub struct ReducedBasis {
    /// Name of the algorithm that found it.
    pub algorithm: &'static str,
    /// The modes `Phi`, n x r, orthonormal in the inner product.
    pub modes: Mat<f64>,
    /// The r eigenvalues `lambda_n`, largest first: the mean energy `<a_n²>` of each mode.
    pub eigenvalues: Vec<f64>,
    /// `sigma_n = sqrt(M lambda_n)`: with time weights 1/M, the singular values of `W^(1/2) X`.
    pub singular_values: Vec<f64>,
    /// The temporal coefficients `a_n(t_j) = (u_j - <u>, Phi_n)`, r x M, paper eq. (7).
    pub coefficients: Mat<f64>,
    /// The time mean that was subtracted, if one was.
    pub mean: Option<Vec<f64>>,
    /// Every eigenvalue that was computed, largest first; those at or under
    /// [`noise_floor`](Self::noise_floor) are noise.
    pub spectrum: Vec<f64>,
    /// Mean energy `<(u, u)>` of the snapshots (less their mean, where subtracted): the sum of the
    /// spectrum.
    pub total_energy: f64,
    /// Eigenvalue that the algorithm cannot tell from zero.
    pub noise_floor: f64,
    /// Number of eigenvalues above the noise floor: the rank of the snapshots as far as this
    /// algorithm can see.
    pub rank: usize,
    /// Times `t_j` of the M snapshots, in s.
    pub times: Vec<f64>,
    /// Weights `q_j` of the time average, with the sum 1.
    pub time_weights: Vec<f64>,
    /// What to know besides the numbers.
    pub notes: Vec<Note>,
}

impl ReducedBasis {
    /// Number r of modes.
    pub fn size(&self) -> usize {
        self.eigenvalues.len()
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
        let mut errors: Vec<f64> = self.spectrum.iter().rev().scan(0.0, add).collect();
        errors.reverse();
        errors.truncate(self.size());
        errors
    }

    /// Coefficients `(u - <u>, Phi_n)` of any fields, one for each column of `u`, paper eq. (7).
    ///
    /// * `u`: n x k
    /// * `product`: the inner product in which the modes are orthonormal
    ///
    /// Returns r x k.
    ///
    /// # Panics
    /// If the fields or the inner product do not have the length of a mode.
    pub fn project(&self, u: MatRef<'_, f64>, product: &dyn InnerProduct) -> Mat<f64> {
        let n = self.modes.nrows();
        assert_eq!((u.nrows(), product.dim()), (n, n), "fields and modes have one length");
        let mut fluctuation = u.to_owned();
        if let Some(mean) = &self.mean {
            subtract_from_columns(mean, fluctuation.as_mut());
        }
        product.apply(0, fluctuation.as_mut());
        transposed_product(self.modes.as_ref(), fluctuation.as_ref())
    }

    /// The fields `<u> + sum_n a_n Phi_n`, paper eq. (5), of the first modes.
    ///
    /// * `a`: N x k, N at most r
    ///
    /// Returns n x k.
    ///
    /// # Panics
    /// If there are more coefficients than modes.
    pub fn reconstruct(&self, a: MatRef<'_, f64>) -> Mat<f64> {
        assert!(a.nrows() <= self.size(), "{} coefficients of {} modes", a.nrows(), self.size());
        let mut u = product(self.modes.subcols(0, a.nrows()), a);
        for column in u.col_iter_mut() {
            for (u, mean) in column.iter_mut().zip(self.mean.iter().flatten()) {
                *u += mean;
            }
        }
        u
    }
}
