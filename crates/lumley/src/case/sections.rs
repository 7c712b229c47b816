//! Sections that the files of all cases share, as they are written.

use serde::{Deserialize, Serialize};

/// `[transfer]`. Inverse-distance weighting is measured beside finite-element evaluation in every run, so
/// its parameters count with either method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct TransferSection {
    /// `finite-element`, or `inverse-distance` (the paper's).
    pub method: TransferMethod,
    /// Exponent of the inverse distance.
    pub power: f64,
    /// Nearest mesh nodes that count.
    pub neighbours: usize,
}

impl Default for TransferSection {
    fn default() -> Self {
        Self { method: TransferMethod::FiniteElement, power: 2.0, neighbours: 4 }
    }
}

/// `transfer.method`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TransferMethod {
    /// The finite-element function itself.
    FiniteElement,
    /// Weights on the nearest mesh nodes.
    InverseDistance,
}

/// `[pod]`. Without `modes` and `energy`: 99.99 % of the energy, as in the paper.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PodSection {
    /// `auto`, `snapshots`, `direct` or `svd`.
    pub method: String,
    /// Number of modes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modes: Option<usize>,
    /// Share of the energy (31), between 0 and 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub energy: Option<f64>,
    /// Whether the mean is subtracted.
    pub center: bool,
    /// Also of every so many snapshots alone: with 5 of the fifth, the tenth, ...
    #[serde(skip_serializing_if = "Option::is_none")]
    pub every: Option<usize>,
}

impl Default for PodSection {
    fn default() -> Self {
        Self { method: "auto".into(), modes: None, energy: None, center: false, every: None }
    }
}
