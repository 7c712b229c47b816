//! What a flow's case file says of its motion and its results, as it is written.

use lumley_fem::Point;
use lumley_fom::coupling::Coupling;
use lumley_fom::motion::Stiffness;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// `[motion]`: how flow and mesh go with the bodies.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MotionSection {
    /// How stiff the mesh is where.
    pub stiffness: Stiffness,
    /// Cells with a node this near to a body move with it, in m.
    pub rigid_zone: f64,
    /// `monolithic` or `explicit` (the paper's).
    pub coupling: Coupling,
    /// In m/s²; bodies feel their weight less that of the fluid which they displace, the flow feels nothing.
    pub gravity: Point,
}

/// `[grid]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GridSection {
    /// Nodes in x and y, ends included.
    pub nodes: [usize; 2],
    /// Lower left corner, in m; by default that of the mesh.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lower: Option<Point>,
    /// Upper right corner, in m; by default that of the mesh.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub upper: Option<Point>,
}

/// `[record]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecordSection {
    /// Time between snapshots, in s; a whole number of time steps.
    pub interval: f64,
    /// Time of the first snapshot, in s; a whole number of time steps.
    #[serde(default)]
    pub start: f64,
}

/// `[output]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct OutputSection {
    /// Time between files for ParaView, in s; without it, only the last state is written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub paraview: Option<f64>,
    /// Steps between rows of loads and probes.
    pub loads: usize,
    /// What is told of a body at given times.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub probes: Option<BodyProbesSection>,
}

/// `[output.probes]`: the load on a body and coordinates at given times.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyProbesSection {
    /// When, in s.
    pub times: Vec<f64>,
    /// The body on whose boundary the load is taken.
    pub body: String,
    /// Coordinates such as `bar.angle`, each under a name of its own.
    #[serde(default)]
    pub coordinates: BTreeMap<String, String>,
}

impl Default for OutputSection {
    fn default() -> Self {
        Self { paraview: None, loads: 1, probes: None }
    }
}
