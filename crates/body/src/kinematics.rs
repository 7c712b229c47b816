use crate::frame::{Frame, Rates};
use crate::planar::{Turn, dot, minus, plus};
use crate::tree::{Link, Skeleton};
use crate::{Point, Tree};
use std::sync::Arc;

/// Where the bodies of a tree are and how they move, for given coordinates, velocities and accelerations. After
/// [`new`](Self::new) nothing here allocates.
///
/// Points of bodies are named by where they are in the placement as given.
///
/// ```
/// use lumley_body::{Kinematics, RigidBody, Tree};
/// let bar: RigidBody = toml::from_str(
///     "name = 'bar'\nmass = 1\ninertia = 0.1\ncentre = [1, 0]\njoint = { kind = 'revolute', at = [0, 0] }",
/// )?;
/// let mut kinematics = Kinematics::new(&Tree::new(&[bar], [0.0, 0.0])?);
/// kinematics.update(&[std::f64::consts::FRAC_PI_2], &[3.0], &[0.0]);
/// let [x, y] = kinematics.placement(0).place([2.0, 0.0]);
/// assert!(x.abs() < 1e-15 && (y - 2.0).abs() < 1e-15);
/// let column = kinematics.jacobian(0, [2.0, 0.0]).next().expect("one coordinate");
/// assert_eq!((column.coordinate, column.spin), (0, 1.0));
/// assert!((column.velocity[0] + 2.0).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Kinematics {
    skeleton: Arc<Skeleton>,
    ground: Frame,
    frames: Vec<Frame>,
    pub(crate) position: Vec<f64>,
    pub(crate) velocity: Vec<f64>,
}

/// Where a body is: the rigid motion (23) from the placement as given, `x = X + d + (R − I)(X − pivot)`. A body that
/// has not moved is where it was to the last bit.
///
/// ```
/// use lumley_body::Placement;
/// let placement = Placement { pivot: [1.0, 0.0], translation: [0.0, 2.0], rotation: 0.0 };
/// assert_eq!(placement.place([1.5, 0.5]), [1.5, 2.5]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// The point that the joint holds, in the placement as given, in m.
    pub pivot: Point,
    /// Its displacement d, in m.
    pub translation: Point,
    /// Angle, counterclockwise, in rad; whole turns count.
    pub rotation: f64,
}

impl Placement {
    /// Where the body's point is that was at `point`, in m.
    pub fn place(&self, point: Point) -> Point {
        let turned = Turn::by(self.rotation).change(minus(point, self.pivot));
        plus(point, plus(self.translation, turned))
    }
}

/// What a unit velocity of one generalised coordinate does to a point of a body.
///
/// A row of A(q) of (16) is the velocity of the point and the spin: their power with force and moment is the
/// generalised force.
///
/// ```
/// use lumley_body::JacobianColumn;
/// let column = JacobianColumn { coordinate: 1, velocity: [-0.5, 0.0], spin: 1.0 };
/// assert_eq!(column.generalised_force([2.0, 7.0], 0.25), -0.75);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JacobianColumn {
    /// Number of the generalised coordinate.
    pub coordinate: usize,
    /// Velocity of the point, in m/s for a unit of the coordinate's velocity.
    pub velocity: Point,
    /// Spin of the body, in rad/s for a unit of the coordinate's velocity: 0 or 1.
    pub spin: f64,
}

impl JacobianColumn {
    /// Force on the coordinate by a force at the point in N/m and a moment about it in N.
    pub fn generalised_force(&self, force: Point, moment: f64) -> f64 {
        dot(self.velocity, force) + self.spin * moment
    }
}

impl Kinematics {
    /// For the bodies of a tree, all coordinates 0 until the first [`update`](Self::update).
    pub fn new(tree: &Tree) -> Self {
        let skeleton = Arc::clone(tree.skeleton());
        let frames = skeleton.links.iter().map(Frame::new).collect();
        let n = skeleton.coordinates;
        let zeros = vec![0.0; n];
        let (position, velocity) = (zeros.clone(), zeros.clone());
        let ground = Frame::default();
        let mut kinematics = Self { skeleton, ground, frames, position, velocity };
        kinematics.update(&zeros, &zeros, &zeros);
        kinematics
    }

    /// Puts the bodies where the coordinates `q` in m or rad say, with the velocities `v` and accelerations `a`.
    ///
    /// # Panics
    /// If one of them is not as long as the coordinates of the tree.
    pub fn update(&mut self, q: &[f64], v: &[f64], a: &[f64]) {
        assert_eq!(a.len(), self.position.len(), "one acceleration for each coordinate");
        self.position.copy_from_slice(q);
        self.velocity.copy_from_slice(v);
        let rates = Rates { q, v, a };
        for &body in &self.skeleton.order {
            let link = &self.skeleton.links[body];
            let mut frame = std::mem::take(&mut self.frames[body]);
            let (parent, pivot) = match link.parent {
                Some(parent) => (&self.frames[parent], self.skeleton.links[parent].pivot),
                None => (&self.ground, [0.0; 2]),
            };
            frame.update(link, parent, pivot, rates);
            self.frames[body] = frame;
        }
    }

    /// Where a body is, as the rigid motion of its boundary.
    pub fn placement(&self, body: usize) -> Placement {
        let Frame { translation, rotation, .. } = self.frames[body];
        Placement { pivot: self.skeleton.links[body].pivot, translation, rotation }
    }

    /// Centre of mass of a body, in m.
    pub fn centre(&self, body: usize) -> Point {
        self.placement(body).place(self.skeleton.links[body].centre)
    }

    /// Angle of a body in rad: that of the placement as given, and by how much it has turned since.
    pub fn angle(&self, body: usize) -> f64 {
        self.skeleton.links[body].angle + self.frames[body].rotation
    }

    /// Angular velocity of a body, in rad/s.
    pub fn spin(&self, body: usize) -> f64 {
        self.frames[body].spin
    }

    /// Velocity of a point of a body, in m/s.
    pub fn velocity(&self, body: usize, point: Point) -> Point {
        let (_, frame, arm) = self.at(body, point);
        frame.velocity(arm)
    }

    /// Acceleration of a point of a body, in m/s².
    pub fn acceleration(&self, body: usize, point: Point) -> Point {
        let (_, frame, arm) = self.at(body, point);
        frame.acceleration(arm)
    }

    /// The coordinates that move a body, those of the bodies that carry it first.
    pub fn path(&self, body: usize) -> &[usize] {
        &self.skeleton.links[body].path
    }

    /// The velocity of a point of a body is the sum of `velocity` times v over these columns, and the body's spin that
    /// of `spin` times v. One column for each coordinate of the body's [`path`](Self::path).
    pub fn jacobian(&self, body: usize, point: Point) -> impl Iterator<Item = JacobianColumn> + '_ {
        let (link, frame, arm) = self.at(body, point);
        (0..).zip(&link.path).map(move |(k, &coordinate)| JacobianColumn {
            coordinate,
            velocity: frame.jacobian(k, arm),
            spin: frame.turn_by(k),
        })
    }

    /// A point of a body with the arm from the body's pivot to it.
    pub(crate) fn at(&self, body: usize, point: Point) -> (&Link, &Frame, Point) {
        let (link, frame) = (&self.skeleton.links[body], &self.frames[body]);
        (link, frame, frame.arm(minus(point, link.pivot)))
    }

    pub(crate) fn skeleton(&self) -> &Skeleton {
        &self.skeleton
    }
}
