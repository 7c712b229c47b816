//! Nested dissection of cells: a binary tree of subdomains.

use super::bisection::Bisection;
use crate::linear::CellUnknowns;
use std::ops::Range;

/// A subdomain: a range of the ordered cells, cut in two or whole.
#[derive(Debug, Clone)]
pub(super) struct Subdomain {
    pub cells: Range<usize>,
    pub halves: Option<[usize; 2]>,
}

/// The tree of subdomains, halves before the whole.
#[derive(Debug)]
pub(super) struct Dissection {
    /// Cells in the order of the leaves.
    pub order: Vec<usize>,
    pub subdomains: Vec<Subdomain>,
}

impl Dissection {
    /// Cuts until at most `leaf` cells are left in a piece.
    pub fn new(cells: &CellUnknowns, centroids: &[[f64; 2]], leaf: usize) -> Self {
        let mut order: Vec<usize> = (0..cells.cells()).collect();
        let mut subdomains = Vec::new();
        let mut bisection = Bisection::new(cells, centroids);
        dissect(&mut bisection, &mut order, 0, leaf, &mut subdomains);
        Self { order, subdomains }
    }
}

fn dissect(
    bisection: &mut Bisection<'_>,
    cells: &mut [usize],
    start: usize,
    leaf: usize,
    subdomains: &mut Vec<Subdomain>,
) -> usize {
    let halves = (cells.len() > leaf).then(|| {
        let cut = bisection.cut(cells);
        let (left, right) = cells.split_at_mut(cut);
        [
            dissect(bisection, left, start, leaf, subdomains),
            dissect(bisection, right, start + cut, leaf, subdomains),
        ]
    });
    subdomains.push(Subdomain { cells: start..start + cells.len(), halves });
    subdomains.len() - 1
}
