//! `summary.json`: every number of the report, under names that others rely on.

mod bodies;
mod full_order;
mod pod;
mod probes;
mod reduced;
mod transfer;

pub use bodies::{BodyMotion, CoordinateMotion, Oscillation, RigidState};
pub use full_order::{FullOrder, LoadStatistics, Variant};
pub use pod::{Decomposition, PodEvery, Projection};
pub use probes::{BodyProbe, FlowProbe, PistonProbe, Probe};
pub use reduced::{Failure, Reduced, Speedup};
pub use transfer::{MethodError, TransferErrors};

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Name of the file in a run directory.
pub const SUMMARY: &str = "summary.json";

/// The numbers of a run.
///
/// ```
/// use lumley::summary::Summary;
/// let json = serde_json::to_string(&Summary::default())?;
/// assert!(json.contains("\"rom\":[]"));
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Name of the case.
    pub case: String,
    /// Where the run is.
    pub directory: String,
    /// The run whose modes these are, where they are not this run's own.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub basis: Option<String>,
    /// The full-order model; absent for snapshots that lumley did not compute.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub fom: Option<FullOrder>,
    /// The snapshots.
    pub record: Snapshots,
    /// The transfer to the fixed grid.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub transfer: Option<TransferErrors>,
    /// The decomposition on the fixed grid.
    pub pod: Decomposition,
    /// The same of some of the snapshots alone, where the case asks for that.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub pod_every: Option<PodEvery>,
    /// The decomposition in the reference frame, when a reduced model stands on it.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub pod_reference: Option<Decomposition>,
    /// Projection on the first modes.
    pub projection: Projection,
    /// The reduced models, in the order of the case file.
    pub rom: Vec<Reduced>,
    /// The full-order model at given times: those of the reference table, or those of the case.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub probes: Vec<Probe>,
    /// The motion of the bodies in a flow, by name.
    #[serde(skip_serializing_if = "BTreeMap::is_empty", default)]
    pub bodies: BTreeMap<String, BodyMotion>,
    /// The loads of a flow on the boundaries, by name.
    #[serde(skip_serializing_if = "BTreeMap::is_empty", default)]
    pub loads: BTreeMap<String, LoadStatistics>,
    /// The pressure at the first of the case's two points less that at the second, at the end, in Pa.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub pressure_difference: Option<f64>,
    /// What the reader should know, in sentences.
    pub warnings: Vec<String>,
}

impl Summary {
    /// The summary as JSON, indented.
    ///
    /// # Panics
    /// Never: it is plain data.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a summary is plain data")
    }
}

/// The snapshots that were decomposed.
///
/// ```
/// assert_eq!(lumley::summary::Snapshots::default().snapshots, 0);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Snapshots {
    /// Number M of snapshots.
    pub snapshots: usize,
    /// Their length n on the fixed grid.
    pub unknowns: usize,
    /// max_t ||u|| in the inner product of the decomposition.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub max_norm: Option<f64>,
}
