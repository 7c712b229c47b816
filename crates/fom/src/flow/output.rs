use super::{Condition, Flow, Load};
use crate::coupling::{BodyMotion, Coupling};
use lumley_body::ImplicitScheme;
use lumley_fem::element::{Cell, Q2, TriangleP2};
use lumley_fem::geometry::{Mapped, Tabulated};
use lumley_fem::quadrature::rule;
use lumley_fem::space::{LinearPressure, NodalSpace};
use lumley_fem::{PlanarMesh, Point};

/// Exact for area and centroid of a quadratic cell.
const DEGREE: usize = 5;

impl Flow {
    /// Simulated time, in s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Steps made.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// The last step, in s; none before the first.
    pub fn last_step(&self) -> Option<f64> {
        self.previous
    }

    /// Whether the mesh moves.
    pub fn moves(&self) -> bool {
        self.motion.is_some() || self.bodies.is_some()
    }

    /// The bodies, where they are and how they move now.
    pub fn bodies(&self) -> Option<&ImplicitScheme> {
        self.bodies.as_ref().map(BodyMotion::scheme)
    }

    /// With explicit coupling, about how much of their last change of velocity the bodies undo in a step because of the
    /// fluid that they take with them: near 1 (from 0.9 on for the paper's pendulum) the coupling is unstable, whatever the
    /// step. Estimated with the mass of the fluid that the bodies displace; walls and viscosity add to it.
    pub fn added_mass_share(&self) -> Option<f64> {
        let bodies = self.bodies.as_ref()?;
        (bodies.coupling() == Coupling::Explicit).then(|| bodies.added_mass_share())
    }

    /// The mesh, where it is now.
    pub fn mesh(&self) -> &PlanarMesh {
        &self.mesh
    }

    /// The space of a component of the velocity.
    pub fn space(&self) -> &NodalSpace {
        &self.space
    }

    /// The velocity at the dofs of [`space`](Self::space), in m/s.
    pub fn velocity(&self) -> &[Point] {
        &self.velocity[0]
    }

    /// The velocity of the mesh at the dofs of [`space`](Self::space), in m/s.
    pub fn mesh_velocity(&self) -> &[Point] {
        &self.mesh_velocity
    }

    /// Where the dofs of [`space`](Self::space) are, in m.
    pub fn dof_points(&self) -> &[Point] {
        &self.work.dof_points
    }

    /// The pressure, in Pa, by cell: coefficients of its [`LinearPressure`].
    pub fn pressure(&self) -> &[[f64; 3]] {
        &self.pressure[0]
    }

    /// The loads on the boundaries, in their order in the mesh, by the residual of the momentum. Zero on free and
    /// periodic ones, where no condition holds the fluid.
    pub fn loads(&self) -> &[Load] {
        &self.loads
    }

    /// Whether no boundary is free, so that the pressure is known up to a constant: its mean is set to zero.
    pub fn has_level_pressure(&self) -> bool {
        self.unknowns.pinned()
    }

    /// Number of unknowns of a step before any is eliminated: free velocities and pressures.
    pub fn unknowns(&self) -> usize {
        let cells = self.mesh.topology().cells();
        let inside = self.space.dofs().len() - self.space.dofs().shared();
        self.unknowns.count + 2 * inside + 2 * cells
    }

    /// The conditions, in the order of the mesh's boundaries.
    pub fn conditions(&self) -> &[Condition] {
        &self.conditions
    }

    /// Factorises at the next step, so that a run that goes on from a checkpoint here, and has no old factor, makes
    /// the same bits.
    pub fn forget_factor(&mut self) {
        self.solver.forget();
    }

    /// The functions of the pressure in a cell.
    pub fn pressure_functions(&self, cell: usize) -> LinearPressure {
        let mut points = [([0.0; 2], 0.0); 9];
        let count = self.quadrature_points(cell, &mut points);
        LinearPressure::centred(points[..count].iter().copied())
    }

    /// Largest number of cells that fluid crosses in a step of `dt`, in s: the Courant number, with the velocity
    /// relative to the mesh at the middle of each cell.
    pub fn courant_number(&self, dt: f64) -> f64 {
        let triangle = Tabulated::<6>::at(&TriangleP2, [1.0 / 3.0; 2], 0.0);
        let square = Tabulated::<9>::at(&Q2, [0.5; 2], 0.0);
        let topology = self.mesh.topology();
        let triangles = topology.triangles().len();
        let mut largest = 0.0_f64;
        for cell in 0..topology.cells() {
            let dofs = self.space.dofs().cell(cell);
            let middle = dofs[dofs.len() - 1];
            let wind: Point =
                [0, 1].map(|d| self.velocity[0][middle][d] - self.mesh_velocity[middle][d]);
            let mapped = match cell.checked_sub(triangles) {
                None => Mapped::new(&self.mesh.triangle(cell), &triangle),
                Some(q) => Mapped::new(&self.mesh.quadrilateral(q), &square),
            };
            let [[a, b], [c, d]] = mapped.jacobian;
            let across = (d * wind[0] - b * wind[1]).abs() + (a * wind[1] - c * wind[0]).abs();
            largest = largest.max(across / mapped.determinant);
        }
        largest * dt
    }

    /// Area of a cell, in m².
    pub(super) fn cell_area(&self, cell: usize) -> f64 {
        let mut points = [([0.0; 2], 0.0); 9];
        let count = self.quadrature_points(cell, &mut points);
        points[..count].iter().map(|(_, weight)| weight).sum()
    }

    /// Points and weights of the quadrature on a cell, in m and m²; returns how many.
    fn quadrature_points(&self, cell: usize, points: &mut [(Point, f64); 9]) -> usize {
        fn fill<const N: usize>(
            nodes: &[Point; N],
            rule: &[Tabulated<N>],
            points: &mut [(Point, f64); 9],
        ) -> usize {
            for (to, at) in points.iter_mut().zip(rule) {
                let mapped = Mapped::new(nodes, at);
                *to = (mapped.point, mapped.weight);
            }
            rule.len()
        }
        match cell.checked_sub(self.mesh.topology().triangles().len()) {
            None => fill(&self.mesh.triangle(cell), &self.area_rules.0, points),
            Some(q) => fill(&self.mesh.quadrilateral(q), &self.area_rules.1, points),
        }
    }
}

/// The quadratures of areas and centroids on triangles and squares.
pub(super) fn area_rules() -> (Vec<Tabulated<6>>, Vec<Tabulated<9>>) {
    (
        Tabulated::on(&TriangleP2, &rule(Cell::Triangle, DEGREE)),
        Tabulated::on(&Q2, &rule(Cell::Quadrilateral, DEGREE)),
    )
}
