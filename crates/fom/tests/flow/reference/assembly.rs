//! The matrix and the right-hand side of all test functions and all unknowns, no condition applied.

use super::conditions::along;
use super::plain::{Instant, Plain};
use faer::sparse::Triplet;
use lumley_fem::element::{Cell, Element, Q2, TriangleP2};
use lumley_fem::geometry::{EdgePoint, Mapped, Tabulated};
use lumley_fem::quadrature::rule;
use lumley_fem::{Boundary, PlanarMesh, Point};
use lumley_fom::flow::{Condition, Linearisation, ViscousForm};

/// The degree of the flow's own quadrature; on curved cells another one gives another discretisation.
const DEGREE: usize = 5;

/// The fields that a linear system is made of, by velocity dof.
pub struct Fields {
    /// About which the convection is linearised.
    pub base: Vec<Point>,
    pub mesh_velocity: Vec<Point>,
    /// The force per mass less what is known of the rate.
    pub source: Vec<Point>,
    /// Weight of the new velocity in its rate, per s.
    pub rate: f64,
}

/// `A x = b`; the momentum along x and y of dof k has the numbers 2 k and 2 k + 1, then come three
/// pressures a cell: the coefficients of 1, x and y.
pub struct Equations {
    pub entries: Vec<Triplet<usize, usize, f64>>,
    pub right: Vec<f64>,
}

/// A point of the quadrature in a cell.
struct CellPoint {
    at: Point,
    weight: f64,
    phi: Vec<f64>,
    slopes: Vec<Point>,
}

impl CellPoint {
    /// `∂u_c/∂x_d`
    fn gradient(&self, field: &[Point], dofs: &[usize]) -> [Point; 2] {
        let entry = |c: usize, d: usize| {
            dofs.iter().zip(&self.slopes).map(|(&dof, slope)| field[dof][c] * slope[d]).sum()
        };
        [0, 1].map(|c| [0, 1].map(|d| entry(c, d)))
    }
}

fn points<const G: usize>(
    nodes: &[Point; G],
    (kind, geometry): (Cell, &dyn Element),
    velocity: &dyn Element,
) -> Vec<CellPoint> {
    let functions = velocity.layout().nodes();
    let point = |(place, weight)| {
        let mapped = Mapped::new(nodes, &Tabulated::at(geometry, place, weight));
        let (mut phi, mut slopes) = (vec![0.0; functions], vec![[0.0; 2]; functions]);
        velocity.tabulate(place, &mut phi, &mut slopes);
        let slopes = slopes.into_iter().map(|slope| mapped.gradient(slope)).collect();
        CellPoint { at: mapped.point, weight: mapped.weight, phi, slopes }
    };
    rule(kind, DEGREE).into_iter().map(point).collect()
}

impl Plain {
    fn cell_points(&self, mesh: &PlanarMesh, cell: usize) -> Vec<CellPoint> {
        let kind = mesh.topology().kind(cell);
        let velocity = self.space.element(kind);
        match cell.checked_sub(mesh.topology().triangles().len()) {
            None => points(&mesh.triangle(cell), (kind, &TriangleP2), velocity),
            Some(q) => points(&mesh.quadrilateral(q), (kind, &Q2), velocity),
        }
    }

    /// `∫ (1, x, y)` over a cell.
    pub fn moments(&self, mesh: &PlanarMesh, cell: usize) -> [f64; 3] {
        let points = self.cell_points(mesh, cell);
        let moment = |f: &dyn Fn(Point) -> f64| points.iter().map(|p| p.weight * f(p.at)).sum();
        [moment(&|_| 1.0), moment(&|p| p[0]), moment(&|p| p[1])]
    }

    /// The linearised equations on the mesh of `now`.
    pub fn equations(&self, now: &Instant, fields: &Fields) -> Equations {
        let pressures = 2 * self.space.dofs().len();
        let cells = now.mesh.topology().cells();
        let mut equations =
            Equations { entries: Vec::new(), right: vec![0.0; pressures + 3 * cells] };
        for cell in 0..cells {
            let dofs = self.space.dofs().cell(cell);
            for point in self.cell_points(&now.mesh, cell) {
                self.add_momentum(&mut equations, dofs, &point, fields);
                equations.add_pressure(dofs, &point, pressures + 3 * cell);
            }
        }
        for (boundary, condition) in now.mesh.topology().boundaries().iter().zip(&self.conditions) {
            if matches!(condition, Condition::TractionFree) {
                self.add_outlet(&mut equations, now, boundary, fields);
            }
        }
        equations
    }

    /// `∫ ρ (c u + (a·∇) u) v + μ ∇u : ∇v` with the wind a, what Newton's method and the stress form add, and the
    /// right-hand side.
    fn add_momentum(
        &self,
        equations: &mut Equations,
        dofs: &[usize],
        point: &CellPoint,
        fields: &Fields,
    ) {
        let CellPoint { weight, phi, slopes, .. } = point;
        let (rho, mu) = (self.parameters.density * weight, self.parameters.viscosity * weight);
        let tangent = self.parameters.linearisation != Linearisation::Extrapolation;
        let stress = self.parameters.viscous_form == ViscousForm::Stress;
        let wind = fields.wind(dofs, phi);
        let base = sum(&fields.base, dofs, phi);
        let source = sum(&fields.source, dofs, phi);
        let gradient = point.gradient(&fields.base, dofs);
        equations.add_blocks(dofs, |[i, j], [c, d]| {
            let mut entry = 0.0;
            if c == d {
                let carried = fields.rate * phi[j] + dot(wind, slopes[j]);
                entry += rho * phi[i] * carried + mu * dot(slopes[i], slopes[j]);
            }
            if stress {
                entry += mu * slopes[j][c] * slopes[i][d]; // ∂_c u_d ∂_d v_c
            }
            if tangent {
                entry += rho * phi[i] * phi[j] * gradient[c][d]; // u_d ∂_d u*_c v_c
            }
            entry
        });
        equations.add_right(dofs, |i, c| {
            let twice = if tangent { dot(base, gradient[c]) } else { 0.0 };
            rho * phi[i] * (source[c] + twice)
        });
    }

    /// `−∫ ρ (a·n)₋ u·v / 2` with the wind a, and its derivative where Newton's method must converge.
    fn add_outlet(
        &self,
        equations: &mut Equations,
        now: &Instant,
        boundary: &Boundary,
        fields: &Fields,
    ) {
        let newton = self.parameters.linearisation != Linearisation::Extrapolation;
        for (edge, EdgePoint { normal, weight, .. }, phi) in along(&now.mesh, boundary) {
            let side = now.mesh.topology().edges()[edge].left;
            let dofs: Vec<usize> = self.space.dofs().on_edge(side).collect();
            let base = sum(&fields.base, &dofs, &phi);
            let out = dot(fields.wind(&dofs, &phi), normal);
            let factor = -0.5 * self.parameters.density * weight;
            if out >= 0.0 {
                continue;
            }
            equations.add_blocks(&dofs, |[i, j], [c, d]| {
                let frozen = if c == d { out } else { 0.0 };
                let turning = if newton { base[c] * normal[d] } else { 0.0 };
                factor * phi[i] * phi[j] * (frozen + turning)
            });
            if newton {
                let twice = dot(base, normal);
                equations.add_right(&dofs, |i, c| factor * phi[i] * base[c] * twice);
            }
        }
    }
}

impl Fields {
    /// The velocity relative to the mesh.
    fn wind(&self, dofs: &[usize], phi: &[f64]) -> Point {
        let (base, mesh) = (sum(&self.base, dofs, phi), sum(&self.mesh_velocity, dofs, phi));
        [base[0] - mesh[0], base[1] - mesh[1]]
    }
}

impl Equations {
    /// Adds an entry for each test function i and component c, each unknown j and component d.
    fn add_blocks(&mut self, dofs: &[usize], entry: impl Fn([usize; 2], [usize; 2]) -> f64) {
        for (i, &row) in dofs.iter().enumerate() {
            for (j, &column) in dofs.iter().enumerate() {
                for [c, d] in [[0, 0], [0, 1], [1, 0], [1, 1]] {
                    self.add(2 * row + c, 2 * column + d, entry([i, j], [c, d]));
                }
            }
        }
    }

    fn add_right(&mut self, dofs: &[usize], value: impl Fn(usize, usize) -> f64) {
        for (i, &row) in dofs.iter().enumerate() {
            for c in 0..2 {
                self.right[2 * row + c] += value(i, c);
            }
        }
    }

    fn add(&mut self, row: usize, column: usize, entry: f64) {
        self.entries.push(Triplet::new(row, column, entry));
    }

    /// `−p ∇·v` and `q ∇·u`
    fn add_pressure(&mut self, dofs: &[usize], point: &CellPoint, first: usize) {
        for (k, q) in [1.0, point.at[0], point.at[1]].into_iter().enumerate() {
            for (&dof, slope) in dofs.iter().zip(&point.slopes) {
                for (c, slope) in slope.iter().enumerate() {
                    let entry = point.weight * q * slope;
                    self.add(2 * dof + c, first + k, -entry);
                    self.add(first + k, 2 * dof + c, entry);
                }
            }
        }
    }
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn sum(field: &[Point], dofs: &[usize], weights: &[f64]) -> Point {
    [0, 1].map(|c| dofs.iter().zip(weights).map(|(&dof, w)| field[dof][c] * w).sum())
}
