//! Bodies and their joints in words.

use super::quantity::Quantity;
use super::{BodiesReport, BodyMotion};
use crate::report::html::Table;
use crate::report::literal;
use crate::report::number::{NOTHING, short};
use lumley_body::RigidBody;
use lumley_body::joint::{Drive, Joint, Spring};
use lumley_fem::Point;

/// What the case says of each body.
pub(super) fn table(bodies: &BodiesReport) -> Table {
    let row = |BodyMotion { setup, .. }: &BodyMotion| {
        let boundary = setup.boundary.as_deref().map_or(NOTHING.into(), literal);
        let mass = setup.mass.map_or(NOTHING.into(), short);
        let inertia = inertia(setup).map_or(NOTHING.into(), short);
        vec![literal(&setup.name), held(&setup.joint), boundary, mass, inertia]
    };
    let head = ["body", "held by", "boundary", "mass (kg/m)", "inertia (kg m)"];
    Table::new(&head).labels(3).rows(bodies.bodies.iter().map(row))
}

fn inertia(setup: &RigidBody) -> Option<f64> {
    let of_shape = || Some(setup.shape?.inertia(setup.mass?));
    setup.inertia.or_else(of_shape)
}

/// The joint and its springs.
fn held(joint: &Joint) -> String {
    let joint_itself = match joint {
        Joint::Fixed(fixed) => format!("nothing moves it against {}", other(fixed.to.as_ref())),
        Joint::Revolute(hinge) => {
            format!("hinge at {} m on {}", pair(hinge.at), other(hinge.to.as_ref()))
        }
        Joint::Prismatic(slider) => {
            format!("slides along {} of {}", pair(slider.along), other(slider.to.as_ref()))
        }
        Joint::Cartesian(joint) => {
            format!("moves along *x* and *y* of {} without turning", other(joint.to.as_ref()))
        }
        Joint::Free(free) => format!("free against {}", other(free.to.as_ref())),
        Joint::Prescribed(p) => {
            let drives = [("x", &p.x), ("y", &p.y), ("angle", &p.angle)];
            let moved = drives.into_iter().filter_map(|(name, drive)| prescribed(name, drive));
            let all: Vec<String> = moved.collect();
            format!("prescribed against {}: {}", other(p.to.as_ref()), all.join(", "))
        }
    };
    let springs = springs(joint).into_iter().map(|(name, spring)| sprung(name, spring));
    std::iter::once(joint_itself).chain(springs).collect::<Vec<_>>().join("; ")
}

/// The springs of a joint and the coordinates on which they act.
pub(in crate::report::flow) fn springs(joint: &Joint) -> Vec<(&'static str, Spring)> {
    let all = match joint {
        Joint::Fixed(_) | Joint::Prescribed(_) => vec![],
        Joint::Revolute(hinge) => vec![("angle", hinge.spring)],
        Joint::Prismatic(slider) => vec![("distance", slider.spring)],
        Joint::Cartesian(joint) => vec![("x", joint.spring_x), ("y", joint.spring_y)],
        Joint::Free(free) => {
            vec![("x", free.spring_x), ("y", free.spring_y), ("angle", free.spring_angle)]
        }
    };
    all.into_iter().filter_map(|(name, spring)| Some((name, spring?))).collect()
}

fn sprung(name: &str, Spring { stiffness, rest, damping }: Spring) -> String {
    let Quantity { symbol, unit, stiffness_unit, damping_unit, .. } = Quantity::of(name);
    let stiff = format!("spring on {symbol} with {} {stiffness_unit}", short(stiffness));
    let slack = format!(", slack at {} {unit}", short(rest));
    let damped = format!(", damper with {} {damping_unit}", short(damping));
    let parts = [(stiff, true), (slack, rest != 0.0), (damped, damping != 0.0)];
    parts.into_iter().filter(|(_, said)| *said).map(|(words, _)| words).collect()
}

fn prescribed(name: &str, drive: &Drive) -> Option<String> {
    let Quantity { symbol, unit, .. } = Quantity::of(name);
    match drive {
        Drive::Constant(value) if *value == 0.0 => None,
        Drive::Constant(value) => Some(format!("{symbol} = {} {unit}", short(*value))),
        Drive::Formula(formula) => Some(format!("{symbol} = {} {unit}", literal(formula))),
        Drive::Table(_) | Drive::Function(_) => Some(format!("{symbol} by a table")),
    }
}

fn other(name: Option<&String>) -> String {
    name.map_or("the ground".into(), |name| literal(name))
}

fn pair([x, y]: Point) -> String {
    format!("({}, {})", short(x), short(y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joints_in_words() -> Result<(), toml::de::Error> {
        #[derive(serde::Deserialize)]
        struct Body {
            joint: Joint,
        }
        let words = |text: &str| {
            let body: Body = toml::from_str(&format!("joint = {{ {text} }}"))?;
            Ok(held(&body.joint))
        };
        let slider = "kind = 'prismatic', along = [0, 1], spring = { stiffness = 2.37 }";
        assert_eq!(
            words(slider)?,
            "slides along (0, 1) of the ground; spring on *s* with 2.37 N/m^{2}"
        );
        let hinge = "kind = 'revolute', at = [7, 5.5], to = 'a_b'";
        assert_eq!(words(hinge)?, "hinge at (7, 5.5) m on a\\_b");
        let driven = "kind = 'prescribed', y = '0.2*sin(t)', angle = 0.1";
        assert_eq!(
            words(driven)?,
            "prescribed against the ground: *y* = 0.2\\*sin(t) m, angle = 0.1 rad"
        );
        Ok(())
    }
}
