//! The files that a decomposition begins with: snapshots, weights, times.

use super::PodInput;
use super::old::OldFile;
use crate::Error;
use crate::format::npy::{NpySnapshots, NpyWeights, SnapshotLayout, read_vector};
use crate::record::{Record, Support};
use crate::report::FieldGrid;
use crate::run::grid_product;
use lumley_pod::time_weights::trapezoid;
use lumley_pod::{Identity, InnerProduct, Ranks, SnapshotSource};
use std::path::Path;

/// Snapshots, their inner product and the words for it.
pub(super) struct Opened {
    pub snapshots: Box<dyn SnapshotSource>,
    /// Whether the times are the snapshots' own and not their numbers.
    pub timed: bool,
    /// Weights of the snapshots, where their times are given and unequal.
    pub time_weights: Option<Vec<f64>>,
    pub product: Box<dyn InnerProduct>,
    pub inner_product: String,
    pub grid: Option<FieldGrid>,
    /// The basis that the snapshots update.
    pub old: Option<OldFile>,
}

impl PodInput {
    /// Each rank looks at its own share of what is long; all of them must then agree.
    ///
    /// * `target`: the run that is made
    pub(super) fn open(&self, target: &Path, ranks: &dyn Ranks) -> Result<Opened, Error> {
        self.check_outside(target)?;
        let old = self.open_old(ranks)?;
        let opened = match self.record() {
            Some(record) => self.open_record(&record, ranks)?,
            None => self.open_npy(ranks)?,
        };
        if let Some(old) = old.as_ref().filter(|_| opened.timed) {
            self.check_order(old, opened.snapshots.times())?;
        }
        Ok(Opened { old, ..opened })
    }

    fn open_npy(&self, ranks: &dyn Ranks) -> Result<Opened, Error> {
        let mut snapshots = NpySnapshots::open(&self.path, self.layout)?;
        if let Some(times) = &self.times {
            snapshots = snapshots.with_times(read_vector(times)?)?;
        }
        let unknowns = snapshots.dim();
        if self.components == 0 || unknowns % self.components != 0 {
            return Err(Error::Argument {
                argument: "--components",
                value: self.components.to_string(),
                expected: format!("a divisor of the {unknowns} numbers of a snapshot"),
            });
        }
        if let Some(grid) = self.grid.filter(|grid| numbers(grid) != Some(unknowns)) {
            let [nx, ny, nz] = grid.nodes;
            return Err(Error::Argument {
                argument: "--grid",
                value: format!("{nx},{ny},{nz} with {} components", grid.components),
                expected: format!("as many numbers as a snapshot has: {unknowns}"),
            });
        }
        let (product, inner_product) = self.product(unknowns, self.components, ranks)?;
        let time_weights = match &self.times {
            Some(_) => unequal(snapshots.times()),
            None => None,
        };
        let snapshots = Box::new(snapshots);
        let (timed, grid) = (self.times.is_some(), self.grid);
        Ok(Opened { snapshots, timed, time_weights, product, inner_product, grid, old: None })
    }

    fn open_record(&self, path: &Path, ranks: &dyn Ranks) -> Result<Opened, Error> {
        let given = [("--times", self.times.is_some()), ("--grid", self.grid.is_some())];
        let others = [
            ("--snapshots columns", self.layout == SnapshotLayout::Columns),
            ("--components", self.components != 1),
        ];
        if let Some((argument, _)) = given.into_iter().chain(others).find(|(_, given)| *given) {
            return Err(Error::Argument {
                argument,
                value: format!("with the record {}", path.display()),
                expected: "an NPY file; a record knows its times, its grid and its components"
                    .into(),
            });
        }
        let record = Record::open(path)?;
        let frame = &record.description().frames[0];
        let snapshots = record.frame(&frame.name)?;
        let unknowns = snapshots.dim();
        let components = frame.components.len();
        let (mut product, mut inner_product) = self.product(unknowns, components, ranks)?;
        let mut field_grid = None;
        if let Support::Grid(grid) = &frame.support {
            let [nx, ny] = grid.nodes();
            field_grid = Some(FieldGrid { nodes: [nx, ny, 1], components });
            if self.weights.is_none() {
                product = Box::new(grid_product(grid, components));
                inner_product = "L2 on the grid".into();
            }
        }
        let time_weights = unequal(snapshots.times());
        let snapshots = Box::new(snapshots);
        let (timed, grid) = (true, field_grid);
        Ok(Opened { snapshots, timed, time_weights, product, inner_product, grid, old: None })
    }

    /// The weights' inner product, each node's repeated for its components; without weights, identity.
    fn product(
        &self,
        unknowns: usize,
        components: usize,
        ranks: &dyn Ranks,
    ) -> Result<(Box<dyn InnerProduct>, String), Error> {
        let Some(path) = &self.weights else {
            return Ok((Box::new(Identity::new(unknowns)), "identity".into()));
        };
        let weights = NpyWeights::open_share(path, ranks.rank(), ranks.count())?;
        let product = match weights.dim() {
            n if n == unknowns => weights,
            n if n.checked_mul(components) == Some(unknowns) => weights.repeated(components),
            n => {
                return Err(Error::Argument {
                    argument: "--weights",
                    value: format!("{} with {n} numbers", path.display()),
                    expected: format!("{unknowns} numbers, one for each unknown of a snapshot"),
                });
            }
        };
        Ok((Box::new(product), format!("weights of {}", path.display())))
    }
}

/// Weights of the trapezoid rule where the steps between `times` differ; equal steps weigh all alike.
pub(super) fn unequal(times: &[f64]) -> Option<Vec<f64>> {
    let mean = (times.last()? - times.first()?) / (times.len() - 1).max(1) as f64;
    let differ = times.windows(2).any(|pair| (pair[1] - pair[0] - mean).abs() > 1e-6 * mean);
    if differ { trapezoid(times).ok() } else { None }
}

/// Numbers in a snapshot on `grid`, if they can be counted.
fn numbers(grid: &FieldGrid) -> Option<usize> {
    grid.nodes.iter().try_fold(grid.components, |product, n| product.checked_mul(*n))
}
