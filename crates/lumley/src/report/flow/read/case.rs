//! What a report needs of a case file; its other keys are passed over.

use crate::Error;
use crate::report::{FlowReference, FlowSettings};
use lumley_body::RigidBody;
use lumley_body::joint::{Drive, Joint};
use lumley_fem::Point;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;

#[derive(Debug, Deserialize)]
pub(super) struct CaseView {
    #[serde(default)]
    title: String,
    flow: Flow,
    #[serde(default)]
    time: Option<toml::Table>,
    #[serde(default)]
    steady: Option<toml::Table>,
    #[serde(default)]
    bodies: Vec<RigidBody>,
}

#[derive(Debug, Deserialize)]
struct Flow {
    density: f64,
    viscosity: f64,
    #[serde(default)]
    reference: Option<Reference>,
    #[serde(default)]
    boundaries: BTreeMap<String, toml::Table>,
    #[serde(flatten)]
    others: toml::Table,
}

#[derive(Debug, Clone, Copy, Deserialize)]
struct Reference {
    velocity: f64,
    length: f64,
    density: Option<f64>,
}

/// Keys of `[flow]` that stand in the table of the case.
const CHOICES: [(&str, &str); 4] = [
    ("initial", "flow at the start"),
    ("body_force", "body force (m/s²)"),
    ("viscous_form", "viscous term"),
    ("linearisation", "convective term"),
];

/// Units of keys that stand in rows.
const UNITS: [(&str, &str); 11] = [
    ("end", " s"),
    ("step", " s"),
    ("shortest", " s"),
    ("longest", " s"),
    ("ramp", " s"),
    ("peak", " m/s"),
    ("velocity", " m/s"),
    ("pivot", " m"),
    ("x", " m"),
    ("y", " m"),
    ("angle", " rad"),
];

impl CaseView {
    pub(super) fn parse(path: &Path, text: &str) -> Result<Self, Error> {
        toml::from_str(text)
            .map_err(|e| Error::Damaged { path: path.to_owned(), message: e.to_string() })
    }

    /// The boundaries of bodies and their pivots, in m.
    pub(super) fn moving(&self) -> impl Iterator<Item = (&str, Point)> {
        self.bodies.iter().filter_map(|body| Some((body.boundary.as_deref()?, pivot(body))))
    }

    pub(super) fn settings(&self) -> FlowSettings {
        let flow = &self.flow;
        let chosen =
            |(key, name): (&str, &str)| Some((name.to_string(), words(flow.others.get(key)?)));
        let stepping = [("time", &self.time), ("steady iteration", &self.steady)];
        let stepping = stepping
            .into_iter()
            .filter_map(|(name, table)| Some((name.to_string(), pairs(table.as_ref()?))));
        let moving = self.bodies.iter().filter_map(|body| {
            Some((format!("motion of {}", body.name), prescribed(&body.joint)?))
        });
        FlowSettings {
            title: self.title.clone(),
            density: flow.density,
            viscosity: flow.viscosity,
            reference: flow.reference.map(|r| FlowReference {
                velocity: r.velocity,
                length: r.length,
                density: r.density.unwrap_or(flow.density),
            }),
            boundaries: flow
                .boundaries
                .iter()
                .map(|(name, b)| (name.clone(), condition(b)))
                .collect(),
            choices: CHOICES.into_iter().filter_map(chosen).chain(stepping).chain(moving).collect(),
            steady: self.steady.is_some(),
        }
    }
}

/// The point that the joint of a body holds, in m.
fn pivot(body: &RigidBody) -> Point {
    match &body.joint {
        Joint::Prescribed(joint) => joint.at.unwrap_or(body.centre),
        Joint::Revolute(joint) => joint.at,
        _ => body.centre,
    }
}

/// What prescribes a motion, in words.
fn prescribed(joint: &Joint) -> Option<String> {
    let Joint::Prescribed(joint) = joint else { return None };
    let drives = [("x", &joint.x, "m"), ("y", &joint.y, "m"), ("angle", &joint.angle, "rad")];
    let said = drives.into_iter().filter_map(|(name, drive, unit)| match drive {
        Drive::Constant(0.0) | Drive::Function(_) => None,
        Drive::Constant(value) => Some(format!("{name} {value} {unit}")),
        Drive::Formula(formula) => Some(format!("{name} {formula} {unit}")),
        Drive::Table(_) => Some(format!("{name} by a table")),
    });
    Some(said.collect::<Vec<_>>().join(", "))
}

/// `no-slip`, or `velocity: profile parabolic, peak 1.5`.
fn condition(table: &toml::Table) -> String {
    let kind = table.get("kind").map(words).unwrap_or_default();
    let others: toml::Table = table
        .iter()
        .filter(|(key, _)| *key != "kind")
        .map(|(k, v)| (k.clone(), v.clone()))
        .collect();
    match others.keys().next() {
        None => kind,
        // "velocity (1, 0) m/s" says its kind.
        Some(key) if *key == kind => pairs(&others),
        Some(_) => format!("{kind}: {}", pairs(&others)),
    }
}

/// Keys and values in a row.
fn pairs(table: &toml::Table) -> String {
    let said = table.iter().map(|(key, value)| {
        let unit = UNITS.iter().find(|(known, _)| known == key).map_or("", |(_, unit)| unit);
        format!("{} {}{unit}", key.replace('_', " "), words(value))
    });
    said.collect::<Vec<_>>().join(", ")
}

/// A value as people write it.
fn words(value: &toml::Value) -> String {
    match value {
        toml::Value::String(text) => text.clone(),
        toml::Value::Array(items) => {
            format!("({})", items.iter().map(words).collect::<Vec<_>>().join(", "))
        }
        toml::Value::Table(table) => pairs(table),
        toml::Value::Float(number) if *number == 0.0 || (1e-4..1e6).contains(&number.abs()) => {
            number.to_string()
        }
        toml::Value::Float(number) => format!("{number:e}"),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CASE: &str = r#"
title = "Vortex street"
[flow]
density = 1.0
viscosity = 0.001
viscous_form = "laplacian"
initial = { velocity = [1, 0] }
[flow.boundaries.left]
kind = "velocity"
profile = "parabolic"
peak = 1.5
[flow.boundaries.cylinder]
kind = "no-slip"
[flow.reference]
velocity = 1.0
length = 0.1
[time]
end = 8.0
scheme = "bdf2"
[[bodies]]
name = "cylinder"
centre = [0.2, 0.2]
boundary = "cylinder"
joint = { kind = "prescribed", y = "0.02*sin(2*pi*t)" }
[elsewhere]
anything = 1
"#;

    #[test]
    fn a_case_in_words() {
        let case = CaseView::parse("case.toml".as_ref(), CASE).expect("a case");
        let settings = case.settings();
        let pair = |a: &str, b: &str| (a.to_string(), b.to_string());
        assert_eq!(
            settings.boundaries[1],
            pair("left", "velocity: peak 1.5 m/s, profile parabolic")
        );
        assert_eq!(settings.boundaries[0], pair("cylinder", "no-slip"));
        assert_eq!(
            settings.choices,
            [
                pair("flow at the start", "velocity (1, 0) m/s"),
                pair("viscous term", "laplacian"),
                pair("time", "end 8 s, scheme bdf2"),
                pair("motion of cylinder", "y 0.02*sin(2*pi*t) m"),
            ]
        );
        assert_eq!(case.moving().collect::<Vec<_>>(), [("cylinder", [0.2, 0.2])]);
        assert!((settings.reynolds().expect("a reference") - 100.0).abs() < 1e-9);
        assert!(CaseView::parse("case.toml".as_ref(), "[piston]").is_err());
    }
}
