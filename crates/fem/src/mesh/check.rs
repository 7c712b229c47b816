use super::cells::Cells;
use super::place::{CellPlace, EdgePlace, NodePlace};
use super::{MeshError, NamedBoundary};
use crate::Point;

/// Nodes closer than this part of the extent of the mesh are in the same place.
const SAME_PLACE: f64 = 1e-10;

/// Coordinates beyond this, in m, would overflow where areas are multiplied.
const LARGEST: f64 = 1e75;

/// Cells and the coordinates of their nodes, not yet known to fit together.
#[derive(Clone, Copy)]
pub(super) struct Draft<'a> {
    pub points: &'a [Point],
    pub cells: &'a Cells,
}

impl Draft<'_> {
    pub fn node_place(&self, node: usize) -> NodePlace {
        NodePlace { node, place: self.points[node] }
    }

    pub fn edge_place(&self, ends: [usize; 2]) -> EdgePlace {
        EdgePlace { ends, place: mean(self.points, &ends) }
    }

    pub fn cell_place(&self, cell: usize) -> CellPlace {
        CellPlace { cell, place: mean(self.points, self.cells.corners(cell)) }
    }

    /// Whether all numbers and coordinates can be used, each node and each cell once.
    pub fn check(&self, boundaries: &[NamedBoundary]) -> Result<(), MeshError> {
        if self.cells.len() == 0 {
            return Err(MeshError::NoCells);
        }
        self.finite()?;
        self.cell_indices()?;
        self.boundary_indices(boundaries)?;
        self.repeated_nodes()?;
        self.dangling_nodes()?;
        self.duplicate_nodes()?;
        self.duplicate_cells()
    }

    pub fn finite(&self) -> Result<(), MeshError> {
        let bad = self.points.iter().position(|p| !p.iter().all(|x| x.abs() <= LARGEST));
        bad.map_or(Ok(()), |node| Err(MeshError::NotFinite(self.node_place(node))))
    }

    fn cell_indices(&self) -> Result<(), MeshError> {
        let nodes = self.points.len();
        for cell in 0..self.cells.len() {
            if let Some(&node) = self.cells.nodes(cell).iter().find(|&&node| node >= nodes) {
                return Err(MeshError::CellIndex { cell, node, nodes });
            }
        }
        Ok(())
    }

    fn boundary_indices(&self, boundaries: &[NamedBoundary]) -> Result<(), MeshError> {
        let nodes = self.points.len();
        for NamedBoundary { name, edges } in boundaries {
            if let Some(&node) = edges.as_flattened().iter().find(|&&node| node >= nodes) {
                return Err(MeshError::BoundaryIndex { name: name.clone(), node, nodes });
            }
        }
        Ok(())
    }

    fn repeated_nodes(&self) -> Result<(), MeshError> {
        for cell in 0..self.cells.len() {
            let nodes = self.cells.nodes(cell);
            let repeated = (1..nodes.len()).find(|&k| nodes[..k].contains(&nodes[k]));
            if let Some(k) = repeated {
                let node = self.node_place(nodes[k]);
                return Err(MeshError::RepeatedNode { cell, node });
            }
        }
        Ok(())
    }

    fn dangling_nodes(&self) -> Result<(), MeshError> {
        let mut used = vec![false; self.points.len()];
        for cell in 0..self.cells.len() {
            for &node in self.cells.nodes(cell) {
                used[node] = true;
            }
        }
        let Some(first) = used.iter().position(|used| !used) else {
            return Ok(());
        };
        let count = used.iter().filter(|used| !**used).count();
        Err(MeshError::Dangling { first: self.node_place(first), count })
    }

    /// Sorted along x, nodes in the same place stand in one run without gaps; sorted along y, few of a run
    /// have to be compared.
    fn duplicate_nodes(&self) -> Result<(), MeshError> {
        let tolerance = SAME_PLACE * extent(self.points);
        let mut order: Vec<usize> = (0..self.points.len()).collect();
        order.sort_by(|&a, &b| self.points[a][0].total_cmp(&self.points[b][0]));
        let is_near = |d: usize, a: usize, b: usize| {
            (self.points[a][d] - self.points[b][d]).abs() <= tolerance
        };
        for run in order.chunk_by_mut(|&a, &b| is_near(0, a, b)) {
            run.sort_by(|&a, &b| self.points[a][1].total_cmp(&self.points[b][1]).then(a.cmp(&b)));
            for (k, &a) in run.iter().enumerate() {
                let mut near = run[k + 1..].iter().take_while(|&&b| is_near(1, a, b));
                if let Some(&b) = near.find(|&&b| is_near(0, a, b)) {
                    let first = self.node_place(a.min(b));
                    return Err(MeshError::DuplicateNodes { first, second: a.max(b) });
                }
            }
        }
        Ok(())
    }

    fn duplicate_cells(&self) -> Result<(), MeshError> {
        let sorted = |cell: usize| {
            let mut corners = self.cells.corners(cell).to_vec();
            corners.sort_unstable();
            (corners, cell)
        };
        let mut all: Vec<_> = (0..self.cells.len()).map(sorted).collect();
        all.sort_unstable();
        match all.windows(2).find(|w| w[0].0 == w[1].0) {
            None => Ok(()),
            Some(w) => {
                let first = self.cell_place(w[0].1);
                Err(MeshError::DuplicateCells { first, second: w[1].1 })
            }
        }
    }
}

/// The mean of some nodes.
pub(super) fn mean(points: &[Point], nodes: &[usize]) -> Point {
    [0, 1].map(|d| nodes.iter().map(|&n| points[n][d]).sum::<f64>() / nodes.len() as f64)
}

/// The longer side of the rectangle round the points, in m.
pub(super) fn extent(points: &[Point]) -> f64 {
    let side = |d: usize| {
        let x = points.iter().map(|p| p[d]);
        x.clone().fold(f64::NEG_INFINITY, f64::max) - x.fold(f64::INFINITY, f64::min)
    };
    side(0).max(side(1))
}
