//! A disc that sinks in a closed channel eight diameters wide.

use super::Tolerance::Relative;
use super::flow::{Benchmark, Expected, Line};
use crate::summary::Summary;
use std::f64::consts::PI;

pub(super) const BENCHMARKS: &[Benchmark] = &[
    Benchmark {
        name: "sinking",
        case: "falling-disc",
        settings: &["time.end=0.6"],
        coarse: false,
        full: true,
        expected: Expected::Numbers(with_inertia),
    },
    Benchmark {
        name: "creeping",
        case: "falling-disc",
        settings: &["flow.viscosity=1", "time.end=0.1"],
        coarse: true,
        full: false,
        expected: Expected::Numbers(creeping),
    },
];

/// Between the largest Reynolds numbers that others have found of the disc of Glowinski and others (2001): 17.27, their own, and
/// 17.42 of Wan and Turek (2006).
fn with_inertia(summary: &Summary) -> Vec<Line> {
    let reynolds = velocity(summary).map(|v| 1250.0 * 0.0025 * v / 0.01);
    vec![Line::new("Reynolds number", "1", (17.35, Relative(0.01)), reynolds)]
}

/// Weight less that of the fluid displaced, over the drag of a cylinder midway between walls without inertia (Faxén 1946).
fn creeping(summary: &Summary) -> Vec<Line> {
    let (radius, width, viscosity) = (0.00125_f64, 0.02, 1.0);
    let weight = (1250.0 - 1000.0) * PI * radius * radius * 9.81;
    let k = 2.0 * radius / width;
    let series = [-0.9157, 1.7244, -1.7302, 2.4056, -4.5913];
    let walls = series.iter().rev().fold(0.0, |sum, c| sum * k * k + c);
    let terminal = weight * (walls - k.ln()) / (4.0 * PI * viscosity);
    vec![Line::new("terminal velocity", "m/s", (terminal, Relative(5e-3)), velocity(summary))]
}

/// Of the fall at the end, in m/s.
fn velocity(summary: &Summary) -> Option<f64> {
    Some(-summary.bodies.get("disc")?.state.velocity[1])
}
