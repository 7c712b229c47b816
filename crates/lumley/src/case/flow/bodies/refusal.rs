use crate::case::CaseError;
use crate::case::ask::Ask;
use lumley_body::{RigidBody, TreeError};
use lumley_fom::motion::MotionError;

/// Why the bodies are no tree, with the line to mend.
pub(super) fn of_tree(ask: &Ask, bodies: &[RigidBody], error: TreeError) -> CaseError {
    CaseError::Bodies { place: ask.place(&key(bodies, &error)), source: Box::new(error) }
}

/// Why the mesh cannot follow so, with the line to mend.
pub(super) fn of_mesh(ask: &Ask, error: MotionError) -> CaseError {
    let key = match &error {
        MotionError::Quantity { what, .. } if what == "rigid zone" => "motion.rigid_zone",
        _ => "motion.stiffness",
    };
    CaseError::Motion { place: ask.place(key), source: Box::new(error) }
}

/// The key that is to blame.
fn key(bodies: &[RigidBody], error: &TreeError) -> String {
    let of = |body: &str, key: &str| format!("bodies.{body}.{key}");
    match error {
        TreeError::Empty => "bodies".into(),
        TreeError::Gravity(_) => "motion.gravity".into(),
        TreeError::NoName(number) => format!("bodies.{}", number - 1),
        TreeError::Twice(name) => {
            let last = bodies.iter().rposition(|body| body.name == *name);
            last.map_or("bodies".into(), |k| format!("bodies.{k}.name"))
        }
        TreeError::SharedBoundary { bodies: [_, second], .. } => of(second, "boundary"),
        TreeError::Quantity { body, what, .. } => of(body, quantity(what)),
        TreeError::Unknown { body, .. } => of(body, "joint.to"),
        TreeError::Loop(names) => of(&names[0], "joint.to"),
        TreeError::NoMass(body) => of(body, "mass"),
        TreeError::NoInertia(body) | TreeError::TwoInertias(body) => of(body, "inertia"),
        TreeError::Start { body, what, .. } => {
            of(body, if *what == "positions" { "start.position" } else { "start.velocity" })
        }
        TreeError::Formula { body, coordinate, .. } => of(body, &format!("joint.{coordinate}")),
    }
}

/// The key of a body that has a quantity.
fn quantity(what: &str) -> &'static str {
    match what {
        "mass" => "mass",
        "inertia" => "inertia",
        "angle" => "angle",
        "centre" => "centre",
        "radius" | "length" => "shape",
        what if what.contains("start") => "start",
        _ => "joint",
    }
}
