use super::forcing::Forcing;
use super::instant::{Instant, Variation};
use super::magnitude::{larger, largest_magnitude};
use super::tensors::{Matrix, ReferenceTensors, Tensor, scaled, sum, times};
use crate::linear::{BorderRow, BorderedTridiagonal, CellMatrix};
use lumley_fem::LineMesh;
use std::array::from_fn;
use std::fmt;

/// The semi-discrete fluid of the piston, paper eq. (33) on the mesh `x = xi X`, divided by X:
///
/// ```text
/// R_i = ∫ φ_i u' + (1/X) ∫ φ_i (u − xi V) u_xi + (nu/X²) ∫ φ_i' u_xi − ∫ φ_i s,   xi in (0, 1)
/// ```
///
/// vanishes at every node but the interface, where it is the traction `nu u_x(X−)` over X.
pub(super) trait FluidEquations: fmt::Debug + Send + Sync {
    /// Evaluates the residual R without the source.
    fn evaluate(&mut self, at: &Instant);
    /// Subtracts the source from the residual.
    fn subtract(&mut self, source: &dyn Forcing, time: f64);
    /// Largest `|R_i|` of the nodes that are unknowns; NaN if one is.
    fn largest_residual(&self) -> f64;
    /// R at the interface.
    fn interface_residual(&self) -> f64;
    /// Smallest mass and largest viscous coefficient in a row of R at the position `interface`.
    fn scales(&self, interface: f64) -> (f64, f64);
    /// Linearises R and condenses it to the vertices; returns the last cell's matrix.
    ///
    /// The residual is condensed with it, until it is evaluated again.
    fn linearise(&mut self, at: &Instant, variation: Variation) -> CellMatrix;
    /// Solves together with the block's row and corrects.
    fn correct(&mut self, at: &mut Instant, variation: Variation, block: BorderRow);
}

/// [`FluidEquations`] on equal cells of P nodes: the two ends and, if P is 3, one inside.
#[derive(Debug)]
pub(super) struct Assembly<const P: usize> {
    viscosity: f64,
    cell_length: f64,
    nodes: Vec<f64>,
    tensors: ReferenceTensors<P>,
    system: BorderedTridiagonal,
    interior: Vec<Interior>,
}

/// The equation of a cell's interior node; once linearised, divided by its pivot.
#[derive(Debug, Clone, Copy, Default)]
struct Interior {
    residual: f64,
    vertex: [f64; 2],
    border: f64,
}

/// Tensors of a cell with their factors at one instant.
struct Factored<const P: usize> {
    mass: Matrix<P>,
    viscous: Matrix<P>,
    convection: Tensor<P>,
}

impl<const P: usize> Assembly<P> {
    pub fn new(mesh: &LineMesh, viscosity: f64) -> Self {
        let cells = mesh.cells();
        Self {
            viscosity,
            cell_length: 1.0 / cells as f64,
            nodes: mesh.uniform(0.0, 1.0),
            tensors: ReferenceTensors::new(mesh.element()),
            system: BorderedTridiagonal::new(cells),
            interior: vec![Interior::default(); cells * (P - 2)],
        }
    }

    fn factored(&self, interface: f64) -> Factored<P> {
        let viscous = self.viscosity / (interface * interface * self.cell_length);
        Factored {
            mass: scaled(self.cell_length, &self.tensors.mass),
            viscous: scaled(viscous, &self.tensors.stiffness),
            convection: self.tensors.convection.map(|matrix| scaled(1.0 / interface, &matrix)),
        }
    }
}

/// Eliminates the interior node, if there is one, from a cell's equations: what is left is the
/// vertices' matrix and, in place, their residual.
fn condense<const P: usize>(
    matrix: &Matrix<P>,
    border: &[f64; P],
    residual: &mut [f64; 2],
    interior: Option<&mut Interior>,
) -> CellMatrix {
    let mut vertex = from_fn(|i| from_fn(|j| matrix[i][j]));
    let mut by_border = [border[0], border[1]];
    if let Some(row) = interior {
        let scale = 1.0 / matrix[2][2];
        row.residual *= scale;
        row.vertex = [scale * matrix[2][0], scale * matrix[2][1]];
        row.border = scale * border[2];
        for i in 0..2 {
            let to_interior = matrix[i][2];
            vertex[i][0] -= to_interior * row.vertex[0];
            vertex[i][1] -= to_interior * row.vertex[1];
            by_border[i] -= to_interior * row.border;
            residual[i] -= to_interior * row.residual;
        }
    }
    CellMatrix { vertex, border: by_border }
}

/// The values at the nodes of each cell, in the order of the reference element.
fn cells<const P: usize>(values: &[f64], cells: usize) -> impl Iterator<Item = [f64; P]> {
    let (vertices, interior) = values.split_at(cells + 1);
    (0..cells).map(move |c| from_fn(|k| if k < 2 { vertices[c + k] } else { interior[c] }))
}

/// `u − u_0`: a derivative knows differences only, and uniform flow has none to the last bit.
fn differences<const P: usize>(u: &[f64; P]) -> [f64; P] {
    u.map(|value| value - u[0])
}

/// A matrix whose rows sum to zero, times u.
fn by_differences<const P: usize>(matrix: &Matrix<P>, du: &[f64; P]) -> [f64; P] {
    matrix.map(|row| (1..P).map(|j| row[j] * du[j]).sum())
}

/// The matrix `∫ φ_i φ_j u_xi`.
fn slope_mass<const P: usize>(convection: &Tensor<P>, du: &[f64; P]) -> Matrix<P> {
    convection.map(|matrix| by_differences(&matrix, du))
}

/// The matrix `∫ φ_i a φ_j'`, whose rows sum to zero.
fn transport<const P: usize>(convection: &Tensor<P>, a: &[f64; P]) -> Matrix<P> {
    convection.map(|matrix| {
        let mut row = [0.0; P];
        for j in 1..P {
            row[j] = (0..P).map(|k| matrix[k][j] * a[k]).sum();
            row[0] -= row[j];
        }
        row
    })
}

impl<const P: usize> FluidEquations for Assembly<P> {
    fn evaluate(&mut self, at: &Instant) {
        let Factored { mass, viscous, convection } = self.factored(at.interface);
        let (n, v) = (self.system.residuals.len(), at.velocity());
        let states = cells::<P>(&at.u, n).zip(cells(&at.rate, n)).zip(cells::<P>(&self.nodes, n));
        let mut interior = self.interior.iter_mut();
        for (residual, ((u, rate), xi)) in self.system.residuals.iter_mut().zip(states) {
            let du = differences(&u);
            let inertia = times(&mass, &rate);
            let transport = transport(&convection, &from_fn(|k| u[k] - xi[k] * v));
            let flux = by_differences(&sum(&viscous, &transport), &du);
            let r: [f64; P] = from_fn(|i| inertia[i] + flux[i]);
            *residual = [r[0], r[1]];
            if P == 3
                && let Some(row) = interior.next()
            {
                row.residual = r[2];
            }
        }
    }

    fn subtract(&mut self, source: &dyn Forcing, time: f64) {
        for (c, residual) in self.system.residuals.iter_mut().enumerate() {
            for (point, load) in &self.tensors.load {
                let xi = (c as f64 + point) * self.cell_length;
                let s = self.cell_length * source.fluid(xi, time);
                residual[0] -= s * load[0];
                residual[1] -= s * load[1];
                if P == 3 {
                    self.interior[c].residual -= s * load[2];
                }
            }
        }
    }

    fn largest_residual(&self) -> f64 {
        let rows = self.system.residuals.as_flattened();
        let (vertices, _) = rows[1..rows.len() - 1].as_chunks();
        let vertices = largest_magnitude(vertices, |[left, right]| left + right);
        larger(vertices, largest_magnitude(&self.interior, |row| row.residual))
    }

    fn interface_residual(&self) -> f64 {
        self.system.residuals[self.system.residuals.len() - 1][1]
    }

    fn scales(&self, interface: f64) -> (f64, f64) {
        let Factored { mass, viscous, .. } = self.factored(interface);
        let largest = viscous.as_flattened().iter().fold(0.0, |max, k| k.abs().max(max));
        (2.0 * mass[0].iter().sum::<f64>(), 2.0 * largest)
    }

    fn linearise(&mut self, at: &Instant, variation: Variation) -> CellMatrix {
        let Variation { rate, state } = variation;
        let (n, v) = (self.system.matrices.len(), at.velocity());
        let Factored { mass, viscous, convection } = self.factored(at.interface);
        let viscous = scaled(state, &viscous);
        let convection = convection.map(|matrix| scaled(state, &matrix));
        let linear = sum(&scaled(rate, &mass), &viscous);
        // X moves with V: what stands over X, and twice what stands over X², joins V's column.
        let by_position = variation.position() / at.interface;
        let stiffening = scaled(2.0 * by_position, &viscous);
        let states = cells::<P>(&at.u, n).zip(cells::<P>(&self.nodes, n));
        let rows = self.system.matrices.iter_mut().zip(&mut self.system.residuals);
        let mut interior = self.interior.iter_mut();
        for ((cell, residual), (u, xi)) in rows.zip(states) {
            let (a, du) = (from_fn(|k| u[k] - xi[k] * v), differences(&u));
            let slope = slope_mass(&convection, &du);
            let matrix = sum(&sum(&linear, &slope), &transport(&convection, &a));
            let convected = times(&slope, &from_fn(|k| xi[k] + by_position * a[k]));
            let stretched = by_differences(&stiffening, &du);
            let border = from_fn(|i| -convected[i] - stretched[i]);
            let row = if P == 3 { interior.next() } else { None };
            *cell = condense::<P>(&matrix, &border, residual, row);
        }
        self.system.matrices[n - 1]
    }

    fn correct(&mut self, at: &mut Instant, variation: Variation, block: BorderRow) {
        self.system.solve(block);
        let delta = self.system.solution();
        let last = delta[delta.len() - 1];
        let (u, u_interior) = at.u.split_at_mut(delta.len());
        let (rate, rate_interior) = at.rate.split_at_mut(delta.len());
        for ((u, rate), delta) in u.iter_mut().zip(rate).zip(delta) {
            *u += variation.state * delta;
            *rate += variation.rate * delta;
        }
        let interior = self.interior.iter().zip(delta.windows(2));
        for ((u, rate), (row, ends)) in u_interior.iter_mut().zip(rate_interior).zip(interior) {
            let by_ends = row.vertex[0] * ends[0] + row.vertex[1] * ends[1];
            let delta = -(row.residual + by_ends + row.border * last);
            *u += variation.state * delta;
            *rate += variation.rate * delta;
        }
        at.interface += variation.position() * last;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumley_fem::element::{P1, P2};

    /// Geometric conservation on a mesh that moves without regard to the flow: only the last cell,
    /// where the velocity goes over to the interface's, has a residual.
    fn uniform_flow_leaves_no_residual<const P: usize>(mesh: &LineMesh) {
        let mut assembly = Assembly::<P>::new(mesh, 0.2);
        let last = mesh.cells();
        for (interface, mesh_velocity) in [(0.2, 3.0), (0.9, -0.8), (1.0, 40.0)] {
            let mut u = vec![0.37; mesh.nodes()];
            u[last] = mesh_velocity;
            let rate = vec![0.0; mesh.nodes()];
            assembly.evaluate(&Instant { time: 0.0, interface, u, rate, last });
            let (end, others) = assembly.system.residuals.split_last().expect("cells");
            assert_eq!(others.as_flattened(), vec![0.0; 2 * (last - 1)]);
            assert!(end[1].abs() > 0.1);
            let inside = assembly.interior.iter().take(last - 1);
            assert!(inside.clone().all(|row| row.residual == 0.0), "interior nodes");
            assert_eq!(inside.len(), (last - 1) * (P - 2));
            assert!(assembly.interior.last().is_none_or(|row| row.residual.abs() > 0.1));
        }
    }

    #[test]
    fn uniform_flow_is_kept_on_any_moving_mesh() {
        uniform_flow_leaves_no_residual::<2>(&LineMesh::new(20, &P1));
        uniform_flow_leaves_no_residual::<3>(&LineMesh::new(20, &P2));
    }
}
