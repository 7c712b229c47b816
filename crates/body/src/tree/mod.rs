//! Bodies and their joints, as a tree.

mod build;
mod check;
mod error;
mod order;
mod skeleton;

pub(crate) use build::Driven;
pub use error::TreeError;
pub(crate) use skeleton::{Link, Skeleton};

use crate::{BodyState, Equations, Kinematics, Point, RigidBody};
use std::sync::Arc;

/// Rigid bodies in the plane that joints hold to the ground or to each other, without loops.
///
/// Its motion is that of generalised coordinates q with velocities v = q', the coordinates of the joints in the order
/// of the bodies. A coordinate that turns a body is that body's angle, so that for the disc on the hinged bar of the
/// paper q = (theta, phi), (16)-(22). Prescribed coordinates are among them, known instead of sought. With the loads F
/// of a fluid
///
/// ```text
/// M(q) v' + C(q, v) v = f(q, v) + sum over bodies of A(q) F
/// ```
///
/// where f is of springs, dampers and gravity. All matrices are dense: meant for up to some hundred coordinates.
///
/// ```
/// use lumley_body::{RigidBody, Tree};
/// #[derive(serde::Deserialize)]
/// struct Case { bodies: Vec<RigidBody> }
/// let case: Case = toml::from_str("
///     [[bodies]]
///     name = 'bar'
///     mass = 1
///     shape = { kind = 'bar', length = 5.5 }
///     centre = [7, 2.75]
///     angle = 1.5
///     joint = { kind = 'revolute', at = [7, 0] }
///     [[bodies]]
///     name = 'disc'
///     mass = 50
///     shape = { kind = 'disc', radius = 0.5 }
///     centre = [7, 6]
///     joint = { kind = 'revolute', at = [7, 5.5], to = 'bar' }
///     boundary = 'disc'
/// ")?;
/// let tree = Tree::new(&case.bodies, [0.0, 0.0])?;
/// let names: Vec<String> = (0..2).map(|k| tree.label(k)).collect();
/// assert_eq!(names, ["bar.angle", "disc.angle"]);
/// assert_eq!(tree.start(0.0)?.position, [1.5, 0.0]);
/// assert!(!tree.is_singular());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Tree {
    skeleton: Arc<Skeleton>,
    bodies: Vec<RigidBody>,
    coordinates: Vec<Coordinate>,
    driven: Vec<Driven>,
    start: BodyState,
}

/// A generalised coordinate of a tree.
///
/// ```
/// use lumley_body::Coordinate;
/// let theta = Coordinate { body: 0, name: "angle", prescribed: false };
/// assert_eq!(theta.name, "angle");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Coordinate {
    /// The body whose joint has it.
    pub body: usize,
    /// `distance`, `x` or `y`, in m, or `angle`, in rad.
    pub name: &'static str,
    /// Whether a function of time prescribes it.
    pub prescribed: bool,
}

/// A prescribed coordinate that is not a number.
///
/// ```
/// use lumley_body::PrescribedError;
/// let error = PrescribedError { coordinate: "wing.angle".into(), time: 1.5, value: f64::NAN };
/// assert_eq!(error.to_string(), "the prescribed motion wing.angle is NaN at t = 1.5 s, expected a finite number");
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("the prescribed motion {coordinate} is {value} at t = {time} s, expected a finite number")]
pub struct PrescribedError {
    /// The body's name and the coordinate's.
    pub coordinate: String,
    /// The time, in s.
    pub time: f64,
    /// The value found, in m or rad.
    pub value: f64,
}

impl Tree {
    /// The tree of these bodies under `gravity`, in m/s².
    ///
    /// # Errors
    /// Every variant of [`TreeError`].
    pub fn new(bodies: &[RigidBody], gravity: Point) -> Result<Self, TreeError> {
        build::build(bodies, gravity)
    }

    /// The bodies, in the order in which they were given.
    pub fn bodies(&self) -> &[RigidBody] {
        &self.bodies
    }

    /// The number of the body of this name.
    pub fn body(&self, name: &str) -> Option<usize> {
        self.bodies.iter().position(|body| body.name == name)
    }

    /// The generalised coordinates.
    pub fn coordinates(&self) -> &[Coordinate] {
        &self.coordinates
    }

    /// Name of the k-th coordinate with its body's, for reports.
    pub fn label(&self, k: usize) -> String {
        let Coordinate { body, name, .. } = self.coordinates[k];
        format!("{}.{name}", self.bodies[body].name)
    }

    /// Coordinates and velocities at the start, at a time in s; prescribed ones move as they will just after it.
    ///
    /// # Errors
    /// A prescribed coordinate that is not a finite number.
    pub fn start(&self, time: f64) -> Result<BodyState, PrescribedError> {
        let mut start = self.start.clone();
        self.prescribe(time, &mut start.position)?;
        for Driven { coordinate, function } in &self.driven {
            let value = function.slope(time);
            start.velocity[*coordinate] = self.finite(*coordinate, time, value)?;
        }
        Ok(start)
    }

    /// Sets the prescribed coordinates among `q` to their values at a time in s. Allocates nothing.
    ///
    /// # Errors
    /// One that is not a finite number.
    ///
    /// # Panics
    /// If `q` is not as long as the coordinates.
    pub fn prescribe(&self, time: f64, q: &mut [f64]) -> Result<(), PrescribedError> {
        for Driven { coordinate, function } in &self.driven {
            q[*coordinate] = self.finite(*coordinate, time, function.at(time))?;
        }
        Ok(())
    }

    fn finite(&self, k: usize, time: f64, value: f64) -> Result<f64, PrescribedError> {
        let error = || PrescribedError { coordinate: self.label(k), time, value };
        value.is_finite().then_some(value).ok_or_else(error)
    }

    /// The first coordinate along which the bodies, at their start, have no inertia: only a fluid can say how
    /// they accelerate. Prescribed coordinates need none.
    pub fn massless_coordinate(&self) -> Option<usize> {
        let mut kinematics = Kinematics::new(self);
        let zeros = vec![0.0; self.coordinates.len()];
        kinematics.update(&self.start.position, &zeros, &zeros);
        let mut equations = Equations::new(self);
        equations.assemble(&kinematics, &[]);
        equations.null_coordinate()
    }

    /// Whether the bodies have a [`massless_coordinate`](Self::massless_coordinate): without fluid they must then be
    /// refused.
    pub fn is_singular(&self) -> bool {
        self.massless_coordinate().is_some()
    }

    pub(crate) fn skeleton(&self) -> &Arc<Skeleton> {
        &self.skeleton
    }
}
