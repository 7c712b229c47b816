use super::build::build;
use super::components::delayed;
use super::dissection::Dissection;
use crate::linear::CellUnknowns;
use std::ops::Range;
use std::sync::Arc;

/// Cells in a leaf of the tree.
const LEAF: usize = 4;

/// The unknowns that make a subdomain singular while its boundary is not eliminated: in a flow with
/// discontinuous pressures the constant pressures of the cells.
///
/// ```
/// use lumley_fom::linear::DelayedUnknowns;
/// // Two cells side by side, with the pressures 12 and 13.
/// let pressures = DelayedUnknowns { unknowns: &[[12, 0], [13, 1]], neighbours: &[[0, 1]] };
/// assert_eq!(pressures.unknowns.len(), 2);
/// ```
#[derive(Debug, Clone, Copy, Default)]
pub struct DelayedUnknowns<'a> {
    /// Unknown and the cell that it belongs to. A cell may have none.
    pub unknowns: &'a [[usize; 2]],
    /// Pairs of cells that share an edge.
    pub neighbours: &'a [[usize; 2]],
}

/// The order of elimination and the fronts of a matrix given by cells, apart from its numbers.
///
/// The cells are cut in two again and again (nested dissection). An unknown is eliminated in the
/// smallest subdomain that has all its cells; what is left of the subdomain's matrix, its
/// contribution, is added into the front of the subdomain twice its size (Duff and Reid, 1983).
///
/// ```
/// use lumley_fom::linear::{Analysis, CellUnknowns, DelayedUnknowns};
/// let line = CellUnknowns::new(101, &(0..100).map(|c| [c, c + 1]).collect::<Vec<_>>())?;
/// let centroids: Vec<_> = (0..100).map(|c| [f64::from(c) + 0.5, 0.0]).collect();
/// let analysis = Analysis::new(line, &centroids, &DelayedUnknowns::default());
/// assert!(analysis.entries() < 1000);
/// # Ok::<(), lumley_fom::linear::CellUnknownsError>(())
/// ```
#[derive(Debug)]
pub struct Analysis {
    pub(super) cells: CellUnknowns,
    pub(super) fronts: Vec<Front>,
    /// Unknowns in the order of elimination.
    pub(super) order: Vec<u32>,
    /// For each cell and each of its unknowns: its row in the front of the cell's leaf.
    pub(super) cell_rows: Vec<u32>,
    /// For each cell and each of its unknowns: its place in the order of elimination.
    pub(super) cell_places: Vec<u32>,
    /// Unknowns, by place in the order, that each front leaves.
    pub(super) left: Vec<u32>,
    /// Where the contributions go in the fronts that take them.
    pub(super) runs: Vec<Run>,
}

/// Consecutive unknowns of a contribution that are consecutive in the front that takes it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Run {
    pub from: u32,
    pub to: u32,
    pub len: u32,
}

/// The dense matrix of a subdomain: unknowns that are eliminated in it, then those that are left.
#[derive(Debug, Clone)]
pub(super) struct Front {
    /// Cells of a leaf.
    pub cells: Vec<usize>,
    pub halves: Option<[usize; 2]>,
    /// Places, in the order of elimination, of the eliminated unknowns.
    pub eliminated: Range<usize>,
    /// Where the places of the others lie in `Analysis::left`.
    pub left: Range<usize>,
    /// Where the runs of the contribution lie in `Analysis::runs`.
    pub runs: Range<usize>,
    /// Entries of the factors of the whole subtree.
    pub entries: usize,
    /// Entries of working memory of the whole subtree.
    pub work: usize,
    /// The first of the eliminated unknowns of the subtree.
    pub first: usize,
    /// The halves have working memory of their own each.
    pub forked: bool,
}

impl Front {
    /// Number of eliminated unknowns.
    pub fn pivots(&self) -> usize {
        self.eliminated.len()
    }

    /// Number of all unknowns.
    pub fn size(&self) -> usize {
        self.eliminated.len() + self.left.len()
    }

    /// Entries of the contribution.
    pub fn contribution(&self) -> usize {
        self.left.len() * self.left.len()
    }

    /// Entries of its own factors: the columns of the pivots, then the rows of the pivots.
    pub fn own_entries(&self) -> usize {
        self.pivots() * (self.size() + self.left.len())
    }
}

impl Analysis {
    /// Orders the unknowns of these cells.
    ///
    /// * `centroids`: of the cells, in m or any unit; only their order along lines matters
    /// * `delay`: unknowns that must not be eliminated too early
    ///
    /// # Panics
    /// If there is no cell, the centroids are not one for each cell, or `delay` names a cell that does not exist.
    pub fn new(
        cells: CellUnknowns,
        centroids: &[[f64; 2]],
        delay: &DelayedUnknowns<'_>,
    ) -> Arc<Self> {
        assert!(cells.cells() > 0, "a system has at least one cell");
        assert_eq!(centroids.len(), cells.cells(), "one centroid for each cell");
        let dissection = Dissection::new(&cells, centroids, LEAF);
        let delayed = delayed(&dissection, delay);
        Arc::new(build(cells, &dissection, &delayed))
    }

    /// The pattern of the matrix.
    pub fn cells(&self) -> &CellUnknowns {
        &self.cells
    }

    /// Numbers that a factorisation keeps.
    pub fn entries(&self) -> usize {
        self.fronts.last().map_or(0, |root| root.entries)
    }

    /// Numbers of working memory that a factorisation needs.
    pub(super) fn work(&self) -> usize {
        self.fronts.last().map_or(0, |root| root.work)
    }

    /// The greatest number of unknowns that a front leaves.
    pub(super) fn left_at_most(&self) -> usize {
        self.fronts.iter().map(|front| front.left.len()).max().unwrap_or(0)
    }

    /// Additions and multiplications of a factorisation, without the adding up of fronts.
    pub fn operations(&self) -> f64 {
        let front = |f: &Front| {
            let (k, r) = (f.pivots() as f64, f.left.len() as f64);
            2.0 * k * (k * k / 3.0 + k * r + r * r)
        };
        self.fronts.iter().map(front).sum()
    }
}
