use super::Condition;
use super::cells::{self, Group, INTERIOR, NodalFields, Output, Terms, reference_points};
use super::constraint::Constraint;
use super::outlet::Outlet;
use super::rigid::RigidBodies;
use super::unknowns::Unknowns;
use crate::linear::CellUnknowns;
use lumley_fem::element::{Cell, P2Bubble, Q2, TriangleP2};
use lumley_fem::space::NodalSpace;
use lumley_fem::{PlanarMesh, Point};
use std::ops::Range;

/// The cells of one kind that are alike: inside, where their unknowns are those of the system, or at a boundary.
#[derive(Debug, Clone)]
enum Part {
    Triangles(Group<7, 6, 17>),
    Quadrilaterals(Group<9, 9, 21>),
}

impl Part {
    fn len(&self) -> usize {
        match self {
            Self::Triangles(group) => group.len(),
            Self::Quadrilaterals(group) => group.len(),
        }
    }

    fn rim(&self) -> usize {
        match self {
            Self::Triangles(_) => cells::rim(7),
            Self::Quadrilaterals(_) => cells::rim(9),
        }
    }
}

/// A cell at a boundary.
#[derive(Debug, Clone)]
struct RimCell {
    constraint: Constraint,
    /// Where its condensed matrix lies in `System::held`.
    held: usize,
    /// Where its reduced matrix lies in `System::matrices`.
    reduced: Range<usize>,
}

/// The linear system of a flow, cell by cell: first the triangles inside, then those at boundaries, then the
/// quadrilaterals likewise; last, as cells of their own, the bodies, which [`RigidBodies`] adds.
#[derive(Debug, Clone)]
pub(super) struct System {
    parts: [Part; 4],
    /// Cells of the mesh in the order of the system.
    order: Vec<usize>,
    /// Of the cells at boundaries, in the order of the system; `None` for those inside.
    rim_cells: Vec<Option<RimCell>>,
    /// Where the right-hand sides and recoveries of the cells begin.
    right_starts: Vec<usize>,
    recovery_starts: Vec<usize>,
    /// Reduced matrices as [`CellUnknowns`] says.
    pub matrices: Vec<f64>,
    held: Vec<f64>,
    right: Vec<f64>,
    recoveries: Vec<f64>,
    outlet: Outlet,
}

impl System {
    pub fn new(
        mesh: &PlanarMesh,
        space: &NodalSpace,
        conditions: &[Condition],
        unknowns: &Unknowns,
        rigid: &RigidBodies,
    ) -> (Self, CellUnknowns) {
        let topology = mesh.topology();
        let outlet = Outlet::new(mesh, space, conditions);
        let constraint = |cell: usize| {
            let dofs = space.dofs().cell(cell);
            Constraint::new(&dofs[..dofs.len() - 1], unknowns.pressures[cell], unknowns, rigid)
        };
        let constraints: Vec<Constraint> = (0..topology.cells()).map(constraint).collect();
        let mut at_rim: Vec<bool> = constraints.iter().map(|c| !c.is_plain()).collect();
        outlet.cells().for_each(|cell| at_rim[cell] = true);
        let triangles = 0..topology.triangles().len();
        let quadrilaterals = triangles.end..topology.cells();
        let select = |cells: &Range<usize>, rim: bool| -> Vec<usize> {
            cells.clone().filter(|&cell| at_rim[cell] == rim).collect()
        };
        let lists = [
            select(&triangles, false),
            select(&triangles, true),
            select(&quadrilaterals, false),
            select(&quadrilaterals, true),
        ];
        let parts = [
            triangles_part(mesh, space, &lists[0]),
            triangles_part(mesh, space, &lists[1]),
            quadrilaterals_part(mesh, space, &lists[2]),
            quadrilaterals_part(mesh, space, &lists[3]),
        ];
        let order = lists.concat();
        let of_cells = order.iter().map(|&cell| constraints[cell].unknowns.clone());
        let of_bodies = rigid.cells().map(|(unknowns, _)| unknowns);
        let lists: Vec<Vec<usize>> = of_cells.chain(of_bodies).collect();
        let pattern = CellUnknowns::new(unknowns.count, &lists).expect("a sound numbering");
        let mut this = Self {
            rim_cells: Vec::new(),
            right_starts: Vec::new(),
            recovery_starts: Vec::new(),
            matrices: vec![0.0; pattern.matrix_len()],
            held: Vec::new(),
            right: Vec::new(),
            recoveries: Vec::new(),
            parts,
            order,
            outlet,
        };
        let constraints = constraints.into_iter().zip(at_rim).map(|(c, rim)| rim.then_some(c));
        this.lay_out(&pattern, constraints.collect());
        (this, pattern)
    }

    fn lay_out(&mut self, pattern: &CellUnknowns, mut constraints: Vec<Option<Constraint>>) {
        let (mut held, mut right, mut recoveries) = (0, 0, 0);
        for part in &self.parts {
            for _ in 0..part.len() {
                let k = self.rim_cells.len();
                let constraint = constraints[self.order[k]].take();
                self.rim_cells.push(constraint.map(|constraint| {
                    held += part.rim() * part.rim();
                    let held = held - part.rim() * part.rim();
                    RimCell { constraint, held, reduced: pattern.matrix(k) }
                }));
                self.right_starts.push(right);
                self.recovery_starts.push(recoveries);
                right += part.rim();
                recoveries += cells::recovery(part.rim());
            }
        }
        self.right_starts.push(right);
        self.recovery_starts.push(recoveries);
        self.held = vec![0.0; held];
        self.right = vec![0.0; right];
        self.recoveries = vec![0.0; recoveries];
    }

    /// Cells of the mesh in the order of the system.
    pub fn order(&self) -> &[usize] {
        &self.order
    }

    /// Computes all matrices and right-hand sides.
    pub fn assemble(
        &mut self,
        terms: &Terms,
        fields: &NodalFields<'_>,
        directions: &[Point],
        parallel: bool,
    ) {
        let (mut inside, mut held, mut first) = (0, 0, 0);
        for (k, part) in self.parts.iter().enumerate() {
            let cells = first..first + part.len();
            first = cells.end;
            let len = part.len() * part.rim() * part.rim();
            let matrices = if k % 2 == 0 {
                &mut self.matrices[inside..][..len]
            } else {
                held += len;
                &mut self.held[held - len..held]
            };
            let right = self.right_starts[cells.start]..self.right_starts[cells.end];
            let recoveries = self.recovery_starts[cells.start]..self.recovery_starts[cells.end];
            let output = Output {
                matrices,
                right: &mut self.right[right],
                recoveries: &mut self.recoveries[recoveries],
            };
            match part {
                Part::Triangles(group) => group.assemble(terms, fields, output, parallel),
                Part::Quadrilaterals(group) => group.assemble(terms, fields, output, parallel),
            }
            let reduced = self.rim_cells[cells].iter().flatten().map(|rim| rim.reduced.len());
            inside += if k % 2 == 0 { len } else { reduced.sum() };
        }
        self.add_outlet(terms, fields);
        for rim in self.rim_cells.iter().flatten() {
            let matrix = &self.held[rim.held..];
            rim.constraint.reduce(directions, matrix, &mut self.matrices[rim.reduced.clone()]);
        }
    }

    /// What keeps fluid that comes back in at an outlet from feeding the flow.
    fn add_outlet(&mut self, terms: &Terms, fields: &NodalFields<'_>) {
        let Self { outlet, order, rim_cells, right_starts, held, right, .. } = self;
        for (k, rim) in rim_cells.iter().enumerate() {
            let Some(rim) = rim else { continue };
            let right = &mut right[right_starts[k]..right_starts[k + 1]];
            outlet.add(order[k], terms, fields, (&mut held[rim.held..], right));
        }
    }

    /// The right-hand side of the system, where `given` are the velocities that boundaries give, zero elsewhere.
    pub fn right_side(
        &self,
        space: &NodalSpace,
        pattern: &CellUnknowns,
        directions: &[Point],
        given: &[Point],
        system: &mut [f64],
    ) {
        system.fill(0.0);
        for (k, rim) in self.rim_cells.iter().enumerate() {
            let right = &self.right[self.right_starts[k]..self.right_starts[k + 1]];
            if let Some(rim) = rim {
                let mut local = [0.0; MOST_RIM];
                let local = &mut local[..right.len()];
                gather(space.dofs().cell(self.order[k]), given, local);
                let matrix = &self.held[rim.held..][..right.len() * right.len()];
                rim.constraint.add_right(directions, matrix, right, local, system);
            } else {
                for (&unknown, value) in pattern.of(k).iter().zip(right) {
                    system[unknown as usize] += value;
                }
            }
        }
    }

    /// Computes what was eliminated in the cells: the velocities inside, and all pressures.
    pub fn recover(&self, space: &NodalSpace, velocity: &mut [Point], pressure: &mut [[f64; 3]]) {
        for (k, &cell) in self.order.iter().enumerate() {
            let dofs = space.dofs().cell(cell);
            let mut local = [0.0; MOST_RIM + INTERIOR];
            let local = &mut local[..2 * dofs.len() + 3];
            let rim = local.len() - INTERIOR;
            gather(dofs, velocity, &mut local[..rim]);
            local[rim - 1] = pressure[cell][0];
            cells::recover(
                &self.recoveries[self.recovery_starts[k]..self.recovery_starts[k + 1]],
                local,
            );
            pressure[cell] = [local[rim - 1], local[rim + 1], local[rim]];
            velocity[dofs[dofs.len() - 1]] = [local[rim + 3], local[rim + 2]];
        }
    }

    /// The residuals of the momentum at the shared dofs of the cells at boundaries, for the forces there: calls
    /// `add` with each dof and what its test functions leave in a cell, in N/m.
    pub fn residuals(
        &self,
        space: &NodalSpace,
        velocity: &[Point],
        pressure: &[[f64; 3]],
        mut add: impl FnMut(usize, Point),
    ) {
        for (k, rim) in self.rim_cells.iter().enumerate() {
            let Some(RimCell { held, .. }) = rim else { continue };
            let cell = self.order[k];
            let dofs = space.dofs().cell(cell);
            let right = &self.right[self.right_starts[k]..self.right_starts[k + 1]];
            let (rim, shared) = (right.len(), dofs.len() - 1);
            let mut local = [0.0; MOST_RIM];
            let local = &mut local[..rim];
            gather(dofs, velocity, local);
            local[rim - 1] = pressure[cell][0];
            let matrix = &self.held[*held..][..rim * rim];
            let residual = |row: usize| -> f64 {
                let terms = matrix[row..].iter().step_by(rim).zip(local.iter());
                terms.map(|(a, x)| a * x).sum::<f64>() - right[row]
            };
            for (i, &dof) in dofs[..shared].iter().enumerate() {
                add(dof, [residual(i), residual(shared + i)]);
            }
        }
    }
}

fn triangles_part(mesh: &PlanarMesh, space: &NodalSpace, cells: &[usize]) -> Part {
    let (dofs, nodes) = (space.dofs().triangles::<7>(), mesh.topology().triangles());
    Part::Triangles(Group::new(
        reference_points(Cell::Triangle, &P2Bubble, &TriangleP2),
        cells.iter().map(|&cell| dofs[cell]).collect(),
        cells.iter().map(|&cell| nodes[cell]).collect(),
    ))
}

fn quadrilaterals_part(mesh: &PlanarMesh, space: &NodalSpace, cells: &[usize]) -> Part {
    let (dofs, nodes) = (space.dofs().quadrilaterals::<9>(), mesh.topology().quadrilaterals());
    let first = mesh.topology().triangles().len();
    Part::Quadrilaterals(Group::new(
        reference_points(Cell::Quadrilateral, &Q2, &Q2),
        cells.iter().map(|&cell| dofs[cell - first]).collect(),
        cells.iter().map(|&cell| nodes[cell - first]).collect(),
    ))
}

/// Most unknowns of a cell that are not eliminated in it.
const MOST_RIM: usize = cells::rim(9);

/// The vectors at the shared dofs of a cell: x components, then y components.
fn gather(dofs: &[usize], vectors: &[Point], local: &mut [f64]) {
    let shared = dofs.len() - 1;
    for (i, &dof) in dofs[..shared].iter().enumerate() {
        [local[i], local[shared + i]] = vectors[dof];
    }
}
