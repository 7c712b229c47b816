use crate::mean::Mean;
use crate::product::{Columns, block};
use crate::reduction::Blocks;
use crate::spectrum::Spectrum;
use crate::{InnerProduct, Options, PodError, SnapshotSource, Truncation, time_weights};
use faer::{ColRef, Mat, MatMut};
use std::ops::Range;

/// The snapshots as the algorithms see them: checked, centred, weighted in time.
///
/// As [`Columns`] it is the matrix of `s_j (u_j - <u>)` with `s_j = sqrt(M q_j)`, so that the time
/// average needs no weights: `<(u, v)> = (1/M) sum_j`.
pub(crate) struct Ensemble<'a> {
    source: &'a dyn SnapshotSource,
    pub product: &'a dyn InnerProduct,
    pub options: &'a Options,
    pub time_weights: Vec<f64>,
    /// `s_j`, all one without time weights.
    pub scale: Vec<f64>,
    pub mean: Option<Mean>,
    /// `sum_i W_ii <x_i²>` of the fluctuation where W couples rows: the energy that errors of the
    /// size of the entries have. Zero where it is the energy of the snapshots itself.
    amplified: f64,
}

impl<'a> Ensemble<'a> {
    pub fn new(
        source: &'a dyn SnapshotSource,
        product: &'a dyn InnerProduct,
        options: &'a Options,
    ) -> Result<Self, PodError> {
        let m = source.times().len();
        check_dimensions(source, product)?;
        check_truncation(options.truncation)?;
        let time_weights = time_weights::normalised(options.time_weights.as_deref(), m)?;
        let scale = match &options.time_weights {
            Some(_) => time_weights.iter().map(|q| (m as f64 * q).sqrt()).collect(),
            None => vec![1.0; m],
        };
        let (mean, amplified) = (None, 0.0);
        let mut ensemble = Self { source, product, options, time_weights, scale, mean, amplified };
        if options.center {
            ensemble.mean = Some(ensemble.time_mean()?);
        }
        if product.couples_rows() {
            ensemble.amplified = ensemble.amplified_energy()?;
        }
        Ok(ensemble)
    }

    /// Times of the snapshots, in s.
    pub fn times(&self) -> &[f64] {
        self.source.times()
    }

    /// Refuses what would exceed the memory limit.
    pub fn check_memory(
        &self,
        what: &'static str,
        bytes: u128,
        remedy: &'static str,
    ) -> Result<(), PodError> {
        let limit = self.options.memory_limit;
        if bytes > u128::from(limit) {
            return Err(PodError::Memory { what, bytes, limit, remedy });
        }
        Ok(())
    }

    /// The spectrum of these eigenvalues, with the floor under which they are noise.
    ///
    /// Entries are known to `eps` of themselves, before the mean is subtracted: that noise has at
    /// most the energy `eps² sum_i W_ii <x_i²>`, and the reflections of M columns make
    /// `M eps² lambda_1` of a zero, both with a factor of 16 for what adds up.
    ///
    /// * `squaring`: the energy that goes missing where the algorithm squares, if it does
    pub fn spectrum(&self, values: Vec<f64>, squaring: Option<f64>) -> Result<Spectrum, PodError> {
        let (snapshots, centred) = (self.scale.len(), self.mean.is_some());
        let first = values.first().map_or(0.0, |l| snapshots as f64 * l);
        let steady = self.mean.as_ref().map_or(0.0, |mean| mean.amplified_energy(self.product));
        let round_off = (4.0 * f64::EPSILON).powi(2) * first.max(self.amplified + steady);
        Spectrum::new(values, round_off, squaring).ok_or(PodError::NoEnergy { snapshots, centred })
    }

    /// Energy that goes missing where products `uᵀ (W u)` are formed: `M eps lambda_1`, or
    /// `8 eps sum_i W_ii <x_i²>` where W takes differences of large entries.
    pub fn squaring(&self, lambda: &[f64]) -> f64 {
        let first = lambda.first().map_or(0.0, |l| self.scale.len() as f64 * l);
        f64::EPSILON * first.max(8.0 * self.amplified)
    }

    fn time_mean(&self) -> Result<Mean, PodError> {
        let (n, m) = self.shape();
        let part = |rows: Range<usize>| {
            let mut x = Mat::zeros(rows.len(), m);
            read_checked(self.source, rows, 0..m, x.as_mut())?;
            Ok(Mean::new(x.as_ref(), &self.time_weights))
        };
        Blocks::for_products(n, m).reduce(self.options.par, &part, &Mean::above)
    }

    fn amplified_energy(&self) -> Result<f64, PodError> {
        let (n, m) = self.shape();
        let diagonal = self.product.diagonal();
        let part = |rows: Range<usize>| {
            let z = block(self, rows.clone(), 0..m)?;
            let of_column = |column: ColRef<'_, f64>| -> f64 {
                column.iter().zip(&diagonal[rows.clone()]).map(|(x, w)| w * x * x).sum()
            };
            Ok::<_, PodError>(z.col_iter().map(of_column).sum::<f64>() / m as f64)
        };
        Blocks::for_products(n, m).reduce(self.options.par, &part, &|a, b| a + b)
    }
}

impl Columns for Ensemble<'_> {
    fn shape(&self) -> (usize, usize) {
        (self.source.dim(), self.source.times().len())
    }

    fn read(
        &self,
        rows: Range<usize>,
        cols: Range<usize>,
        mut out: MatMut<'_, f64>,
    ) -> Result<(), PodError> {
        read_checked(self.source, rows.clone(), cols.clone(), out.as_mut())?;
        if let Some(mean) = &self.mean {
            mean.subtract(rows, out.as_mut());
        }
        if self.options.time_weights.is_some() {
            for (column, s) in out.as_mut().col_iter_mut().zip(&self.scale[cols]) {
                column.iter_mut().for_each(|x| *x *= s);
            }
        }
        Ok(())
    }
}

/// Subtracts one field from every column.
pub(crate) fn subtract_from_columns(field: &[f64], mut x: MatMut<'_, f64>) {
    for column in x.as_mut().col_iter_mut() {
        column.iter_mut().zip(field).for_each(|(x, f)| *x -= f);
    }
}

/// Snapshots exist and have the length that the inner product was made for.
pub(crate) fn check_dimensions(
    source: &dyn SnapshotSource,
    product: &dyn InnerProduct,
) -> Result<(), PodError> {
    let (unknowns, product) = (source.dim(), product.dim());
    if unknowns == 0 || source.times().is_empty() {
        return Err(PodError::Empty { unknowns });
    }
    if unknowns != product {
        return Err(PodError::Dimension { unknowns, product });
    }
    Ok(())
}

fn check_truncation(truncation: Truncation) -> Result<(), PodError> {
    match truncation {
        Truncation::Modes(0) => Err(PodError::NoModes),
        Truncation::Energy(fraction) if !(fraction > 0.0 && fraction <= 1.0) => {
            Err(PodError::Energy { fraction })
        }
        _ => Ok(()),
    }
}

/// Reads a block and names its first entry that is not finite.
pub(crate) fn read_checked(
    source: &dyn SnapshotSource,
    rows: Range<usize>,
    cols: Range<usize>,
    mut out: MatMut<'_, f64>,
) -> Result<(), PodError> {
    source.block(rows.clone(), cols.clone(), out.as_mut())?;
    for (snapshot, column) in cols.zip(out.as_ref().col_iter()) {
        if let Some(i) = column.iter().position(|x| !x.is_finite()) {
            let (time, row, value) = (source.times()[snapshot], rows.start + i, column[i]);
            return Err(PodError::NonFinite { snapshot, time, row, value });
        }
    }
    Ok(())
}
