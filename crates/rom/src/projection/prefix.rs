use super::quadratic::{entries, entry_count, multiply, subtract_contraction};
use crate::ReducedError;
use crate::basis::Basis;
use crate::interface::Interfacial;

/// How far X may be from a node, over its distance from 0, to be taken for the node.
const ROUND_OFF: f64 = 4.0 * f64::EPSILON;
/// Largest memory of the tables, in bytes.
const LIMIT: usize = 1 << 30;

/// Integrals of the modes from 0 to any X on a uniform grid, in a time that the grid does not enter.
///
/// ```text
/// int_0^X Φ_n dx,   int_0^X Φ_n' Φ_m' dx,   int_0^X Φ_n Φ_m Φ_p' dx (symmetric in m, p)
/// ```
///
/// Tables hold them at every node; the cut cell between the last node and X adds an exact polynomial,
/// because modes are linear there. Contracted with the coefficients, it only needs `v_N` in that
/// cell. Equal to direct quadrature to round-off.
#[derive(Debug)]
pub(crate) struct PrefixTables {
    width: usize,
    cells: usize,
    spacing: f64,
    /// `Φ_n` at the nodes; in each table the entries of a node lie together.
    values: Vec<f64>,
    integral: Vec<f64>,
    dissipation: Vec<f64>,
    convection: Vec<f64>,
}

/// The cell that the interface cuts, and the reduced velocity in it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cut {
    cell: usize,
    /// Part of the cell that is fluid: in (0, 1] while X is inside of the grid, beyond that where it
    /// has left.
    fraction: f64,
    /// `v_N` at the left node, in m/s.
    left: f64,
    /// Growth of `v_N` to the right node, in m/s.
    rise: f64,
}

impl PrefixTables {
    /// The tables of the modes of `basis`.
    pub fn new(basis: &Basis) -> Result<Self, ReducedError> {
        let (width, nodes) = (basis.width(), basis.nodes().len());
        let numbers = nodes * (entry_count(width) + width * (width + 2));
        if numbers > LIMIT / size_of::<f64>() {
            let mebibytes = (numbers * size_of::<f64>()) >> 20;
            return Err(ReducedError::TooLarge { modes: width, nodes, mebibytes });
        }
        let cells = nodes - 1;
        let mut tables = Self {
            width,
            cells,
            spacing: basis.nodes()[cells] / cells as f64,
            values: (0..nodes).flat_map(|k| basis.row(k)).copied().collect(),
            integral: zero_row(nodes, width),
            dissipation: zero_row(nodes, width * width),
            convection: zero_row(nodes, entry_count(width)),
        };
        for cell in 0..cells {
            tables.append(cell);
        }
        Ok(tables)
    }

    /// Appends the tables of the right node of `cell`: those of the left one and the whole cell.
    fn append(&mut self, cell: usize) {
        let (n, h) = (self.width, self.spacing);
        let left = row(&self.values, cell, n).to_vec();
        let rise: Vec<f64> =
            row(&self.values, cell + 1, n).iter().zip(&left).map(|(r, l)| r - l).collect();
        grow(&mut self.integral, n, (0..n).map(|i| h * (left[i] + 0.5 * rise[i])));
        let slopes = (0..n * n).map(|k| rise[k / n] * rise[k % n] / h);
        grow(&mut self.dissipation, n * n, slopes);
        // int Φ_i (Φ_m Φ_p)' over the cell; half of it where m = p.
        let products = entries(n).map(|(i, m, p)| {
            let linear = left[m] * rise[p] + left[p] * rise[m];
            let square = rise[m] * rise[p];
            let weight = if m == p { 0.5 } else { 1.0 };
            let (l, r) = if i < n { (left[i], rise[i]) } else { (0.0, 0.0) };
            weight * (l * (linear + square) + r * (0.5 * linear + 2.0 / 3.0 * square))
        });
        grow(&mut self.convection, entry_count(n), products);
    }

    /// Finds the cut cell of `x` and fills the modes and the velocity there.
    pub fn cut(&self, x: f64, a: &[f64], at: &mut Interfacial) -> Cut {
        let (cell, fraction) = self.locate(x);
        let n = self.width;
        let (left, right) = (row(&self.values, cell, n), row(&self.values, cell + 1, n));
        let integral = row(&self.integral, cell, n);
        let mut cut = Cut { cell, fraction, left: 0.0, rise: 0.0 };
        for i in 0..n {
            let (l, rise) = (left[i], right[i] - left[i]);
            cut.left += a[i] * l;
            cut.rise += a[i] * rise;
            at.mode[i] = l + fraction * rise;
            let wet = self.spacing * fraction * (l + 0.5 * fraction * rise);
            at.solid[i] = at.whole[i] - integral[i] - wet;
        }
        at.velocity = cut.left + fraction * cut.rise;
        at.shear = cut.rise / self.spacing;
        cut
    }

    /// `int_0^L Φ_n dx`.
    pub fn whole_integral(&self) -> &[f64] {
        row(&self.integral, self.cells, self.width)
    }

    /// `out_n −= int_0^X Φ_n v v' dx`.
    pub fn subtract_convection(&self, cut: &Cut, a: &[f64], out: &mut [f64]) {
        let n = self.width;
        subtract_contraction(row(&self.convection, cut.cell, entry_count(n)), a, out);
        let (t, l, r) = (cut.fraction, cut.left, cut.rise);
        let flat = r * t * (l + 0.5 * r * t);
        let slanted = r * t * t * (0.5 * l + r * t / 3.0);
        let (left, right) = (row(&self.values, cut.cell, n), row(&self.values, cut.cell + 1, n));
        for i in 0..n {
            out[i] -= left[i] * flat + (right[i] - left[i]) * slanted;
        }
    }

    /// `out_n = int_0^X Φ_n' v' dx`.
    pub fn fluid_dissipation(&self, cut: &Cut, a: &[f64], out: &mut [f64]) {
        let n = self.width;
        multiply(row(&self.dissipation, cut.cell, n * n), a, out);
        let slope = cut.rise * cut.fraction / self.spacing;
        let (left, right) = (row(&self.values, cut.cell, n), row(&self.values, cut.cell + 1, n));
        for i in 0..n {
            out[i] += (right[i] - left[i]) * slope;
        }
    }

    /// `out_n = int_0^L Φ_n' v' dx`.
    pub fn whole_dissipation(&self, a: &[f64], out: &mut [f64]) {
        multiply(row(&self.dissipation, self.cells, self.width * self.width), a, out);
    }

    /// The cell of `x` and the place in it; a node belongs to the cell on its left, where the fluid
    /// is, even where round-off puts X beyond it. Outside of the grid the end cells go on: the caller
    /// notices that X has left the domain.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped first")]
    fn locate(&self, x: f64) -> (usize, f64) {
        let s = x / self.spacing;
        let node = s.round();
        let s = if (s - node).abs() <= ROUND_OFF * node { node } else { s };
        let cell = (s.ceil() - 1.0).clamp(0.0, (self.cells - 1) as f64) as usize;
        (cell, s - cell as f64)
    }
}

/// Entries of `node` in a table of `width` numbers a node.
fn row(table: &[f64], node: usize, width: usize) -> &[f64] {
    &table[node * width..][..width]
}

/// A table with room for all nodes that holds the zeros of the first.
fn zero_row(nodes: usize, width: usize) -> Vec<f64> {
    let mut table = Vec::with_capacity(nodes * width);
    table.resize(width, 0.0);
    table
}

/// Appends to a prefix table its last entries plus `increments`.
fn grow(table: &mut Vec<f64>, width: usize, increments: impl Iterator<Item = f64>) {
    let last = table.len() - width;
    for (k, increment) in increments.enumerate() {
        table.push(table[last + k] + increment);
    }
}

#[cfg(test)]
mod tests;
