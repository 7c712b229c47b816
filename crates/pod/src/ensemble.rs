use crate::product::Columns;
use crate::reduction::Blocks;
use crate::spectrum::Spectrum;
use crate::{InnerProduct, Options, PodError, SnapshotSource, Truncation, time_weights};
use faer::{Mat, MatMut};
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
    pub mean: Option<Vec<f64>>,
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
        let mut ensemble = Self { source, product, options, time_weights, scale, mean: None };
        if options.center {
            ensemble.mean = Some(ensemble.time_mean()?);
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

    /// The spectrum of these eigenvalues, with a noise floor relative to the first.
    pub fn spectrum(
        &self,
        values: Vec<f64>,
        floor: f64,
        reveals_rank: bool,
    ) -> Result<Spectrum, PodError> {
        let (snapshots, centred) = (self.scale.len(), self.mean.is_some());
        Spectrum::new(values, floor, reveals_rank).ok_or(PodError::NoEnergy { snapshots, centred })
    }

    /// `<u> = u_0 + sum_j q_j (u_j - u_0)`: exact where the snapshots are constant.
    fn time_mean(&self) -> Result<Vec<f64>, PodError> {
        let (n, m) = self.shape();
        let part = |rows: Range<usize>| {
            let mut x = Mat::zeros(rows.len(), m);
            read_checked(self.source, rows, 0..m, x.as_mut())?;
            let mut mean: Vec<f64> = x.col(0).iter().copied().collect();
            for (q, column) in self.time_weights.iter().zip(x.col_iter()) {
                for (i, mean) in mean.iter_mut().enumerate() {
                    *mean += q * (column[i] - x[(i, 0)]);
                }
            }
            Ok(mean)
        };
        let join = |mut top: Vec<f64>, bottom: Vec<f64>| {
            top.extend(bottom);
            top
        };
        Blocks::for_products(n, m).reduce(self.options.par, &part, &join)
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
            subtract_from_columns(&mean[rows], out.as_mut());
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
