//! What a report needs of a case file; its other keys are passed over.

use crate::Error;
use crate::report::{FlowReference, FlowSettings};
use lumley_body::RigidBody;
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
    pub bodies: Vec<RigidBody>,
    #[serde(default)]
    pub motion: Motion,
    #[serde(default)]
    output: Output,
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

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Motion {
    pub gravity: Point,
    #[serde(flatten)]
    others: toml::Table,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Output {
    probes: Instants,
}

/// What is asked for of the bodies at given instants.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Instants {
    coordinates: BTreeMap<String, String>,
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
    ("x", " m"),
    ("y", " m"),
    ("angle", " rad"),
    ("rigid_zone", " m"),
];

impl CaseView {
    pub(super) fn parse(path: &Path, text: &str) -> Result<Self, Error> {
        toml::from_str(text)
            .map_err(|e| Error::Damaged { path: path.to_owned(), message: e.to_string() })
    }

    /// What is asked for at given instants: the name and the label of each coordinate.
    pub(super) fn instants(&self) -> &BTreeMap<String, String> {
        &self.output.probes.coordinates
    }

    pub(super) fn settings(&self) -> FlowSettings {
        let flow = &self.flow;
        let chosen =
            |(key, name): (&str, &str)| Some((name.to_string(), words(flow.others.get(key)?)));
        let stepping = [("time", &self.time), ("steady iteration", &self.steady)];
        let stepping = stepping
            .into_iter()
            .filter_map(|(name, table)| Some((name.to_string(), pairs(table.as_ref()?))));
        let [gx, gy] = self.motion.gravity;
        let motion = [
            ("gravity", format!("({gx}, {gy}) m/s²"), [gx, gy] != [0.0; 2]),
            ("motion of the mesh", pairs(&self.motion.others), !self.motion.others.is_empty()),
        ];
        let motion = motion.into_iter().filter(|(.., said)| *said);
        let motion = motion.map(|(name, words, _)| (name.to_string(), words));
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
            choices: CHOICES.into_iter().filter_map(chosen).chain(stepping).chain(motion).collect(),
            steady: self.steady.is_some(),
        }
    }
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
[motion]
gravity = [0, -9.81]
rigid_zone = 0.3
[[bodies]]
name = "rotor"
centre = [0.2, 0.2]
boundary = "cylinder"
joint = { kind = "prescribed", y = "0.02*sin(2*pi*t)" }
[output.probes]
times = [1.0, 2.0]
body = "rotor"
coordinates = { lift = "rotor.y" }
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
                pair("gravity", "(0, -9.81) m/s²"),
                pair("motion of the mesh", "rigid zone 0.3 m"),
            ]
        );
        assert_eq!(case.bodies[0].boundary.as_deref(), Some("cylinder"));
        assert_eq!(case.instants()["lift"], "rotor.y");
        assert!((settings.reynolds().expect("a reference") - 100.0).abs() < 1e-9);
        assert!(CaseView::parse("case.toml".as_ref(), "[piston]").is_err());
    }
}
