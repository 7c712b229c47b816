use crate::Error;
use crate::case::BodiesChoice;
use crate::command::say;
use crate::model::FlowModel;
use crate::run::coupling;
use lumley_body::joint::Joint;
use lumley_body::{RigidBody, Tree};
use lumley_fom::coupling::Coupling;

/// Says what the bodies in the model are and how flow and bodies find their common motion.
pub(super) fn tell(choice: &BodiesChoice, model: &FlowModel) -> Result<(), Error> {
    for body in choice.tree.bodies() {
        say(&format!("body            {}", described(body)))?;
    }
    say(&format!("coordinates     {}", coordinates(&choice.tree)))?;
    let [gx, gy] = choice.gravity;
    if choice.gravity != [0.0; 2] {
        say(&format!(
            "gravity         ({gx}, {gy}) m/s²: bodies feel it less the fluid that they displace"
        ))?;
    }
    match choice.coupling {
        Coupling::Monolithic => say("coupling        monolithic"),
        Coupling::Explicit => explicit(model.flow().added_mass_share()),
    }
}

/// Numbers of a row of `bodies.csv`.
pub(super) fn columns(tree: &Tree) -> usize {
    1 + 2 * tree.coordinates().len() + 3 * tree.bodies().len()
}

fn described(body: &RigidBody) -> String {
    let (kind, to) = match &body.joint {
        Joint::Fixed(joint) => ("fixed", &joint.to),
        Joint::Revolute(joint) => ("revolute", &joint.to),
        Joint::Prismatic(joint) => ("prismatic", &joint.to),
        Joint::Cartesian(joint) => ("cartesian", &joint.to),
        Joint::Free(joint) => ("free", &joint.to),
        Joint::Prescribed(joint) => ("prescribed", &joint.to),
    };
    let to = to.as_ref().map_or(String::new(), |to| format!(" to {to}"));
    let mass = body.mass.map_or(String::new(), |mass| format!(", {mass} kg/m"));
    let dry = if body.boundary.is_none() { ", not in the fluid" } else { "" };
    format!("{}: {kind}{to}{mass}{dry}", body.name)
}

fn coordinates(tree: &Tree) -> String {
    let label = |k: usize| {
        let prescribed = if tree.coordinates()[k].prescribed { " (prescribed)" } else { "" };
        format!("{}{prescribed}", tree.label(k))
    };
    let labels: Vec<String> = (0..tree.coordinates().len()).map(label).collect();
    if labels.is_empty() { "none: nothing moves".into() } else { labels.join(", ") }
}

/// The limit of the explicit coupling.
fn explicit(share: Option<f64>) -> Result<(), Error> {
    let told = share.unwrap_or_default();
    say(&format!(
        "coupling        explicit, the added mass is about {told:.3} of the bodies' own"
    ))?;
    share
        .and_then(coupling::warning)
        .map_or(Ok(()), |warning| say(&format!("                {warning}")))
}
