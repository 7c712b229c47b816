use crate::Point;
use crate::joint::Joint;
use crate::state::BodyState;
use serde::{Deserialize, Serialize};

/// A rigid body as a case file describes it: `[[bodies]]`. Lengths and directions are those of the placement as
/// given, in which a flow has its mesh; masses are for each m of span.
///
/// ```
/// use lumley_body::RigidBody;
/// use lumley_body::joint::Joint;
/// let bar: RigidBody = toml::from_str(
///     "name = 'bar'\nmass = 1\nshape = { kind = 'bar', length = 5.5 }\ncentre = [7, 2.75]\nangle = 1.5707963
///      joint = { kind = 'revolute', at = [7, 0], spring = { stiffness = 2, rest = 1.5, damping = 0.1 } }",
/// )?;
/// assert!(matches!(bar.joint, Joint::Revolute(_)));
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RigidBody {
    /// Its name, which no other body has.
    pub name: String,
    /// Mass, in kg/m. A body that loads can move must say it, if only that it is 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass: Option<f64>,
    /// Moment of inertia about the centre, in kg m. A body that loads can turn must say this or its shape, unless
    /// it is massless.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia: Option<f64>,
    /// A uniform shape, from which the inertia follows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shape: Option<UniformShape>,
    /// Centre of mass, in m.
    pub centre: Point,
    /// Angle that the placement as given is said to have, in rad: where the coordinate of a joint that turns starts.
    #[serde(default)]
    pub angle: f64,
    /// What holds it.
    pub joint: Joint,
    /// The boundary through which a fluid acts on it; without one the body is dry.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub boundary: Option<String>,
    /// Coordinates and velocities of its joint at the start; left out, the placement as given, at rest.
    #[serde(default, skip_serializing_if = "BodyState::is_empty")]
    pub start: BodyState,
    /// The fluid that it displaces: who knows the fluid says it. The load of a flow is that of the dynamic
    /// pressure, which leaves out the buoyancy, so that gravity must bring it.
    #[serde(skip)]
    pub displaced: Option<Displaced>,
}

/// A body of uniform density, for its moment of inertia.
///
/// ```
/// use lumley_body::UniformShape;
/// assert_eq!(UniformShape::Disc { radius: 0.5 }.inertia(50.0), 6.25);
/// assert_eq!(UniformShape::Bar { length: 6.0 }.inertia(1.0), 3.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum UniformShape {
    /// `m r²/2`
    Disc {
        /// In m.
        radius: f64,
    },
    /// Thin: `m l²/12`
    Bar {
        /// In m.
        length: f64,
    },
}

impl UniformShape {
    /// Moment of inertia about the centre, in kg m, for a mass in kg/m.
    pub fn inertia(&self, mass: f64) -> f64 {
        match self {
            Self::Disc { radius } => mass * radius * radius / 2.0,
            Self::Bar { length } => mass * length * length / 12.0,
        }
    }

    pub(crate) fn size(&self) -> (&'static str, f64) {
        match *self {
            Self::Disc { radius } => ("radius", radius),
            Self::Bar { length } => ("length", length),
        }
    }
}

/// The fluid that a body displaces: with gravity, its weight is lifted off the body at its centre.
///
/// ```
/// use lumley_body::Displaced;
/// let disc = Displaced { mass: 1000.0 * std::f64::consts::PI * 0.25, centre: [0.0, 0.0] };
/// assert!((disc.mass - 785.4).abs() < 0.1);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Displaced {
    /// Density of the fluid times area, in kg/m.
    pub mass: f64,
    /// Centre of the area in the placement as given, in m.
    pub centre: Point,
}
