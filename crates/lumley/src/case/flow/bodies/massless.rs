use crate::case::CaseError;
use crate::case::ask::Ask;
use lumley_body::{RigidBody, Tree};
use lumley_fom::coupling::Coupling;

/// Refuses bodies of which nothing says how they accelerate: neither their mass nor, with the monolithic coupling, the
/// fluid.
pub(super) fn check(ask: &Ask, tree: &Tree, coupling: Coupling) -> Result<(), CaseError> {
    let (found, expected) = match coupling {
        Coupling::Explicit => (
            tree.massless_coordinate(),
            "some inertia along each coordinate: the explicit coupling has no other; take coupling = \"monolithic\"",
        ),
        Coupling::Monolithic => (
            in_fluid(tree).massless_coordinate(),
            "some inertia along each coordinate: its own, that of a body which it carries, or that of the fluid at a boundary which it moves",
        ),
    };
    let Some(k) = found else { return Ok(()) };
    let RigidBody { name, mass, .. } = &tree.bodies()[tree.coordinates()[k].body];
    // A body that has a mass lacks an inertia.
    let heavy = mass.is_some_and(|mass| mass > 0.0);
    let (key, value) = if heavy { ("inertia", "0 kg m") } else { ("mass", "0 kg/m") };
    let expected = format!("{expected}; {} has none", tree.label(k));
    Err(ask.refuse(&format!("bodies.{name}.{key}"), value, &expected))
}

/// The same bodies, those with a boundary as heavy as the heaviest of all: what the fluid adds to them has full rank.
fn in_fluid(tree: &Tree) -> Tree {
    let mut bodies = tree.bodies().to_vec();
    let mass = bodies.iter().filter_map(|body| body.mass).fold(0.0, f64::max);
    let mass = if mass > 0.0 { mass } else { 1.0 };
    for body in bodies.iter_mut().filter(|body| body.boundary.is_some()) {
        body.mass = Some(mass);
        body.inertia = Some(mass);
        body.shape = None;
    }
    Tree::new(&bodies, [0.0; 2]).expect("masses alone were changed, to what a mass may be")
}
