//! What a flow's case file says of its motion and its results, as it is written.

use crate::case::term::Term;
use lumley_fem::Point;
use lumley_fom::motion::Stiffness;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// `[motion]`: boundaries that move as rigid bodies, and the mesh with them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MotionSection {
    /// How stiff the mesh is where.
    #[serde(default)]
    pub stiffness: Stiffness,
    /// All nodes this near to a moving boundary move with it, in m.
    #[serde(default)]
    pub rigid_zone: f64,
    /// How each moves, by its name.
    pub boundaries: BTreeMap<String, MovingSection>,
}

/// `[motion.boundaries.NAME]`: a table, or numbers and formulas of t.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MovingSection {
    /// The point about which it turns, in m, where it is in the mesh.
    pub pivot: Point,
    /// Displacement of the pivot in x, in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x: Option<Term>,
    /// Displacement of the pivot in y, in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y: Option<Term>,
    /// Angle by which it has turned, counterclockwise, in rad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle: Option<Term>,
    /// A CSV file of t in s, x and y in m, angle in rad, beside the case file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub table: Option<String>,
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
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct OutputSection {
    /// Time between files for ParaView, in s; without it, only the last state is written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub paraview: Option<f64>,
    /// Steps between rows of loads and probes.
    pub loads: usize,
}

impl Default for OutputSection {
    fn default() -> Self {
        Self { paraview: None, loads: 1 }
    }
}
