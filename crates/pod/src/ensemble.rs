use crate::approximation::{OVERSAMPLING, Previous};
use crate::contiguous::columns_mut;
use crate::inner_product::reach_of;
use crate::mean::Mean;
use crate::partition::Partition;
use crate::plan::{Demand, Plan};
use crate::reduction::Reduction;
use crate::spectrum::Spectrum;
use crate::tile::Workspace;
use crate::{Execution, InnerProduct, Options, PodError, SnapshotSource, Truncation, time_weights};
use faer::{Mat, MatMut};
use std::ops::Range;
use std::sync::Mutex;

/// The snapshots as the algorithms see them: checked, centred, weighted in time, read by tiles of rows.
///
/// What is read is the matrix of `s_j (u_j - <u>)` with `s_j = sqrt(M q_j)`, so that the time
/// average needs no weights: `<(u, v)> = (1/M) sum_j`.
pub(crate) struct Ensemble<'a> {
    pub source: &'a dyn SnapshotSource,
    pub product: &'a dyn InnerProduct,
    pub options: &'a Options,
    pub time_weights: Vec<f64>,
    /// `s_j`, all one without time weights.
    pub scale: Vec<f64>,
    /// `sum_i W_ii <u_i²>` where W couples all rows: the energy that errors of the size of the
    /// entries have. Zero where it is the energy of the snapshots itself.
    pub amplified: f64,
    /// What stands in the columns before those of the snapshots, if there is something.
    pub previous: Option<&'a Previous<'a>>,
    pub partition: Partition,
    pub plan: Plan,
    pub workspaces: Mutex<Vec<Workspace>>,
    /// The number of each column.
    pub every: Vec<usize>,
}

impl<'a> Ensemble<'a> {
    /// * `width`: columns of the sums that will be taken, each with M rows
    pub fn for_sums(
        source: &'a dyn SnapshotSource,
        product: &'a dyn InnerProduct,
        options: &'a Options,
        width: usize,
    ) -> Result<Self, PodError> {
        check_dimensions(source, product)?;
        check_truncation(options.truncation)?;
        let plan = planned(source, product, options, [source.times().len(), width])?;
        Self::with_plan(source, product, options, plan)
    }

    /// For algorithms that read whole columns.
    pub fn for_columns(
        source: &'a dyn SnapshotSource,
        product: &'a dyn InnerProduct,
        options: &'a Options,
    ) -> Result<Self, PodError> {
        check_dimensions(source, product)?;
        check_truncation(options.truncation)?;
        let partition = Partition::new(source.dim(), source.times().len());
        let plan = Plan { tile: partition.block(), group: 1 };
        Self::with_plan(source, product, options, (partition, plan))
    }

    fn with_plan(
        source: &'a dyn SnapshotSource,
        product: &'a dyn InnerProduct,
        options: &'a Options,
        (partition, plan): (Partition, Plan),
    ) -> Result<Self, PodError> {
        let m = source.times().len();
        let time_weights = time_weights::normalised(options.time_weights.as_deref(), m)?;
        let scale = match &options.time_weights {
            Some(_) => time_weights.iter().map(|q| (m as f64 * q).sqrt()).collect(),
            None => vec![1.0; m],
        };
        Ok(Self {
            source,
            product,
            options,
            time_weights,
            scale,
            amplified: 0.0,
            previous: None,
            partition,
            plan,
            workspaces: Mutex::default(),
            every: (0..m).collect(),
        })
    }

    /// The same snapshots with what is known of previous ones in columns before theirs.
    pub fn beside(&self, previous: &'a Previous<'a>) -> Result<Self, PodError> {
        let share = (previous.counts[1] / self.scale.len() as f64).sqrt();
        let mut scale = vec![1.0; previous.columns()];
        scale.extend(self.scale.iter().map(|s| s * share));
        let (partition, plan) = planned(self.source, self.product, self.options, [scale.len(); 2])?;
        Ok(Self {
            every: (0..scale.len()).collect(),
            scale,
            previous: Some(previous),
            partition,
            plan,
            time_weights: self.time_weights.clone(),
            workspaces: Mutex::default(),
            ..*self
        })
    }

    /// Rows and columns of the snapshot matrix.
    pub fn shape(&self) -> (usize, usize) {
        (self.source.dim(), self.scale.len())
    }

    /// How sums over its rows are taken.
    pub fn reduction<'e>(&self, execution: Execution<'e>) -> Reduction<'e> {
        let (partition, par) = (self.partition, self.options.par);
        Reduction { partition, execution, par, group: self.plan.group }
    }

    /// Centres and weights columns `cols` of some rows, whose mean this is.
    pub fn prepare(&self, mean: Option<&Mean>, cols: Range<usize>, mut x: MatMut<'_, f64>) {
        if let Some(mean) = mean {
            mean.subtract(x.as_mut());
        }
        if self.options.time_weights.is_some() {
            for (column, s) in columns_mut(x).zip(&self.scale[cols]) {
                for x in column {
                    *x *= s;
                }
            }
        }
    }

    /// Names the first entry among these rows that is not finite; if there is none, it was their
    /// squares that were too large.
    pub fn not_finite(&self, rows: Range<usize>) -> PodError {
        let search = || -> Result<(), PodError> {
            for rows in Partition::pieces(rows, self.plan.tile) {
                let mut x = Mat::zeros(rows.len(), self.time_weights.len());
                read_checked(self.source, rows, 0..self.time_weights.len(), x.as_mut())?;
            }
            Err(PodError::Overflow)
        };
        search().err().unwrap_or(PodError::Overflow)
    }

    /// The spectrum of these eigenvalues, with the floor under which they are noise.
    ///
    /// Entries are known to `eps` of themselves, before the mean is subtracted: that noise has at
    /// most the energy `eps² sum_i W_ii <x_i²>`, and sums over M columns make `M eps² lambda_1` of a
    /// zero, both with a factor of 16 for what adds up.
    ///
    /// * `steady`: energy of the mean that was subtracted
    /// * `squaring`: the energy that goes missing where the algorithm squares, if it does
    pub fn spectrum(
        &self,
        values: Vec<f64>,
        steady: f64,
        squaring: Option<f64>,
    ) -> Result<Spectrum, PodError> {
        let (snapshots, centred) = (self.scale.len(), self.options.center);
        let first = values.first().map_or(0.0, |l| snapshots as f64 * l);
        let round_off = (4.0 * f64::EPSILON).powi(2) * first.max(self.amplified + steady);
        let mut spectrum = Spectrum::new(values, round_off, squaring)
            .ok_or(PodError::NoEnergy { snapshots, centred })?;
        spectrum.left_out = self.previous.map(|previous| previous.left_out / snapshots as f64);
        Ok(spectrum)
    }

    /// Energy that goes missing where products of weighted snapshots are formed: `M eps lambda_1`, or
    /// more where W takes differences of large entries.
    pub fn squaring(&self, lambda: &[f64]) -> f64 {
        let first = lambda.first().map_or(0.0, |l| self.scale.len() as f64 * l);
        f64::EPSILON * first.max(8.0 * self.amplified)
    }
}

/// The partition for so many columns, and the steps in which sums of them are taken.
///
/// * `columns`: those that are read, and those of the sums, each with as many rows as are read
fn planned(
    source: &dyn SnapshotSource,
    product: &dyn InnerProduct,
    options: &Options,
    columns: [usize; 2],
) -> Result<(Partition, Plan), PodError> {
    let [snapshots, width] = columns;
    let partition = Partition::new(source.dim(), snapshots);
    let reach = reach_of(product);
    let (threads, read) = (options.par.degree().max(1), source.read_size());
    let asked = match options.truncation {
        Truncation::Modes(modes) => modes.saturating_add(OVERSAMPLING),
        Truncation::Energy(_) => snapshots,
    };
    let modes = asked.min(snapshots).min(source.dim());
    let sum = snapshots * width;
    let demand = Demand { partition, snapshots, modes, sum, threads, reach, read };
    Ok((partition, Plan::new(&demand, options.memory_limit)?))
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

/// At least one mode, or a share of the energy.
pub(crate) fn check_truncation(truncation: Truncation) -> Result<(), PodError> {
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
