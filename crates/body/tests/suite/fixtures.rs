//! Trees and random states.

use lumley_body::joint::{Drive, Joint, TimeFunction};
use lumley_body::{Displaced, Equations, Kinematics, Load, RateFormula, RigidBody, Tree};
use serde::Deserialize;

#[derive(Deserialize)]
struct Case {
    bodies: Vec<RigidBody>,
}

/// The bodies of a case file.
pub fn bodies(text: &str) -> Vec<RigidBody> {
    toml::from_str::<Case>(text).expect("bodies that can be read").bodies
}

/// Numbers in (−1, 1) that are the same in every run.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub fn vector(&mut self, n: usize, size: f64) -> Vec<f64> {
        (0..n).map(|_| size * self.next()).collect()
    }
}

/// BDF2 for equal steps, or implicit Euler for the first.
pub fn bdf2(dt: f64, first: bool) -> RateFormula {
    if first {
        RateFormula { new: 1.0 / dt, now: -1.0 / dt, before: 0.0 }
    } else {
        RateFormula { new: 1.5 / dt, now: -2.0 / dt, before: 0.5 / dt }
    }
}

/// Every kind of joint, springs and dampers, a body that is fixed to another, one that displaces fluid off its
/// centre of mass, one that others carry and that is given after them; and gravity at an angle.
pub fn five_bodies() -> Tree {
    let mut bodies = bodies(
        "
        [[bodies]]
        name = 'arm'
        mass = 2
        inertia = 0.3
        centre = [0.6, 0.1]
        angle = 0.2
        joint = { kind = 'revolute', at = [0.1, 0], to = 'cart', spring = { stiffness = 3, rest = 0.1, damping = 0.2 } }
        [[bodies]]
        name = 'cart'
        mass = 1.5
        centre = [-0.2, 0.1]
        joint = { kind = 'prismatic', along = [3, 1], spring = { stiffness = 5, rest = -0.1, damping = 0.3 } }
        [[bodies]]
        name = 'slider'
        mass = 0.7
        inertia = 0.05
        centre = [1.3, -0.2]
        joint = { kind = 'prismatic', along = [1, 2], to = 'arm', spring = { stiffness = 4, damping = 0.1 } }
        [[bodies]]
        name = 'disc'
        mass = 1.1
        shape = { kind = 'disc', radius = 0.4 }
        centre = [1.7, 0.1]
        joint = { kind = 'revolute', at = [1.4, 0], to = 'slider', spring = { stiffness = 1, damping = 0.4 } }
        boundary = 'disc'
        [[bodies]]
        name = 'satellite'
        mass = 0.4
        inertia = 0.02
        centre = [2.2, 0.4]
        angle = -0.3
        joint = { kind = 'free', to = 'disc', spring_x = { stiffness = 6 }, spring_angle = { stiffness = 2, rest = 0.3, damping = 0.05 } }
        ",
    );
    bodies[3].displaced = Some(Displaced { mass: 0.6, centre: [1.75, 0.15] });
    Tree::new(&bodies, [1.5, -9.0]).expect("a tree")
}

/// The five bodies with a wing that beats against the satellite and carries a tip.
pub fn with_a_wing() -> Tree {
    let five = five_bodies();
    let mut all = five.bodies().to_vec();
    all.extend(bodies(
        "
        [[bodies]]
        name = 'wing'
        mass = 0.3
        inertia = 0.01
        centre = [2.6, 0.5]
        joint = { kind = 'prescribed', at = [2.3, 0.4], to = 'satellite' }
        [[bodies]]
        name = 'tip'
        mass = 0.1
        inertia = 0
        centre = [2.9, 0.5]
        joint = { kind = 'fixed', to = 'wing' }
        ",
    ));
    if let Joint::Prescribed(wing) = &mut all[5].joint {
        wing.y = Drive::Function(TimeFunction::new(|t| 0.1 * (3.0 * t).sin()));
        wing.angle = Drive::Function(TimeFunction::new(|t| 0.5 * (3.0 * t).cos()));
    }
    Tree::new(&all, [1.5, -9.0]).expect("a tree")
}

/// Loads on the disc and on the satellite.
pub fn two_loads() -> [Load; 2] {
    [
        Load { body: 3, at: [1.9, 0.3], force: [1.2, -0.7], moment: 0.4 },
        Load { body: 4, at: [2.0, 0.5], force: [-0.3, 0.9], moment: -0.2 },
    ]
}

/// A tree with all that is computed of it.
pub struct Bench {
    pub tree: Tree,
    pub kinematics: Kinematics,
    pub equations: Equations,
}

impl Bench {
    pub fn new(tree: Tree) -> Self {
        let (kinematics, equations) = (Kinematics::new(&tree), Equations::new(&tree));
        Self { tree, kinematics, equations }
    }

    pub fn residual(&mut self, q: &[f64], v: &[f64], a: &[f64], loads: &[Load]) -> Vec<f64> {
        self.kinematics.update(q, v, a);
        self.equations.assemble(&self.kinematics, loads);
        self.equations.residual().to_vec()
    }
}
