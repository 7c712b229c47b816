use crate::kinematics::Kinematics;
use crate::planar::{dot, minus};

/// The energy of the bodies of a tree, in J for each m of span.
///
/// ```
/// use lumley_body::{Energy, Kinematics, RigidBody, Tree};
/// let block: RigidBody = toml::from_str(
///     "name = 'block'\nmass = 2\ncentre = [0, 1]
///      joint = { kind = 'prismatic', along = [0, 1], spring = { stiffness = 8 } }",
/// )?;
/// let mut kinematics = Kinematics::new(&Tree::new(&[block], [0.0, -10.0])?);
/// kinematics.update(&[0.5], &[3.0], &[0.0]);
/// let energy = Energy::of(&kinematics);
/// assert_eq!((energy.kinetic, energy.elastic, energy.weight), (9.0, 1.0, 10.0));
/// assert_eq!(energy.total(), 20.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Energy {
    /// Of the motion: `v·M v / 2`.
    pub kinetic: f64,
    /// In the springs.
    pub elastic: f64,
    /// Of gravity, less that of the fluid displaced; 0 in the placement as given.
    pub weight: f64,
}

impl Energy {
    /// Of bodies that are and move as `kinematics` says.
    pub fn of(kinematics: &Kinematics) -> Self {
        let skeleton = kinematics.skeleton();
        let mut energy = Self::default();
        for (body, link) in skeleton.links.iter().enumerate() {
            let velocity = kinematics.velocity(body, link.centre);
            let turning = link.inertia * kinematics.spin(body).powi(2);
            energy.kinetic += 0.5 * (link.mass * dot(velocity, velocity) + turning);
            let placement = kinematics.placement(body);
            let height = |at| dot(skeleton.gravity, minus(placement.place(at), at));
            energy.weight -= link.mass * height(link.centre);
            energy.weight += link.displaced.map_or(0.0, |fluid| fluid.mass * height(fluid.centre));
        }
        for support in &skeleton.springs {
            energy.elastic += support.spring.energy(support.length(kinematics));
        }
        energy
    }

    /// All of it.
    pub fn total(&self) -> f64 {
        self.kinetic + self.elastic + self.weight
    }
}
