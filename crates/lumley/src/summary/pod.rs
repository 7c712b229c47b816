use serde::{Deserialize, Serialize};

/// What POD found.
///
/// ```
/// assert!(lumley::summary::Decomposition::default().eigenvalues.is_empty());
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Decomposition {
    /// The algorithm that was used.
    pub method: String,
    /// Why, where lumley chose it.
    #[serde(skip_serializing_if = "String::is_empty", default)]
    pub reason: String,
    /// Number of modes that the asked share of the energy, or the asked count, takes.
    pub modes: usize,
    /// Passes over the snapshots that it took.
    #[serde(default)]
    pub passes: usize,
    /// Sum of all eigenvalues, and what an approximation left out.
    pub total_energy: f64,
    /// Most that an eigenvalue may be smaller than the exact one; absent where they are exact.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub error_bound: Option<f64>,
    /// Eigenvalues lambda, largest first.
    pub eigenvalues: Vec<f64>,
    /// Singular values of W^(1/2) X: sigma² = M lambda.
    pub singular_values: Vec<f64>,
    /// Each mode's share of the energy, in percent.
    pub energy_percent: Vec<f64>,
    /// Share of the first modes (31), in percent.
    pub cumulative_percent: Vec<f64>,
    /// RMS projection error of the first modes, sqrt(1 - E), in percent.
    pub rms_error_percent: Vec<f64>,
    /// Of a flow, `||div Phi_n|| / ||grad Phi_n||` of each mode, by central differences at the nodes of the grid that
    /// no body, with their neighbours, covers in any snapshot; null of a mode without gradient there.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub divergence: Vec<Option<f64>>,
    /// The same of the snapshots, with norms over all of them.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub snapshot_divergence: Option<f64>,
}

/// Res(N) (32) of the projection.
///
/// ```
/// assert!(lumley::summary::Projection::default().res_percent.is_empty());
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Projection {
    /// For N = 1, 2, ..., in percent.
    pub res_percent: Vec<f64>,
}

/// POD of every so many snapshots: the fifth, the tenth, ... where `every` is 5.
///
/// ```
/// assert_eq!(lumley::summary::PodEvery::default().snapshots, 0);
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PodEvery {
    /// Of how many snapshots one is taken.
    pub every: usize,
    /// How many are taken.
    pub snapshots: usize,
    /// Eigenvalues lambda, largest first.
    pub eigenvalues: Vec<f64>,
    /// Share of the first modes (31), in percent.
    pub cumulative_percent: Vec<f64>,
    /// Res(N) (32) over these snapshots for N = 1, 2, ..., in percent.
    pub res_percent: Vec<f64>,
}
