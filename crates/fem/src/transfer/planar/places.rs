use super::Bodies;
use crate::location::{Bounds, CellMap};
use crate::{Location, PlanarMesh, UniformGrid};
use std::ops::Range;

/// Where a node of a grid is.
///
/// ```
/// use lumley_fem::{Location, transfer::Place};
/// let place = Place::Fluid(Location { cell: 3, reference: [0.5, 0.25] });
/// assert_ne!(place, Place::Outside);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Place {
    /// In a cell of the mesh, its rim included.
    Fluid(Location),
    /// In the body of this number.
    Solid(usize),
    /// In neither.
    Outside,
}

/// How many nodes of a grid are where.
///
/// ```
/// let coverage = lumley_fem::transfer::Coverage { fluid: 90, solid: 10, outside: 0 };
/// assert_eq!(coverage.outside, 0);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Coverage {
    /// Nodes in the mesh.
    pub fluid: usize,
    /// Nodes in bodies.
    pub solid: usize,
    /// Nodes beyond both.
    pub outside: usize,
}

/// The places of all nodes of a grid, cell by cell of the mesh.
#[derive(Debug, Clone)]
pub(super) struct Places {
    pub grid: UniformGrid,
    pub nodes: Vec<Place>,
    pub coverage: Coverage,
    /// Coordinates of the columns and of the rows of nodes, in m.
    lines: [Vec<f64>; 2],
    codes: Vec<usize>,
}

impl Places {
    pub fn new(grid: UniformGrid) -> Self {
        assert_eq!(grid.dimension(), 2, "dimension of the grid");
        let [columns, rows] = grid.nodes();
        let lines = [
            (0..columns).map(|i| grid.point(i)[0]).collect(),
            (0..rows).map(|j| grid.point(j * columns)[1]).collect(),
        ];
        Self {
            nodes: vec![Place::Outside; grid.len()],
            coverage: Coverage::default(),
            codes: vec![0; columns],
            lines,
            grid,
        }
    }

    /// Follows the nodes of the mesh.
    pub fn update(&mut self, mesh: &PlanarMesh, bodies: &Bodies) {
        self.nodes.fill(Place::Outside);
        self.coverage = Coverage::default();
        for cell in 0..mesh.topology().cells() {
            self.find_in_cell(mesh, cell);
        }
        self.find_in_bodies(mesh, bodies);
        self.coverage.outside = self.grid.len() - self.coverage.fluid - self.coverage.solid;
    }

    /// A node on an edge is left to the first of its cells.
    fn find_in_cell(&mut self, mesh: &PlanarMesh, cell: usize) {
        let bounds = Bounds::of_cell(mesh, cell);
        let [columns, rows] = [0, 1].map(|d| self.between(d, bounds.lower[d], bounds.upper[d]));
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        let map = CellMap::new(mesh, cell);
        for row in rows {
            for column in columns.clone() {
                let place = &mut self.nodes[row * self.lines[0].len() + column];
                if *place != Place::Outside {
                    continue;
                }
                if let Some(reference) = map.invert([self.lines[0][column], self.lines[1][row]]) {
                    *place = Place::Fluid(Location { cell, reference });
                    self.coverage.fluid += 1;
                }
            }
        }
    }

    /// The lines of nodes from `lower` to `upper`, perhaps a line more.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "no less than zero"
    )]
    fn between(&self, d: usize, lower: f64, upper: f64) -> Range<usize> {
        let (start, h) = (self.grid.bounds().0[d], self.grid.spacing()[d]);
        let first = ((lower - start) / h - 1e-6).ceil().max(0.0) as usize;
        let beyond = ((upper - start) / h + 1e-6).floor() + 1.0;
        first..(beyond.max(0.0) as usize).min(self.lines[d].len())
    }

    fn find_in_bodies(&mut self, mesh: &PlanarMesh, bodies: &Bodies) {
        if bodies.is_empty() {
            return;
        }
        let rows = self.nodes.chunks_exact_mut(self.lines[0].len());
        for (row, &y) in rows.zip(&self.lines[1]) {
            bodies.on_line(mesh, y, &self.lines[0], &mut self.codes);
            for (place, code) in row.iter_mut().zip(&self.codes) {
                if let (Place::Outside, Some(body)) = (*place, code.checked_sub(1)) {
                    *place = Place::Solid(body);
                    self.coverage.solid += 1;
                }
            }
        }
    }
}
