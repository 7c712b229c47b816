//! What a run with bodies has beside the others.

use super::{FREQUENCY, Outcome};
use crate::format::csv::write_columns;
use serde_json::{Map, Value, json};
use std::f64::consts::TAU;
use std::path::Path;

/// Amplitude of the cylinder's motion, in m.
const AMPLITUDE: f64 = 0.02;

/// A cylinder on a spring, with a dry rod hinged to it.
pub(super) const BODIES: &str = r#"
[motion]
gravity = [0, -9.81]
[[bodies]]
name = "rotor"
mass = 0.02
centre = [0.2, 0.2]
boundary = "cylinder"
joint = { kind = "cartesian", spring_y = { stiffness = 7.1 } }
[[bodies]]
name = "rod"
mass = 0.001
centre = [0.3, 0.2]
shape = { kind = "bar", length = 0.2 }
joint = { kind = "revolute", at = [0.2, 0.2], to = "rotor" }
[output.probes]
times = [1.0, 2.0]
body = "rotor"
coordinates = { turn = "rod.angle", lift = "rotor.y" }
"#;

/// How far the cylinder is above its place, and the angle of the rod.
pub(super) fn lift(time: f64) -> f64 {
    AMPLITUDE * (TAU * FREQUENCY * time).sin()
}

fn turn(time: f64) -> f64 {
    0.5 * time
}

/// The keys of the summary that only runs with bodies have.
pub(super) fn numbers_of_bodies() -> Map<String, Value> {
    let state = json!({
        "time": 3.0, "centre": [0.2, 0.2], "angle": 0.0, "velocity": [0.0, 0.376_99], "spin": 0.0,
    });
    let coordinate =
        json!({ "position": 0.0, "velocity": 0.376_99, "amplitude": 0.020_01, "frequency": 2.998 });
    let rotor = json!({
        "direction": "y", "amplitude": 0.020_01, "frequency": 2.998, "mean": 0.199_9, "periods": 3,
        "window": [1.9, 2.9], "amplitudes": [0.0202, 0.0201, 0.0200], "frequencies": [2.9, 2.99, 3.0],
        "state": state, "coordinates": { "rotor.y": coordinate },
    });
    let instant =
        json!({ "time": 1.0, "lift": 0.012_34, "turn": 0.5, "fx": 0.16, "fy": 0.02, "mg": null });
    let every = json!({
        "every": 5, "snapshots": 2, "eigenvalues": [0.9, 0.01], "cumulative_percent": [98.9, 100.0],
        "res_percent": [30.0, 4.0],
    });
    let errors = |l2: f64| json!({ "l2": l2, "max": 10.0 * l2, "nodes": 0.0, "ms": 1.7 });
    let keys = json!({
        "bodies": { "rotor": rotor },
        "probes": [instant],
        "pod": { "divergence": [0.021, 0.034, null], "snapshot_divergence": 0.0205 },
        "pod_every": every,
        "transfer": { "finite-element": errors(0.0031), "inverse-distance": errors(0.0212) },
    });
    let Value::Object(keys) = keys else { return Map::new() };
    keys
}

pub(super) fn write_bodies(path: &Path) -> Outcome {
    let times: Vec<f64> = (0..=660).map(|k| f64::from(k) / 220.0).collect();
    let of = |f: fn(f64) -> f64| times.iter().map(|&t| f(t)).collect::<Vec<f64>>();
    let rate = |f: fn(f64) -> f64| {
        times.iter().map(|&t| (f(t + 1e-6) - f(t)) / 1e-6).collect::<Vec<f64>>()
    };
    let zero = vec![0.0; times.len()];
    let columns = [
        ("time", times.clone()),
        ("rotor.x", zero.clone()),
        ("rotor.x'", zero.clone()),
        ("rotor.y", of(lift)),
        ("rotor.y'", rate(lift)),
        ("rod.angle", of(turn)),
        ("rod.angle'", rate(turn)),
        ("rotor.centre_x", of(|_| 0.2)),
        ("rotor.centre_y", of(|t| 0.2 + lift(t))),
        ("rotor.orientation", zero),
        ("rod.centre_x", of(|t| 0.2 + 0.1 * turn(t).cos())),
        ("rod.centre_y", of(|t| 0.2 + lift(t) + 0.1 * turn(t).sin())),
        ("rod.orientation", of(turn)),
    ];
    let columns: Vec<(&str, &[f64])> = columns.iter().map(|(name, x)| (*name, &x[..])).collect();
    Ok(write_columns(path, &columns)?)
}
