use crate::kinematics::Kinematics;
use crate::planar::{dot, times};
use crate::{Point, Square, Tree};

/// A force and a moment on a body, for each m of span, that do not depend on how it moves.
///
/// ```
/// use lumley_body::Load;
/// let drag = Load { body: 0, at: [0.0, 0.0], force: [0.7, 0.0], moment: 0.0 };
/// assert_eq!(drag.force, [0.7, 0.0]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load {
    /// Number of the body.
    pub body: usize,
    /// The body's point on which the force acts, in the placement as given, in m.
    pub at: Point,
    /// In N/m.
    pub force: Point,
    /// About that point, in N.
    pub moment: f64,
}

/// The equations of motion of a tree, (16), as a residual with its derivatives:
///
/// ```text
/// r(q, v, a) = M(q) a + C(q, v) v − f(q, v) − sum over loads of A(q) F
/// ```
///
/// r = 0 is the motion. M is [`mass`](Self::mass), dr/dv is [`by_velocity`](Self::by_velocity) and dr/dq is
/// [`by_position`](Self::by_position), both complete, so that an implicit scheme with `v' = c v + known`,
/// `q' = c q + known` has the tangent `c M + dr/dv + (1/c) dr/dq` by the new velocities. Rows of prescribed coordinates
/// give the load that the prescription takes. After [`new`](Self::new) nothing here allocates.
///
/// ```
/// use lumley_body::{Equations, Kinematics, RigidBody, Tree};
/// let block: RigidBody = toml::from_str(
///     "name = 'block'\nmass = 2\ncentre = [0, 0]
///      joint = { kind = 'prismatic', along = [1, 0], spring = { stiffness = 8, damping = 0.5 } }",
/// )?;
/// let tree = Tree::new(&[block], [0.0, 0.0])?;
/// let (mut kinematics, mut equations) = (Kinematics::new(&tree), Equations::new(&tree));
/// kinematics.update(&[0.1], &[2.0], &[3.0]);
/// equations.assemble(&kinematics, &[]);
/// assert!((equations.residual()[0] - (2.0 * 3.0 + 8.0 * 0.1 + 0.5 * 2.0)).abs() < 1e-15);
/// assert_eq!(equations.mass()[(0, 0)], 2.0);
/// assert_eq!((equations.by_position()[(0, 0)], equations.by_velocity()[(0, 0)]), (8.0, 0.5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Equations {
    residual: Vec<f64>,
    magnitude: Vec<f64>,
    mass: Square,
    by_velocity: Square,
    by_position: Square,
    prescribed: Vec<bool>,
}

impl Equations {
    /// For the bodies of a tree.
    pub fn new(tree: &Tree) -> Self {
        let prescribed: Vec<bool> = tree.coordinates().iter().map(|c| c.prescribed).collect();
        let n = prescribed.len();
        Self {
            residual: vec![0.0; n],
            magnitude: vec![0.0; n],
            mass: Square::zeros(n),
            by_velocity: Square::zeros(n),
            by_position: Square::zeros(n),
            prescribed,
        }
    }

    /// Assembles them for bodies that move as `kinematics` says, under these loads.
    pub fn assemble(&mut self, kinematics: &Kinematics, loads: &[Load]) {
        self.residual.fill(0.0);
        self.magnitude.fill(0.0);
        for matrix in [&mut self.mass, &mut self.by_velocity, &mut self.by_position] {
            matrix.clear();
        }
        let skeleton = kinematics.skeleton();
        for (body, link) in skeleton.links.iter().enumerate() {
            self.add_inertia(kinematics, body);
            let weight = times(link.mass, skeleton.gravity);
            self.add_load(kinematics, &Load { body, at: link.centre, force: weight, moment: 0.0 });
            if let Some(displaced) = link.displaced {
                let force = times(-displaced.mass, skeleton.gravity);
                let lift = Load { body, at: displaced.centre, force, moment: 0.0 };
                self.add_load(kinematics, &lift);
            }
        }
        self.add_springs(kinematics);
        for load in loads {
            self.add_load(kinematics, load);
        }
    }

    /// `M a + C v` of a body with its derivatives: the power of the inertia of its mass and turning.
    fn add_inertia(&mut self, kinematics: &Kinematics, body: usize) {
        let centre = kinematics.skeleton().links[body].centre;
        let (link, frame, arm) = kinematics.at(body, centre);
        let (mass, inertia) = (link.mass, link.inertia);
        let force = times(mass, frame.acceleration(arm));
        for (i, &row) in link.path.iter().enumerate() {
            let power = frame.power(i, arm, force, inertia * frame.spin_rate);
            self.residual[row] += power;
            self.magnitude[row] += power.abs();
            let momentum = times(mass, frame.jacobian(i, arm));
            for (j, &column) in link.path.iter().enumerate() {
                let turning = inertia * frame.turn_by(i);
                self.mass[(row, column)] += frame.power(j, arm, momentum, turning);
                let by_velocity = frame.acceleration_by_velocity(j, arm);
                self.by_velocity[(row, column)] += dot(momentum, by_velocity);
                let by_position = frame.acceleration_by_position(j, arm);
                self.by_position[(row, column)] +=
                    dot(momentum, by_position) + dot(frame.second(i, j, arm), force);
            }
        }
    }

    fn add_load(&mut self, kinematics: &Kinematics, load: &Load) {
        let (link, frame, arm) = kinematics.at(load.body, load.at);
        for (i, &row) in link.path.iter().enumerate() {
            let power = frame.power(i, arm, load.force, load.moment);
            self.residual[row] -= power;
            self.magnitude[row] += power.abs();
            for (j, &column) in link.path.iter().enumerate() {
                self.by_position[(row, column)] -= dot(frame.second(i, j, arm), load.force);
            }
        }
    }

    fn add_springs(&mut self, kinematics: &Kinematics) {
        let skeleton = kinematics.skeleton();
        for support in &skeleton.springs {
            let elongation = skeleton.elongation(support);
            let length = support.length(kinematics);
            let rate: f64 = elongation.clone().map(|(k, w)| w * kinematics.velocity[k]).sum();
            let force = support.spring.force(length, rate);
            for (row, w) in elongation.clone() {
                self.residual[row] -= w * force;
                self.magnitude[row] += support.spring.magnitude(length, rate);
                for (column, x) in elongation.clone() {
                    self.by_position[(row, column)] += w * x * support.spring.stiffness;
                    self.by_velocity[(row, column)] += w * x * support.spring.damping;
                }
            }
        }
    }

    /// The residual r, in N/m for a coordinate in m and in N for one in rad.
    pub fn residual(&self) -> &[f64] {
        &self.residual
    }

    /// The sums of the magnitudes of the terms that the residual is the sum of: against it, the residual is round-off
    /// or not.
    pub fn magnitude(&self) -> &[f64] {
        &self.magnitude
    }

    /// The mass matrix M(q): symmetric, in kg/m, kg or kg m.
    pub fn mass(&self) -> &Square {
        &self.mass
    }

    /// dr/dv = 2 C(q, v) − df/dv, where C is the matrix for which `M' − 2 C` is skew, (16).
    pub fn by_velocity(&self) -> &Square {
        &self.by_velocity
    }

    /// dr/dq at fixed v and a.
    pub fn by_position(&self) -> &Square {
        &self.by_position
    }

    /// Sets `tangent` to `c M + dr/dv + (1/c) dr/dq`, the derivative of the residual by the new velocities for rates
    /// `c y + known`, c in 1/s; rows of prescribed coordinates become those of the unit matrix.
    ///
    /// # Panics
    /// If `tangent` has another size than the coordinates.
    pub fn tangent(&self, c: f64, tangent: &mut Square) {
        let n = self.residual.len();
        assert_eq!(tangent.size(), n, "one row for each coordinate");
        for i in 0..n {
            if self.prescribed[i] {
                tangent.unit_row(i);
                continue;
            }
            for j in 0..n {
                tangent[(i, j)] =
                    c * self.mass[(i, j)] + self.by_velocity[(i, j)] + self.by_position[(i, j)] / c;
            }
        }
    }

    /// The first coordinate along which there is no inertia, prescribed ones left out.
    pub(crate) fn null_coordinate(&self) -> Option<usize> {
        let free: Vec<usize> =
            (0..self.prescribed.len()).filter(|&k| !self.prescribed[k]).collect();
        let mut mass = Square::zeros(free.len());
        for (i, &row) in free.iter().enumerate() {
            for (j, &column) in free.iter().enumerate() {
                mass[(i, j)] = self.mass[(row, column)];
            }
        }
        mass.null_row().map(|row| free[row])
    }
}
