//! The fronts of a tree of subdomains.

use super::analysis::{Analysis, Front, Run};
use super::dissection::{Dissection, Subdomain};
use crate::linear::CellUnknowns;
use std::ops::Range;

/// Levels of the tree, from the root, whose halves may be eliminated at the same time.
const FORKS: usize = 4;

/// Orders the unknowns and lays out the fronts.
///
/// * `delayed`: for each subdomain the unknowns that it must leave
pub(super) fn build(cells: CellUnknowns, tree: &Dissection, delayed: &[Vec<u32>]) -> Analysis {
    let (order, left) = eliminate(&cells, tree, delayed);
    let mut place = vec![0; cells.count()];
    for (i, &unknown) in (0..).zip(&order.unknowns) {
        place[unknown as usize] = i;
    }
    let mut analysis = Analysis {
        fronts: Vec::with_capacity(left.len()),
        order: order.unknowns,
        cell_rows: Vec::new(),
        cell_places: Vec::new(),
        left: Vec::new(),
        runs: Vec::new(),
        cells,
    };
    for ((subdomain, eliminated), unknowns) in
        tree.subdomains.iter().zip(order.eliminated).zip(left)
    {
        let start = analysis.left.len();
        analysis.left.extend(unknowns.iter().map(|&u| place[u as usize]));
        analysis.left[start..].sort_unstable();
        let front = analysis.front(tree, subdomain, eliminated, start..analysis.left.len());
        analysis.fronts.push(front);
    }
    analysis.place_cells(&place);
    analysis.connect();
    analysis.lay_out();
    analysis
}

struct Order {
    unknowns: Vec<u32>,
    eliminated: Vec<Range<usize>>,
}

/// Which unknowns each subdomain eliminates, and which it leaves.
fn eliminate(
    cells: &CellUnknowns,
    tree: &Dissection,
    delayed: &[Vec<u32>],
) -> (Order, Vec<Vec<u32>>) {
    let reach = reach(cells, &tree.order);
    let mut order = Order { unknowns: Vec::with_capacity(cells.count()), eliminated: Vec::new() };
    let mut left: Vec<Vec<u32>> = Vec::with_capacity(tree.subdomains.len());
    for (subdomain, delayed) in tree.subdomains.iter().zip(delayed) {
        let mut unknowns: Vec<u32> = match subdomain.halves {
            Some(halves) => halves.into_iter().flat_map(|h| left[h].iter().copied()).collect(),
            None => tree.order[subdomain.cells.clone()]
                .iter()
                .flat_map(|&c| cells.of(c))
                .copied()
                .collect(),
        };
        // Neighbours in the tree are neighbours in the order: contributions fit in long runs.
        unknowns.sort_unstable_by_key(|&u| (reach[u as usize], u));
        unknowns.dedup();
        let inside = |u: &u32| {
            let [first, last] = reach[*u as usize];
            subdomain.cells.start <= first
                && last < subdomain.cells.end
                && delayed.binary_search(u).is_err()
        };
        let start = order.unknowns.len();
        order.unknowns.extend(unknowns.iter().copied().filter(inside));
        order.eliminated.push(start..order.unknowns.len());
        unknowns.retain(|u| !inside(u));
        left.push(unknowns);
    }
    (order, left)
}

/// The first and the last cell, by rank, that has the unknown.
fn reach(cells: &CellUnknowns, order: &[usize]) -> Vec<[usize; 2]> {
    let mut reach = vec![[usize::MAX, 0]; cells.count()];
    for (rank, &cell) in order.iter().enumerate() {
        for &u in cells.of(cell) {
            let [first, last] = &mut reach[u as usize];
            *first = rank.min(*first);
            *last = rank;
        }
    }
    reach
}

impl Analysis {
    fn front(
        &self,
        tree: &Dissection,
        subdomain: &Subdomain,
        eliminated: Range<usize>,
        left: Range<usize>,
    ) -> Front {
        let cells = match subdomain.halves {
            Some(_) => Vec::new(),
            None => tree.order[subdomain.cells.clone()].to_vec(),
        };
        let first = match subdomain.halves {
            Some([half, _]) => self.fronts[half].first,
            None => eliminated.start,
        };
        let (halves, runs) = (subdomain.halves, 0..0);
        Front { cells, halves, eliminated, left, runs, entries: 0, work: 0, first, forked: false }
    }

    /// Row of the front in which the unknown at this place of the order stands.
    fn row(&self, front: &Front, place: u32) -> u32 {
        let at = place as usize;
        let row = if front.eliminated.contains(&at) {
            at - front.eliminated.start
        } else {
            let left = self.left[front.left.clone()].binary_search(&place);
            front.pivots() + left.expect("a front has the unknowns of its cells and halves")
        };
        u32::try_from(row).expect("unknowns are numbered in 32 bits")
    }

    fn place_cells(&mut self, place: &[u32]) {
        let each = 0..self.cells.cells();
        self.cell_places =
            each.flat_map(|c| self.cells.of(c)).map(|&u| place[u as usize]).collect();
        let mut rows = vec![0; self.cell_places.len()];
        for front in &self.fronts {
            for &cell in &front.cells {
                let range = self.cells.of_range(cell);
                for (row, &place) in rows[range.clone()].iter_mut().zip(&self.cell_places[range]) {
                    *row = self.row(front, place);
                }
            }
        }
        self.cell_rows = rows;
    }

    /// Finds the runs of each contribution in the front that takes it.
    fn connect(&mut self) {
        for whole in 0..self.fronts.len() {
            for half in self.fronts[whole].halves.into_iter().flatten() {
                let start = self.runs.len();
                let left = self.fronts[half].left.clone();
                for (from, place) in (0..).zip(left) {
                    let front = &self.fronts[whole];
                    let to = self.row(front, self.left[place]);
                    let splits = to as usize == front.pivots();
                    match self.runs[start..].last_mut() {
                        Some(run) if run.to + run.len == to && !splits => run.len += 1,
                        _ => self.runs.push(Run { from, to, len: 1 }),
                    }
                }
                self.fronts[half].runs = start..self.runs.len();
            }
        }
    }

    /// Sizes of the memory of each subtree.
    fn lay_out(&mut self) {
        let mut level = vec![0; self.fronts.len()];
        for whole in (0..self.fronts.len()).rev() {
            for half in self.fronts[whole].halves.into_iter().flatten() {
                level[half] = level[whole] + 1;
            }
        }
        for (i, level) in level.into_iter().enumerate() {
            let front = &self.fronts[i];
            let right = front.size() * front.left.len();
            let (forked, mut entries, mut work) = (level < FORKS, front.own_entries(), right);
            if let Some([a, b]) = front.halves.map(|halves| halves.map(|h| &self.fronts[h])) {
                entries += a.entries + b.entries;
                work = if forked {
                    a.work + b.work + right
                } else {
                    let kept = a.contribution() + b.contribution();
                    a.work.max(a.contribution() + b.work).max(kept + right)
                };
            }
            let front = &mut self.fronts[i];
            (front.forked, front.entries, front.work) = (forked, entries, work);
        }
    }
}
