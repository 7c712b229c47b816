use super::{Condition, Flow, ViscousForm};
use lumley_fem::element::{Cell, P2, P2Bubble, Q2, TriangleP2};
use lumley_fem::geometry::{EdgePoint, Mapped, Tabulated};
use lumley_fem::quadrature::rule;
use lumley_fem::space::NodalSpace;
use lumley_fem::{Boundary, PlanarMesh, Point, Side};

/// Exact for the quadratic stress on a curved edge.
const DEGREE: usize = 7;

/// The quadrature of loads on edges.
pub(super) fn edge_rule() -> Vec<Tabulated<3>> {
    Tabulated::on(&P2, &rule(Cell::Interval, DEGREE))
}

/// Dofs of an edge of the rim: start, end, middle.
pub(super) fn edge_dofs(mesh: &PlanarMesh, space: &NodalSpace, edge: usize) -> [usize; 3] {
    let mut dofs = space.dofs().on_edge(mesh.topology().edges()[edge].left);
    std::array::from_fn(|_| dofs.next().expect("an edge has three dofs"))
}

/// What the fluid does to a boundary, for each metre of span.
///
/// ```
/// let load = lumley_fom::flow::Load { force: [2.0, 0.5], moment: 0.0 };
/// assert_eq!(load.coefficients(1.0, 2.0, 1.0), [1.0, 0.25]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Load {
    /// Force on the boundary, in N/m.
    pub force: Point,
    /// Moment about the pivot of a boundary that moves, else about the origin, in N m/m; positive
    /// counterclockwise.
    pub moment: f64,
}

impl Load {
    /// `2 F / (ρ U² L)` along x and y, the coefficients of drag and lift where the stream goes along x.
    ///
    /// * `density` in kg/m³, `velocity` in m/s, `length` in m
    pub fn coefficients(&self, density: f64, velocity: f64, length: f64) -> [f64; 2] {
        self.force.map(|f| 2.0 * f / (density * velocity * velocity * length))
    }

    fn add(&mut self, force: Point, arm: Point) {
        self.force = [0, 1].map(|d| self.force[d] + force[d]);
        self.moment += arm[0] * force[1] - arm[1] * force[0];
    }
}

/// A dof on boundaries that hold the velocity.
#[derive(Debug, Clone)]
pub(super) struct LoadDofs {
    /// By shared dof: its boundaries.
    boundaries: Vec<Vec<usize>>,
}

impl LoadDofs {
    pub fn new(mesh: &PlanarMesh, space: &NodalSpace, conditions: &[Condition]) -> Self {
        let mut boundaries = vec![Vec::new(); space.dofs().shared()];
        for (number, boundary) in mesh.topology().boundaries().iter().enumerate() {
            if conditions[number].holds() {
                for dof in space.dofs().on_boundary(mesh.topology(), boundary) {
                    boundaries[dof].push(number);
                }
            }
        }
        Self { boundaries }
    }
}

impl Flow {
    /// The loads by the residual of the momentum equation: what the test functions of a boundary's dofs leave is
    /// the force there, to twice the order of the velocity's gradient (Gresho et al. 1987; John and Matthies 2001,
    /// Int. J. Numer. Methods Fluids 37, 885-903). A dof where boundaries meet counts for each of them.
    pub(super) fn update_loads(&mut self) {
        let pivots = &self.pivots;
        let nodes = self.mesh.nodes();
        let (places, dofs, loads) = (&self.places, &self.load_dofs, &mut self.loads);
        loads.fill(Load::default());
        self.system.residuals(
            &self.space,
            &self.velocity[0],
            &self.pressure[0],
            |dof, residual| {
                for &boundary in &dofs.boundaries[dof] {
                    let (place, pivot) = (nodes[places.node(dof)], pivots[boundary]);
                    loads[boundary]
                        .add(residual.map(|r| -r), [place[0] - pivot[0], place[1] - pivot[1]]);
                }
            },
        );
        if self.parameters.viscous_form == ViscousForm::Laplacian {
            self.add_transposed_gradient();
        }
    }

    /// What the residual of the Laplacian form leaves out, `∫ μ ∇uᵀ n`. Along a boundary with tangent t that holds the
    /// velocity, the slope `u_t` is known and `∇·u = 0` gives the rest: `∇uᵀ n = (u_t·n) t − (u_t·t) n`.
    fn add_transposed_gradient(&mut self) {
        for (number, boundary) in self.mesh.topology().boundaries().iter().enumerate() {
            if !self.conditions[number].holds() {
                continue;
            }
            let pivot = self.pivots[number];
            for &edge in &boundary.edges {
                let nodes = self.mesh.edge(edge);
                let velocity =
                    edge_dofs(&self.mesh, &self.space, edge).map(|dof| self.velocity[0][dof]);
                for at in &self.edge_rule {
                    let EdgePoint { point, tangent, normal, .. } = EdgePoint::new(&nodes, at);
                    // The slope times the length element, which the weight has not, then.
                    let slope: Point = [0, 1].map(|d| {
                        velocity.iter().zip(&at.dphi).map(|(u, dphi)| u[d] * dphi[0]).sum()
                    });
                    let [across, along] =
                        [normal, tangent].map(|v| slope[0] * v[0] + slope[1] * v[1]);
                    let factor = -self.parameters.viscosity * at.weight;
                    let force = [0, 1].map(|d| factor * (across * tangent[d] - along * normal[d]));
                    self.loads[number].add(force, [point[0] - pivot[0], point[1] - pivot[1]]);
                }
            }
        }
    }

    /// The load on a boundary by the integral of the stress over it, paper eq. (17): a check of
    /// [`loads`](Self::loads), which are more accurate.
    pub fn surface_load(&self, boundary: &str) -> Option<Load> {
        let boundaries = self.mesh.topology().boundaries();
        let number = boundaries.iter().position(|b| b.name == boundary)?;
        Some(self.integrate_stress(&boundaries[number], self.pivots[number]))
    }

    fn integrate_stress(&self, boundary: &Boundary, pivot: Point) -> Load {
        let mut load = Load::default();
        for &edge in &boundary.edges {
            let side = self.mesh.topology().edges()[edge].left;
            let nodes = self.mesh.edge(edge);
            for at in &self.edge_rule {
                let EdgePoint { point, normal, weight, .. } = EdgePoint::new(&nodes, at);
                let stress = self.stress(side, at.reference[0]);
                // The normal points out of the fluid, into the body.
                let traction =
                    stress.map(|row| -(row[0] * normal[0] + row[1] * normal[1]) * weight);
                load.add(traction, [point[0] - pivot[0], point[1] - pivot[1]]);
            }
        }
        load
    }

    /// `−p I + μ (∇u + ∇uᵀ)` at `s` along an edge of a cell, in Pa.
    fn stress(&self, side: Side, s: f64) -> [Point; 2] {
        let cell = side.cell;
        let triangles = self.mesh.topology().triangles().len();
        let dofs = self.space.dofs().cell(cell);
        let velocity = |k: usize| self.velocity[0][dofs[k]];
        let mut gradient = [[0.0; 2]; 2];
        let mut add = |u: Point, slope: Point| {
            for c in 0..2 {
                for d in 0..2 {
                    gradient[c][d] += u[c] * slope[d];
                }
            }
        };
        let point = if cell < triangles {
            let at = Cell::Triangle.on_edge(side.edge, s);
            let mapped =
                Mapped::new(&self.mesh.triangle(cell), &Tabulated::at(&TriangleP2, at, 0.0));
            let functions = Tabulated::<7>::at(&P2Bubble, at, 0.0);
            (0..7).for_each(|k| add(velocity(k), mapped.gradient(functions.dphi[k])));
            mapped.point
        } else {
            let at = Tabulated::<9>::at(&Q2, Cell::Quadrilateral.on_edge(side.edge, s), 0.0);
            let mapped = Mapped::new(&self.mesh.quadrilateral(cell - triangles), &at);
            (0..9).for_each(|k| add(velocity(k), mapped.gradient(at.dphi[k])));
            mapped.point
        };
        let p = self.pressure_functions(cell).pressure(&self.pressure[0][cell], point);
        let viscosity = self.parameters.viscosity;
        let entry = |c: usize, d: usize| {
            viscosity * (gradient[c][d] + gradient[d][c]) - if c == d { p } else { 0.0 }
        };
        [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
    }
}
