use crate::correlation::mirror;
use crate::inner_product::support;
use crate::kernel::add_gram;
use crate::mean::Mean;
use crate::partial::Partial;
use crate::partition::Partition;
use crate::run::Run;
use crate::{Decomposition, ModeSource, PodError};
use faer::{Mat, MatMut};
use std::io;
use std::ops::Range;

/// What is known of previous snapshots, as columns beside those of new ones.
///
/// With `M1` and `M2` for the weights of both sets in the time average, times M, the snapshots less their
/// common mean have the correlation of the columns
///
/// ```text
/// [ Phi_n sqrt(M1 lambda_n) ...   sqrt(M1 M2/M) (<u>_1 - <u>_2)   s_j (u_j - <u>_2) ... ]
/// ```
///
/// and of what the old modes left out (Levey and Lindenbaum, 2000; with the mean Ross et al., 2008).
pub(crate) struct Previous<'a> {
    modes: &'a dyn ModeSource,
    /// `M1` and `M2`.
    pub counts: [f64; 2],
    /// `sqrt(M1 lambda_n)`.
    pub sigma: Vec<f64>,
    centred: bool,
    /// What the old modes left of all old snapshots.
    pub left_out: f64,
}

impl<'a> Previous<'a> {
    pub fn new(
        decomposition: &Decomposition,
        modes: &'a dyn ModeSource,
        counts: [f64; 2],
        centred: bool,
    ) -> Self {
        let sigma = decomposition.eigenvalues.iter().map(|l| (counts[0] * l).sqrt()).collect();
        let left_out = counts[0] * decomposition.energy_left();
        Self { modes, counts, sigma, centred, left_out }
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.sigma.len() + usize::from(self.centred)
    }

    /// `sqrt(M1 M2/M)`.
    pub fn of_means(&self) -> f64 {
        let [old, new] = self.counts;
        (old / (old + new) * new).sqrt()
    }

    /// Reads rows of the columns.
    ///
    /// * `mean`: that of the new snapshots, where it was subtracted
    ///
    /// Returns that of all in its place.
    pub fn read(
        &self,
        rows: Range<usize>,
        mean: Option<Mean>,
        mut out: MatMut<'_, f64>,
    ) -> io::Result<Option<Vec<f64>>> {
        let size = self.sigma.len();
        self.modes.block(rows.clone(), out.as_mut().subcols_mut(0, size))?;
        for (column, sigma) in out.as_mut().col_iter_mut().zip(&self.sigma) {
            column.iter_mut().for_each(|x| *x *= sigma);
        }
        let (Some(mean), Some(old)) = (mean, self.modes.mean_of(rows)?) else { return Ok(None) };
        let (factor, [before, now]) = (self.of_means(), self.counts);
        let gap = out.col_mut(size).iter_mut().zip(mean.difference(&old));
        gap.for_each(|(to, gap)| *to = factor * gap);
        Ok(Some(mean.mixed(&old, before / (before + now))))
    }

    /// The old modes are orthonormal in the inner product.
    pub fn check(&self, run: &Run<'_>) -> Result<(), PodError> {
        const ROUND_OFF: f64 = 1e-8;
        let (product, size) = (run.ensemble.product, self.sigma.len());
        let block = run.ensemble.partition.block();
        let part = |rows: Range<usize>| {
            let mut sum = Partial::zeros(size * size, 0);
            for rows in Partition::pieces(rows, block) {
                let support = support(product, &rows);
                let mut modes = Mat::zeros(support.len(), size);
                self.modes.block(support, modes.as_mut())?;
                product.factor(rows.clone(), modes.as_mut())?;
                add_gram(sum.matrix_mut(size, size), modes.subrows(0, rows.len()));
            }
            Ok(sum)
        };
        let sum = run.over_modes("check of the old modes", size, &part)?;
        let mut gram = sum.matrix(size, size).to_owned();
        mirror(&mut gram);
        // The largest of them would pass over what is no number.
        let defect = if gram.is_all_finite() {
            (gram - Mat::<f64>::identity(size, size)).norm_max()
        } else {
            f64::NAN
        };
        if defect <= ROUND_OFF { Ok(()) } else { Err(PodError::OldModes { defect }) }
    }
}
