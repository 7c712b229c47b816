use crate::element::Cell;
use std::ops::Range;

/// The nodes of the cells: triangles first, then quadrilaterals.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Cells {
    pub triangles: Vec<[usize; 6]>,
    pub quadrilaterals: Vec<[usize; 9]>,
}

impl Cells {
    pub fn len(&self) -> usize {
        self.triangles.len() + self.quadrilaterals.len()
    }

    pub fn kind(&self, cell: usize) -> Cell {
        if cell < self.triangles.len() { Cell::Triangle } else { Cell::Quadrilateral }
    }

    pub fn nodes(&self, cell: usize) -> &[usize] {
        match cell.checked_sub(self.triangles.len()) {
            None => &self.triangles[cell],
            Some(quadrilateral) => &self.quadrilaterals[quadrilateral],
        }
    }

    pub fn corners(&self, cell: usize) -> &[usize] {
        &self.nodes(cell)[..self.kind(cell).vertices()]
    }

    /// Start, end and middle of an edge of a cell.
    pub fn edge(&self, cell: usize, edge: usize) -> [usize; 3] {
        let (nodes, corners) = (self.nodes(cell), self.kind(cell).vertices());
        [nodes[edge], nodes[(edge + 1) % corners], nodes[corners + edge]]
    }

    /// All cells with their edges, in order.
    pub fn edges(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        (0..self.len()).flat_map(|cell| (0..self.kind(cell).edges()).map(move |edge| (cell, edge)))
    }
}

/// Where the entries of a cell stand in a list that has `per[0]` for each of the `triangles`, which come
/// first, and `per[1]` for each quadrilateral.
pub(crate) fn entries(triangles: usize, per: [usize; 2], cell: usize) -> Range<usize> {
    match cell.checked_sub(triangles) {
        None => cell * per[0]..(cell + 1) * per[0],
        Some(q) => triangles * per[0] + q * per[1]..triangles * per[0] + (q + 1) * per[1],
    }
}
