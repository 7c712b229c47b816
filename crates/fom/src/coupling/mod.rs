//! Rigid bodies and the flow round them: paper section 3.5 and, by default, better.

mod added_mass;
mod body_motion;
mod collision;
mod wet;

pub(crate) use body_motion::BodyMotion;

use crate::motion::MotionParameters;
use lumley_body::{RigidBody, Tree};
use lumley_fem::Point;
use serde::{Deserialize, Serialize};

/// How flow and bodies find their common motion in a step.
///
/// ```
/// use lumley_fom::coupling::Coupling;
/// assert_eq!(Coupling::default(), Coupling::Monolithic);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Coupling {
    /// The bodies' velocities are unknowns of the flow's linear system: at a boundary the fluid has the velocity
    /// `A(q)ᵀ q'` of (23), and the rows of its momentum, added up with the same weights, are the load in (16). Stable
    /// for bodies of any mass, also of none. The mesh stands where the bodies are foreseen to the order of the scheme;
    /// a step that finds them elsewhere is made again there.
    #[default]
    Monolithic,
    /// The five stages of the paper's section 3.5 (Abouri et al. 2004): the bodies feel the load of the step before.
    /// Unstable for bodies that are light against the fluid they displace, whatever the step
    /// ([`Flow::added_mass_share`](crate::flow::Flow::added_mass_share)).
    Explicit,
}

impl Coupling {
    /// About the share of the added mass in the inertia of the bodies
    /// ([`Flow::added_mass_share`](crate::flow::Flow::added_mass_share)) from which explicit coupling is unstable, whatever
    /// the step: measured with the paper's pendulum, and by either time scheme.
    pub const EXPLICIT_LIMIT: f64 = 0.9;

    /// The first coordinate along which the bodies have no inertia of their own and, with the monolithic coupling, the
    /// fluid at their boundaries adds none: nothing says how it accelerates.
    ///
    /// # Panics
    /// Never: masses alone are changed, to what a mass may be.
    pub fn massless_coordinate(self, tree: &Tree) -> Option<usize> {
        match self {
            Self::Explicit => tree.massless_coordinate(),
            Self::Monolithic => in_fluid(tree).massless_coordinate(),
        }
    }
}

/// The same bodies, those with a boundary as heavy as the heaviest of all: what the fluid adds to them has full rank.
fn in_fluid(tree: &Tree) -> Tree {
    let mut bodies = tree.bodies().to_vec();
    let mass = bodies.iter().filter_map(|body| body.mass).fold(0.0, f64::max);
    let mass = if mass > 0.0 { mass } else { 1.0 };
    for body in bodies.iter_mut().filter(|body| body.boundary.is_some()) {
        (body.mass, body.inertia, body.shape) = (Some(mass), Some(mass), None);
    }
    Tree::new(&bodies, [0.0; 2]).expect("masses alone were changed, to what a mass may be")
}

/// The bodies in a flow.
///
/// ```
/// use lumley_fom::coupling::BodySetup;
/// use lumley_body::RigidBody;
/// let cylinder: RigidBody = toml::from_str(
///     "name = 'cylinder'\nmass = 2.5\ncentre = [0, 0]\nboundary = 'cylinder'
///      joint = { kind = 'prismatic', along = [0, 1], spring = { stiffness = 2.37 } }",
/// )?;
/// let setup = BodySetup { bodies: vec![cylinder], ..BodySetup::default() };
/// assert_eq!(setup.gravity, [0.0, 0.0]);
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct BodySetup {
    /// The bodies, whose boundaries are whole outlines in the mesh, without slip. The fluid that they displace is found
    /// from these.
    pub bodies: Vec<RigidBody>,
    /// In m/s². The pressure of the flow is the dynamic one, so that bodies feel their weight less that of the fluid
    /// which they displace; the flow itself feels nothing.
    pub gravity: Point,
    /// How flow and bodies find their common motion.
    pub coupling: Coupling,
    /// How the mesh follows.
    pub mesh: MotionParameters,
}
