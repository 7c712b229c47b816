use serde::{Deserialize, Serialize};

/// Where bodies are and how fast they move, in the generalised coordinates of their joints.
///
/// A piston has one coordinate, its position in m; a hinge has an angle in rad.
///
/// ```
/// use lumley_body::BodyState;
/// let piston = BodyState::new(vec![0.9], vec![0.0]);
/// assert_eq!(piston.position, [0.9]);
/// ```
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BodyState {
    /// Generalised positions, in m or rad.
    pub position: Vec<f64>,
    /// Generalised velocities, in m/s or rad/s, as many as `position` has.
    pub velocity: Vec<f64>,
}

impl BodyState {
    /// The state with these generalised positions and velocities.
    ///
    /// # Panics
    /// If their lengths differ.
    pub fn new(position: Vec<f64>, velocity: Vec<f64>) -> Self {
        assert_eq!(position.len(), velocity.len(), "one velocity for each coordinate");
        Self { position, velocity }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.position.is_empty() && self.velocity.is_empty()
    }
}
