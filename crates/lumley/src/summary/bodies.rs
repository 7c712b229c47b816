use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// How a body in a flow moved: its centre of mass in the direction, x or y, in which it has full periods, of both or
/// neither in that of the larger amplitude; then its last state and its coordinates.
///
/// ```
/// assert_eq!(lumley::summary::BodyMotion::default().motion.frequency, None);
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct BodyMotion {
    /// `x` or `y`: the centre's coordinate that oscillates as the numbers beside say, in m.
    pub direction: String,
    /// Of this coordinate.
    #[serde(flatten)]
    pub motion: Oscillation,
    /// At the end.
    pub state: RigidState,
    /// The coordinates of its joint, by their labels, such as `bar.angle`.
    pub coordinates: BTreeMap<String, CoordinateMotion>,
}

/// An oscillation over its last full periods, ten or as many as there are, or, without periods, over the later half
/// of the run. A period begins where the signal rises through its mean.
///
/// ```
/// assert_eq!(lumley::summary::Oscillation::default().periods, 0);
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Oscillation {
    /// Half of the distance from the smallest to the largest value.
    pub amplitude: f64,
    /// In Hz; null below three full periods.
    pub frequency: Option<f64>,
    /// The mean in time.
    pub mean: f64,
    /// Full periods over which these numbers are taken.
    pub periods: usize,
    /// From when to when, in s.
    pub window: [f64; 2],
    /// The amplitude in each period.
    pub amplitudes: Vec<f64>,
    /// One over the length of each period, in Hz.
    pub frequencies: Vec<f64>,
}

/// Where a rigid body is and how it moves.
///
/// ```
/// assert_eq!(lumley::summary::RigidState::default().spin, 0.0);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct RigidState {
    /// In s.
    pub time: f64,
    /// Centre of mass, in m.
    pub centre: [f64; 2],
    /// Angle, counterclockwise, in rad; whole turns count.
    pub angle: f64,
    /// Velocity of the centre of mass, in m/s.
    pub velocity: [f64; 2],
    /// Angular velocity, in rad/s.
    pub spin: f64,
}

/// How a generalised coordinate moved.
///
/// ```
/// assert_eq!(lumley::summary::CoordinateMotion::default().frequency, None);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct CoordinateMotion {
    /// At the end, in m or rad.
    pub position: f64,
    /// At the end, in m/s or rad/s.
    pub velocity: f64,
    /// As of [`Oscillation`], in m or rad.
    pub amplitude: f64,
    /// As of [`Oscillation`], in Hz.
    pub frequency: Option<f64>,
}
