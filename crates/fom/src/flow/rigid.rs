use super::cells::Terms;
use super::unknowns::NodeUnknowns;
use crate::coupling::{BodyMotion, Coupling};
use crate::disjoint_sets::DisjointSets;
use crate::linear::CellUnknowns;
use lumley_body::{ImplicitScheme, Square};
use lumley_fem::space::NodalSpace;
use lumley_fem::{PlanarMesh, Point};

/// Bodies whose velocities are unknowns of the flow's system, but for prescribed ones, (16) and (23): at a dof on the boundary of
/// a body
///
/// ```text
/// u = sum over the coordinates that move it of J_k v_k.
/// ```
///
/// The same J, transposed, adds up what the momentum leaves at the dofs to the generalised load: the rows of (16) stand
/// in the system with the load that the flow has at the new instant. They are linearised about the trial of the bodies.
///
/// The unknowns are what is missing in the velocities of the trial, over a scale that makes the diagonals of their rows
/// like those of the fluid: the residual of the system is one number, and the momentum of a heavy body would drown that
/// of the fluid in it.
#[derive(Debug, Clone, Default)]
pub(super) struct RigidBodies {
    /// By coordinate: its unknown; none if it is prescribed.
    unknowns: Vec<Option<usize>>,
    /// Coordinates that move each other, none of them prescribed: each group is a cell of the system.
    groups: Vec<Group>,
    dofs: Vec<RigidDof>,
    /// What the dofs of a body have in common.
    bodies: Vec<WetBody>,
    /// By coordinate.
    scales: Vec<f64>,
    tangent: Option<Square>,
    /// Of (16), without the load.
    residual: Vec<f64>,
    /// A dof's part of the area, in m².
    share: f64,
    /// Directions of all dofs.
    directions: usize,
}

#[derive(Debug, Clone)]
struct Group {
    coordinates: Vec<usize>,
    centre: Point,
}

#[derive(Debug, Clone)]
struct RigidDof {
    dof: usize,
    /// Number among the wet bodies.
    body: usize,
    /// Where it is in the placement as given, in m.
    point: Point,
}

#[derive(Debug, Clone)]
struct WetBody {
    body: usize,
    boundary: usize,
    /// Of the body, in m².
    area: f64,
    /// Coordinates that move it.
    path: Vec<usize>,
}

impl RigidBodies {
    /// The bodies of monolithic coupling; none with the explicit one, whose walls are given.
    pub fn new(bodies: Option<&BodyMotion>, mesh: &PlanarMesh, space: &NodalSpace) -> Self {
        let monolithic = |bodies: &&BodyMotion| bodies.coupling() == Coupling::Monolithic;
        let Some(bodies) = bodies.filter(monolithic) else { return Self::default() };
        let scheme = bodies.scheme();
        let wet: Vec<WetBody> = bodies
            .boundaries()
            .zip(bodies.areas())
            .map(|([body, boundary], area)| {
                let path = scheme.kinematics().path(body).to_vec();
                WetBody { body, boundary, area, path }
            })
            .collect();
        let mut dofs = Vec::new();
        let points = space.points(mesh);
        for (number, WetBody { boundary, .. }) in wet.iter().enumerate() {
            let boundary = &mesh.topology().boundaries()[*boundary];
            let own = space.dofs().on_boundary(mesh.topology(), boundary);
            dofs.extend(own.into_iter().map(|dof| RigidDof {
                dof,
                body: number,
                point: points[dof],
            }));
        }
        let n = scheme.tree().coordinates().len();
        Self {
            unknowns: unknowns(scheme),
            groups: groups(scheme),
            directions: dofs.iter().map(|dof| wet[dof.body].path.len()).sum(),
            dofs,
            bodies: wet,
            scales: vec![1.0; n],
            tangent: Some(Square::zeros(n)),
            residual: vec![0.0; n],
            share: share(mesh),
        }
    }

    /// Number of unknowns, which are the first of the system.
    pub fn count(&self) -> usize {
        self.unknowns.iter().flatten().count()
    }

    /// Number of directions.
    pub fn directions(&self) -> usize {
        self.directions
    }

    /// The dofs with what is unknown at them, where directions are counted from `first`.
    pub fn nodes(&self, first: usize) -> impl Iterator<Item = (usize, NodeUnknowns)> + '_ {
        self.dofs.iter().scan(first, |next, dof| {
            let first = *next;
            *next += self.bodies[dof.body].path.len();
            Some((dof.dof, NodeUnknowns::Rigid { body: dof.body, first }))
        })
    }

    /// The unknowns that move a wet body, each with the number of its direction at a dof.
    pub fn columns(&self, body: usize) -> impl Iterator<Item = (usize, usize)> + '_ {
        let path = self.bodies[body].path.iter().enumerate();
        path.filter_map(|(direction, &k)| Some((self.unknowns[k]?, direction)))
    }

    /// The unknowns of each group, and where it is.
    pub fn cells(&self) -> impl Iterator<Item = (Vec<usize>, Point)> + '_ {
        self.groups.iter().map(|group| {
            let unknowns = group.coordinates.iter().filter_map(|&k| self.unknowns[k]);
            (unknowns.collect(), group.centre)
        })
    }

    /// Linearises about the trial, and computes the directions. In a steady flow the bodies are held.
    pub fn linearise(&mut self, scheme: &ImplicitScheme, terms: &Terms, directions: &mut [Point]) {
        let Some(tangent) = &mut self.tangent else { return };
        directions.fill([0.0; 2]);
        self.scales.fill(1.0);
        self.residual.fill(0.0);
        if terms.rate == 0.0 {
            (0..tangent.size()).for_each(|k| tangent.unit_row(k));
            return;
        }
        scheme.equations().tangent(terms.rate, tangent);
        self.residual.copy_from_slice(scheme.equations().residual());
        if !terms.stress {
            self.add_couples(scheme, terms.viscosity);
        }
        self.set_directions(scheme, terms, directions);
    }

    /// Without the stress the weak form leaves out `∫ μ ∇uᵀ n` on a body, which is a couple of `−2 μ` times its area and
    /// its spin: fluid that turns with the body has no stress, but a gradient.
    fn add_couples(&mut self, scheme: &ImplicitScheme, viscosity: f64) {
        let kinematics = scheme.kinematics();
        let tangent = self.tangent.as_mut().expect("there are bodies");
        for WetBody { body, area, .. } in &self.bodies {
            let couple = 2.0 * viscosity * area;
            for row in kinematics.jacobian(*body, [0.0; 2]) {
                self.residual[row.coordinate] += couple * row.spin * kinematics.spin(*body);
                for column in kinematics.jacobian(*body, [0.0; 2]) {
                    tangent[(row.coordinate, column.coordinate)] += couple * row.spin * column.spin;
                }
            }
        }
    }

    fn set_directions(&mut self, scheme: &ImplicitScheme, terms: &Terms, directions: &mut [Point]) {
        let tangent = self.tangent.as_ref().expect("there are bodies");
        let dof_mass = terms.density * terms.rate * self.share;
        for (k, scale) in self.scales.iter_mut().enumerate() {
            *scale = tangent[(k, k)].abs() / dof_mass;
        }
        let columns = self
            .dofs
            .iter()
            .flat_map(|dof| scheme.kinematics().jacobian(self.bodies[dof.body].body, dof.point));
        for (direction, column) in directions.iter_mut().zip(columns) {
            *direction = column.velocity;
            let [x, y] = column.velocity;
            self.scales[column.coordinate] += x * x + y * y;
        }
        for scale in &mut self.scales {
            *scale = if *scale > 0.0 { 1.0 / scale.sqrt() } else { 1.0 };
        }
        let paths = self.dofs.iter().flat_map(|dof| &self.bodies[dof.body].path);
        for (direction, &k) in directions.iter_mut().zip(paths) {
            *direction = direction.map(|x| self.scales[k] * x);
        }
    }

    /// Adds (16) to the system; its cells are those from `first` on.
    pub fn add(
        &self,
        pattern: &CellUnknowns,
        first: usize,
        matrices: &mut [f64],
        right: &mut [f64],
    ) {
        let Some(tangent) = &self.tangent else { return };
        for (cell, group) in (first..).zip(&self.groups) {
            let matrix = &mut matrices[pattern.matrix(cell)];
            let rows = group.coordinates.len();
            for (i, &row) in group.coordinates.iter().enumerate() {
                for (j, &column) in group.coordinates.iter().enumerate() {
                    let entry = tangent[(row, column)] * self.scales[row];
                    matrix[i + rows * j] = entry * self.scales[column];
                }
                right[pattern.of(cell)[i] as usize] -= self.scales[row] * self.residual[row];
            }
        }
    }

    /// Adds what the system has found to the velocities of the trial; prescribed ones stay.
    pub fn correct(&self, solution: &[f64], velocity: &mut [f64]) {
        let coordinates = velocity.iter_mut().zip(&self.unknowns).zip(&self.scales);
        for ((velocity, unknown), scale) in coordinates {
            if let Some(unknown) = unknown {
                *velocity += scale * solution[*unknown];
            }
        }
    }

    /// Sets the velocities that the dofs have in the trial.
    pub fn give(&self, scheme: &ImplicitScheme, given: &mut [Point]) {
        for RigidDof { dof, body, point } in &self.dofs {
            given[*dof] = scheme.kinematics().velocity(self.bodies[*body].body, *point);
        }
    }

    /// Sets those of bodies at rest.
    pub fn hold(&self, given: &mut [Point]) {
        self.dofs.iter().for_each(|rigid| given[rigid.dof] = [0.0; 2]);
    }
}

/// Numbers the coordinates that nothing prescribes.
fn unknowns(scheme: &ImplicitScheme) -> Vec<Option<usize>> {
    let mut count = 0;
    let number = |prescribed: bool| {
        count += usize::from(!prescribed);
        (!prescribed).then(|| count - 1)
    };
    scheme.tree().coordinates().iter().map(|c| c.prescribed).map(number).collect()
}

/// The coordinates that are not prescribed, those that move one body together.
fn groups(scheme: &ImplicitScheme) -> Vec<Group> {
    let (tree, kinematics) = (scheme.tree(), scheme.kinematics());
    let coordinates = tree.coordinates();
    let mut sets = DisjointSets::new(coordinates.len());
    for body in 0..tree.bodies().len() {
        for pair in kinematics.path(body).windows(2) {
            sets.join(pair[0], pair[1]);
        }
    }
    let roots: Vec<usize> = (0..coordinates.len()).map(|k| sets.root(k)).collect();
    let group = |root: usize| {
        let free = |k: &usize| roots[*k] == root && !coordinates[*k].prescribed;
        let coordinates: Vec<usize> = (0..roots.len()).filter(free).collect();
        let body = tree.coordinates()[*coordinates.last()?].body;
        Some(Group { centre: kinematics.centre(body), coordinates })
    };
    (0..roots.len()).filter(|&k| roots[k] == k).filter_map(group).collect()
}

/// About the area that belongs to a dof of the mesh, in m²: of the square round the mesh, so that it is the same for
/// all bodies in it.
fn share(mesh: &PlanarMesh) -> f64 {
    let side = |d: usize| {
        let along = mesh.nodes().iter().map(|node| node[d]);
        along.clone().fold(f64::NEG_INFINITY, f64::max) - along.fold(f64::INFINITY, f64::min)
    };
    side(0) * side(1) / mesh.nodes().len() as f64
}
