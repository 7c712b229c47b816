use serde::{Deserialize, Serialize};

/// Errors of the two ways to the fixed grid against the full-order field itself.
///
/// ```
/// use lumley::summary::TransferErrors;
/// let json = r#"{ "finite_element_percent": 0.1, "inverse_distance_percent": 2.0 }"#;
/// let errors: TransferErrors = serde_json::from_str(json)?;
/// assert!(matches!(errors, TransferErrors::Piston { .. }));
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum TransferErrors {
    /// Over all snapshots: max_t of the L2 norm of the difference over max_t of the norm, in percent.
    Piston {
        /// Finite-element evaluation.
        finite_element_percent: f64,
        /// Inverse-distance weighting.
        inverse_distance_percent: f64,
    },
    /// Of the last state.
    Flow {
        /// Finite-element evaluation.
        #[serde(rename = "finite-element")]
        finite_element: MethodError,
        /// Inverse-distance weighting.
        #[serde(rename = "inverse-distance")]
        inverse_distance: MethodError,
    },
}

/// How far the bilinear field on the grid, with the nodal values that a transfer gives, is from the velocity itself
/// on mesh and bodies, by quadrature on the cells of the mesh and at 64 points of each cell of the grid in bodies.
///
/// ```
/// assert_eq!(lumley::summary::MethodError::default().l2, 0.0);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct MethodError {
    /// L2 norm of the difference over that of the velocity.
    pub l2: f64,
    /// Largest difference over the largest velocity.
    pub max: f64,
    /// Euclidean norm of the error at the nodes of the grid over that of the velocity there: what the method itself
    /// adds to what any field on this grid loses. Zero for finite-element evaluation, which is the velocity.
    pub nodes: f64,
    /// What a snapshot costs, in ms: finding the grid's nodes in the mesh and bringing the velocity to them.
    pub ms: f64,
}
