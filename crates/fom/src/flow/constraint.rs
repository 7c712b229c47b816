use super::rigid::RigidBodies;
use super::unknowns::{NodeUnknowns, Unknowns};
use lumley_fem::Point;

/// What one unknown of the system gives to one unknown of a cell.
#[derive(Debug, Clone, Copy)]
struct Entry {
    row: usize,
    column: usize,
    factor: Factor,
}

#[derive(Debug, Clone, Copy)]
enum Factor {
    One,
    /// A component of a direction.
    Along(usize, usize),
}

/// How the unknowns of a cell on a boundary follow from those of the system: `local = T system + given`.
#[derive(Debug, Clone)]
pub(super) struct Constraint {
    /// Unknowns of the system.
    pub unknowns: Vec<usize>,
    entries: Vec<Entry>,
    rows: usize,
}

impl Constraint {
    /// Of a cell with these shared velocity dofs and this mean pressure.
    pub fn new(
        dofs: &[usize],
        pressure: Option<usize>,
        unknowns: &Unknowns,
        rigid: &RigidBodies,
    ) -> Self {
        let shared = dofs.len();
        let mut this = Self { unknowns: Vec::new(), entries: Vec::new(), rows: 2 * shared + 1 };
        for c in 0..2 {
            for (i, &dof) in dofs.iter().enumerate() {
                let row = c * shared + i;
                match unknowns.nodes[dof] {
                    NodeUnknowns::Free(first) => this.push(row, first + c, Factor::One),
                    NodeUnknowns::Slides(slide, unknown) => {
                        this.push(row, unknown, Factor::Along(slide, c));
                    }
                    NodeUnknowns::Rigid { body, first } => {
                        for (unknown, direction) in rigid.columns(body) {
                            this.push(row, unknown, Factor::Along(first + direction, c));
                        }
                    }
                    NodeUnknowns::Held(_) => {}
                }
            }
        }
        if let Some(pressure) = pressure {
            this.push(2 * shared, pressure, Factor::One);
        }
        this
    }

    /// Whether the unknowns of the cell are unknowns of the system as they are.
    pub fn is_plain(&self) -> bool {
        let mut entries = self.entries.iter().enumerate();
        self.entries.len() == self.rows
            && entries.all(|(k, entry)| {
                entry.row == k && entry.column == k && matches!(entry.factor, Factor::One)
            })
    }

    fn push(&mut self, row: usize, unknown: usize, factor: Factor) {
        let column = self.unknowns.iter().position(|&u| u == unknown).unwrap_or_else(|| {
            self.unknowns.push(unknown);
            self.unknowns.len() - 1
        });
        self.entries.push(Entry { row, column, factor });
    }

    /// `Tᵀ A T`, both by columns.
    pub fn reduce(&self, directions: &[Point], matrix: &[f64], reduced: &mut [f64]) {
        reduced.fill(0.0);
        for right in &self.entries {
            let factor = right.factor.value(directions);
            let column = &matrix[right.row * self.rows..][..self.rows];
            let reduced = &mut reduced[right.column * self.unknowns.len()..];
            for left in &self.entries {
                reduced[left.column] += left.factor.value(directions) * column[left.row] * factor;
            }
        }
    }

    /// Adds `Tᵀ (g − A given)` to the right-hand side of the system; `given` has zeros where nothing is given.
    pub fn add_right(
        &self,
        directions: &[Point],
        matrix: &[f64],
        right: &[f64],
        given: &[f64],
        system: &mut [f64],
    ) {
        for entry in &self.entries {
            let row = matrix[entry.row..].iter().step_by(self.rows);
            let known: f64 = row.zip(given).map(|(a, u)| a * u).sum();
            let value = entry.factor.value(directions) * (right[entry.row] - known);
            system[self.unknowns[entry.column]] += value;
        }
    }
}

impl Factor {
    fn value(self, directions: &[Point]) -> f64 {
        match self {
            Self::One => 1.0,
            Self::Along(direction, c) => directions[direction][c],
        }
    }
}
