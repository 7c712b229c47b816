//! One cut of a set of cells: the straight cut of least separator, then moves of single cells.

use crate::linear::CellUnknowns;

/// Directions in which the cells are swept.
const DIRECTIONS: [[f64; 2]; 4] = [
    [1.0, 0.0],
    [0.0, 1.0],
    [std::f64::consts::FRAC_1_SQRT_2, std::f64::consts::FRAC_1_SQRT_2],
    [std::f64::consts::FRAC_1_SQRT_2, -std::f64::consts::FRAC_1_SQRT_2],
];
/// The smaller part has at least this share of the cells, in percent.
const BALANCE: usize = 40;
/// Passes of single moves over one cut.
const PASSES: usize = 4;
/// An unknown of more cells than this makes no neighbours: it belongs to a body, not to a node.
const CROWD: usize = 32;

/// Cuts sets of cells in two with few unknowns in common. An unknown weighs one; those that the
/// set shares with cells outside of it stand in both parts' fronts anyhow, where they touch both.
pub(super) struct Bisection<'a> {
    cells: &'a CellUnknowns,
    centroids: &'a [[f64; 2]],
    /// Cells of the set that have the unknown: on either side of the cut.
    sides: Vec<[u32; 2]>,
    /// Side of each cell.
    side: Vec<bool>,
    /// Cells of the set.
    member: Vec<bool>,
    /// Cells that may move in this pass or have moved.
    listed: Vec<bool>,
    /// Cells that have the unknown.
    sharing: Vec<Vec<usize>>,
}

impl<'a> Bisection<'a> {
    pub fn new(cells: &'a CellUnknowns, centroids: &'a [[f64; 2]]) -> Self {
        let mut sharing = vec![Vec::new(); cells.count()];
        for cell in 0..cells.cells() {
            for &u in cells.of(cell) {
                sharing[u as usize].push(cell);
            }
        }
        Self {
            cells,
            centroids,
            sharing,
            sides: vec![[0; 2]; cells.count()],
            side: vec![false; cells.cells()],
            member: vec![false; cells.cells()],
            listed: vec![false; cells.cells()],
        }
    }

    /// Reorders the set; returns the size of its first part.
    pub fn cut(&mut self, set: &mut [usize]) -> usize {
        let window = window(set.len());
        let direction = self.best_direction(set, &window);
        self.sort(set, direction);
        let (cut, _) = self.sweep(set, &window);
        self.start(set, cut);
        for _ in 0..PASSES {
            if !self.improve(set, &window) {
                break;
            }
        }
        self.forget(set);
        partition(set, &self.side)
    }

    fn best_direction(&mut self, set: &mut [usize], window: &[usize; 2]) -> [f64; 2] {
        let mut best = (f64::INFINITY, DIRECTIONS[0]);
        for direction in DIRECTIONS {
            self.sort(set, direction);
            let (_, cost) = self.sweep(set, window);
            if cost < best.0 {
                best = (cost, direction);
            }
        }
        best.1
    }

    fn sort(&self, set: &mut [usize], [dx, dy]: [f64; 2]) {
        let key = |c: &usize| {
            let [x, y] = self.centroids[*c];
            (x * dx + y * dy, y * dx - x * dy)
        };
        set.sort_by(|a, b| {
            let (a, b) = (key(a), key(b));
            a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
        });
    }

    /// The cheapest cut of the set in its order, and its cost.
    fn sweep(&mut self, set: &[usize], &[least, most]: &[usize; 2]) -> (usize, f64) {
        self.start(set, 0);
        let (mut separator, mut best) = (0, (least, f64::INFINITY));
        for (i, &cell) in set.iter().enumerate().take(most) {
            separator += self.gain(cell);
            self.flip(cell);
            let cost = cost(separator, i + 1, set.len());
            if i + 1 >= least && cost < best.1 {
                best = (i + 1, cost);
            }
        }
        self.forget(set);
        best
    }

    /// Puts the first cells of the set on the one side, the rest on the other.
    fn start(&mut self, set: &[usize], cut: usize) {
        for (i, &cell) in set.iter().enumerate() {
            self.side[cell] = i < cut;
            self.member[cell] = true;
            for &u in self.cells.of(cell) {
                self.sides[u as usize][usize::from(i < cut)] += 1;
            }
        }
    }

    fn forget(&mut self, set: &[usize]) {
        for &cell in set {
            self.member[cell] = false;
            for &u in self.cells.of(cell) {
                self.sides[u as usize] = [0; 2];
            }
        }
    }

    /// How much the separator grows when the cell changes sides.
    fn gain(&self, cell: usize) -> isize {
        let here = usize::from(self.side[cell]);
        let change = |&u: &u32| {
            let counts = self.sides[u as usize];
            isize::from(counts[here] > 1 && counts[1 - here] == 0)
                - isize::from(counts[here] == 1 && counts[1 - here] > 0)
        };
        self.cells.of(cell).iter().map(change).sum()
    }

    fn flip(&mut self, cell: usize) {
        let here = usize::from(self.side[cell]);
        self.side[cell] = here == 0;
        for &u in self.cells.of(cell) {
            let counts = &mut self.sides[u as usize];
            counts[here] -= 1;
            counts[1 - here] += 1;
        }
    }

    fn on_separator(&self, cell: usize) -> bool {
        self.cells.of(cell).iter().any(|&u| self.sides[u as usize].iter().all(|&n| n > 0))
    }

    /// One pass of Fiduccia and Mattheyses (1982): moves the cell that shortens the separator most or
    /// lengthens it least, each cell once, and goes back to the best state seen. True if that gained.
    fn improve(&mut self, set: &[usize], window: &[usize; 2]) -> bool {
        let mut near: Vec<usize> = set.iter().copied().filter(|&c| self.on_separator(c)).collect();
        let patience = 2 * near.len().max(4);
        let mut part = set.iter().filter(|&&c| self.side[c]).count();
        let (mut moves, mut growth, mut best) = (Vec::new(), 0, (0, 0));
        for &cell in &near {
            self.listed[cell] = true;
        }
        while moves.len() < best.1 + patience {
            let Some((gain, cell)) = self.best_move(&near, part, window) else { break };
            part = if self.side[cell] { part - 1 } else { part + 1 };
            self.flip(cell);
            near.retain(|&c| c != cell);
            moves.push(cell);
            self.list_neighbours(cell, &mut near);
            growth += gain;
            best = best.min((growth, moves.len()));
        }
        for &cell in moves[best.1..].iter().rev() {
            self.flip(cell);
        }
        for &cell in moves.iter().chain(&near) {
            self.listed[cell] = false;
        }
        best.0 < 0
    }

    fn best_move(
        &self,
        near: &[usize],
        part: usize,
        &[least, most]: &[usize; 2],
    ) -> Option<(isize, usize)> {
        let allowed = |c: usize| if self.side[c] { part > least } else { part < most };
        near.iter().filter(|&&c| allowed(c)).map(|&c| (self.gain(c), c)).min()
    }

    /// Adds the cells of the set that share an unknown with this one and were not listed yet.
    fn list_neighbours(&mut self, cell: usize, near: &mut Vec<usize>) {
        for &u in self.cells.of(cell) {
            let sharing = &self.sharing[u as usize];
            if sharing.len() > CROWD {
                continue;
            }
            for &other in sharing {
                if self.member[other] && !self.listed[other] {
                    self.listed[other] = true;
                    near.push(other);
                }
            }
        }
    }
}

/// The least and the greatest size of the first part.
fn window(cells: usize) -> [usize; 2] {
    let least = (cells * BALANCE / 100).clamp(1, cells / 2);
    [least, cells - least]
}

/// Cost of a separator: what it takes to eliminate grows with its length, and with the imbalance.
fn cost(separator: isize, part: usize, cells: usize) -> f64 {
    let imbalance = (2 * part).abs_diff(cells) as f64 / cells as f64;
    separator as f64 * (1.0 + imbalance)
}

/// Puts the cells of the first side first, both in their order; returns their number.
fn partition(set: &mut [usize], first: &[bool]) -> usize {
    set.sort_by_key(|&c| !first[c]);
    set.iter().filter(|&&c| first[c]).count()
}
