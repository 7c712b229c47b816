use crate::dense::product;
use crate::mean::subtract_from_columns;
use crate::{Decomposition, InnerProduct};
use faer::{Mat, MatRef};
use std::io;
use std::ops::Deref;

/// POD modes in memory with their energies and temporal coefficients, paper eqs. (5)-(8).
///
/// ```text
/// u(x, t_j) = <u>(x) + sum_n a_n(t_j) Phi_n(x),   (Phi_i, Phi_k) = delta_ik,   <a_i a_k> = delta_ik lambda_i
/// ```
///
/// The mean `<u>` stands there only where it was subtracted. Of each mode, the first entry whose
/// magnitude is within 1e-6 of the largest is positive. All that does not grow with the grid is the
/// [`Decomposition`], whose fields and methods are at hand here too.
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
    /// The modes `Phi`, n x r, orthonormal in the inner product.
    pub modes: Mat<f64>,
    /// The time mean that was subtracted, if one was.
    pub mean: Option<Vec<f64>>,
    /// Energies, coefficients and what to know of them.
    pub decomposition: Decomposition,
}

impl Deref for ReducedBasis {
    type Target = Decomposition;

    fn deref(&self) -> &Decomposition {
        &self.decomposition
    }
}

impl ReducedBasis {
    /// Coefficients `(u - <u>, Phi_n)` of any fields, one for each column of `u`, paper eq. (7).
    ///
    /// * `u`: n x k
    /// * `product`: the inner product in which the modes are orthonormal
    ///
    /// Returns r x k.
    ///
    /// # Errors
    /// The failure of the medium that holds the weights.
    ///
    /// # Panics
    /// If the fields or the inner product do not have the length of a mode.
    pub fn project(&self, u: MatRef<'_, f64>, w: &dyn InnerProduct) -> io::Result<Mat<f64>> {
        let n = self.modes.nrows();
        assert_eq!((u.nrows(), w.dim()), (n, n), "fields and modes have one length");
        let mut fluctuation = u.to_owned();
        if let Some(mean) = &self.mean {
            subtract_from_columns(mean, fluctuation.as_mut());
        }
        w.apply(fluctuation.as_mut())?;
        Ok(product(self.modes.transpose(), fluctuation.as_ref()))
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
