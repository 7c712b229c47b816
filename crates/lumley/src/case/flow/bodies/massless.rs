use crate::case::CaseError;
use crate::case::ask::Ask;
use lumley_body::{RigidBody, Tree};
use lumley_fom::coupling::Coupling;

/// Refuses bodies of which nothing says how they accelerate: neither their mass nor, with the monolithic coupling, the
/// fluid.
pub(super) fn check(ask: &Ask, tree: &Tree, coupling: Coupling) -> Result<(), CaseError> {
    let Some(k) = coupling.massless_coordinate(tree) else { return Ok(()) };
    let expected = match coupling {
        Coupling::Explicit => {
            "some inertia along each coordinate: the explicit coupling has no other; take coupling = \"monolithic\""
        }
        Coupling::Monolithic => {
            "some inertia along each coordinate: its own, that of a body which it carries, or that of the fluid at a boundary which it moves"
        }
    };
    let RigidBody { name, mass, .. } = &tree.bodies()[tree.coordinates()[k].body];
    // A body that has a mass lacks an inertia.
    let heavy = mass.is_some_and(|mass| mass > 0.0);
    let (key, value) = if heavy { ("inertia", "0 kg m") } else { ("mass", "0 kg/m") };
    let expected = format!("{expected}; {} has none", tree.label(k));
    Err(ask.refuse(&format!("bodies.{name}.{key}"), value, &expected))
}
