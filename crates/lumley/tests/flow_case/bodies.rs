//! What case files of bodies mean.

use crate::{flow, with};
use lumley_body::joint::{Drive, Joint};
use lumley_fom::coupling::Coupling;

/// A disc on a hinged bar in a stream, every key of `[motion]` and `[output.probes]` written.
pub const PENDULUM: &str = r#"
[flow]
density = 1.0
viscosity = 0.01
initial = { velocity = [1, 0] }

[flow.boundaries.left]
kind = "velocity"
velocity = [1, 0]

[flow.boundaries.right]
kind = "traction-free"

[flow.boundaries.bottom]
kind = "slip"

[flow.boundaries.top]
kind = "slip"

[flow.boundaries.disc]
kind = "no-slip"

[mesh]
x = [0, 6]
y = [0, 4]
size = 0.5

[[mesh.bodies]]
name = "disc"
shape = { kind = "disc", centre = [2, 2.25], radius = 0.25 }
size = 0.2

[motion]
coupling = "explicit"
gravity = [0, -9.81]
rigid_zone = 0.1

[[bodies]]
name = "bar"
mass = 1
shape = { kind = "bar", length = 1.5 }
centre = [2, 1.25]
angle = 1.5
joint = { kind = "revolute", at = [2, 0.5] }

[[bodies]]
name = "disc"
mass = 50
inertia = 1.5
centre = [2, 2.25]
boundary = "disc"
joint = { kind = "revolute", at = [2, 2], to = "bar" }
start = { position = [0.1], velocity = [0] }

[time]
end = 1.0
step = 0.01

[output.probes]
times = [0.25, 0.5]
body = "disc"
coordinates = { theta = "bar.angle", phi = "disc.angle" }
"#;

/// The same with the body `disc` held by this joint alone, and other keys.
pub fn held(joint: &str, others: &str) -> String {
    let start = PENDULUM.find("[motion]").expect("it moves");
    let body = "[[bodies]]\nname = \"disc\"\ncentre = [2, 2.25]\nboundary = \"disc\"";
    let time = "[time]\nend = 1.0\nstep = 0.01\n";
    format!("{}{time}{body}\njoint = {{ {joint} }}\n{others}\n", &PENDULUM[..start])
}

#[test]
fn bodies_motion_and_probes_are_understood() {
    let case = flow(PENDULUM);
    let choice = case.bodies.as_ref().expect("bodies");
    let tree = &choice.tree;
    assert_eq!([tree.label(0), tree.label(1)], ["bar.angle", "disc.angle"]);
    let start = tree.start(0.0).expect("a start");
    assert_eq!((start.position, start.velocity), (vec![1.5, 0.1], vec![0.0, 0.0]));
    assert_eq!((choice.coupling, choice.gravity), (Coupling::Explicit, [0.0, -9.81]));
    assert_eq!(choice.mesh.rigid_zone, 0.1);
    let probes = choice.probes.as_ref().expect("probes");
    assert_eq!((&probes.times, probes.body), (&vec![0.25, 0.5], 1));
    assert_eq!(probes.coordinates, [("phi".to_owned(), 1), ("theta".to_owned(), 0)]);
    let setup = choice.setup();
    assert_eq!((setup.bodies.len(), setup.gravity), (2, [0.0, -9.81]));
}

/// What is written is read again as the same.
#[test]
fn kept_bodies_are_the_same() {
    let table = "kind = \"prescribed\", at = [2, 2], x = \"sin(t)\", y = 0.1, angle = { times = [0, 1], values = [0, 1] }";
    for text in [PENDULUM.to_owned(), held(table, "")] {
        let case = flow(&text);
        let again = flow(&case.kept().case);
        assert_eq!(again.file, case.file, "{}", case.kept().case);
    }
}

#[test]
fn what_prescribes_a_motion_is_a_function() {
    let joint = "kind = \"prescribed\", x = 0.1, y = \"0.1*t\", angle = { times = [0, 1], values = [0, 1] }";
    let case = flow(&held(joint, ""));
    let tree = &case.bodies.as_ref().expect("a body").tree;
    let Joint::Prescribed(joint) = &tree.bodies()[0].joint else { panic!("another joint") };
    assert!(matches!(joint.y, Drive::Function(_)), "{:?}", joint.y);
    let mut q = [0.0; 3];
    tree.prescribe(0.5, &mut q).expect("finite");
    assert_eq!(q, [0.1, 0.05, 0.5]);
}

/// No mass is asked of what the fluid gives inertia, nor of what a function moves.
#[test]
fn massless_bodies_in_the_fluid_are_right() {
    for joint in [
        "kind = \"free\"",
        "kind = \"cartesian\"",
        "kind = \"prismatic\", along = [0, 1]",
        "kind = \"revolute\", at = [2, 2.25]",
    ] {
        flow(&held(joint, "mass = 0"));
    }
    let explicit = "\n[motion]\ncoupling = \"explicit\"";
    flow(&held("kind = \"prescribed\"", explicit));
    // The massless bar moves the disc, and with it the fluid.
    let light = with(PENDULUM, "mass = 1\nshape = { kind = \"bar\", length = 1.5 }", "mass = 0");
    let light =
        with(&with(&light, "mass = 50\ninertia = 1.5", "mass = 0"), "explicit", "monolithic");
    flow(&light);
}

/// A body may start elsewhere than the mesh has it, as long as it has room.
#[test]
fn a_body_starts_away_from_where_the_mesh_has_it() {
    let case = flow(&held("kind = \"cartesian\"", "mass = 1\nstart = { position = [1, -1] }"));
    let start = case.bodies.expect("a body").tree.start(0.0).expect("a start");
    assert_eq!((start.position, start.velocity), (vec![1.0, -1.0], vec![0.0, 0.0]));
}
