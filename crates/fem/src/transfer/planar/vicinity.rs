use super::super::closest::Closest;
use super::PlanarFlow;
use crate::location::Bounds;
use crate::{Location, Point};

/// The nearest velocity nodes of a point of the fluid, through the fluid.
///
/// From the cell of the point, cells are entered through their edges as long as their boxes are not further
/// away than the neighbours found so far. A node beyond a thin body is not met, however near it is; where no
/// body is near, these are the nearest nodes of all.
pub(super) struct Vicinity {
    points: Vec<Point>,
    boxes: Vec<Bounds>,
    /// The search in which a cell has been met last.
    met: Vec<u64>,
    search: u64,
    queue: Vec<usize>,
    closest: Closest,
}

impl Vicinity {
    pub fn new(neighbours: usize) -> Self {
        let (points, boxes, met) = (vec![], vec![], vec![]);
        Self { points, boxes, met, search: 0, queue: vec![], closest: Closest::new(neighbours) }
    }

    /// Follows the nodes of the mesh.
    pub fn update(&mut self, flow: &PlanarFlow<'_>) {
        let cells = flow.mesh.topology().cells();
        self.points.resize(flow.space.dofs().len(), [0.0; 2]);
        flow.space.place(flow.mesh, &mut self.points);
        self.boxes.clear();
        self.boxes.extend((0..cells).map(|cell| Bounds::of_cell(flow.mesh, cell)));
        self.met.resize(cells, 0);
        self.queue.clear();
        self.queue.reserve(cells);
    }

    /// Squared distances, in m², and numbers of the nearest nodes of a point in this place, the nearest first.
    pub fn nearest(
        &mut self,
        flow: &PlanarFlow<'_>,
        at: &Location,
        point: Point,
    ) -> &[(f64, usize)] {
        self.search += 1;
        self.closest.clear();
        self.queue.clear();
        self.enter(at.cell);
        let mut next = 0;
        while let Some(&cell) = self.queue.get(next) {
            next += 1;
            if self.boxes[cell].square_distance(point) > self.closest.limit() {
                continue;
            }
            for &dof in flow.space.dofs().cell(cell) {
                let [x, y] = [0, 1].map(|d| self.points[dof][d] - point[d]);
                self.closest.insert(x * x + y * y, dof);
            }
            let topology = flow.mesh.topology();
            for edge in 0..topology.kind(cell).edges() {
                if let Some(side) = topology.neighbour(cell, edge) {
                    self.enter(side.cell);
                }
            }
        }
        self.closest.found()
    }

    fn enter(&mut self, cell: usize) {
        if self.met[cell] != self.search {
            self.met[cell] = self.search;
            self.queue.push(cell);
        }
    }
}
