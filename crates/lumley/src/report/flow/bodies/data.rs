//! What the report shows of bodies.

use lumley_body::RigidBody;
use lumley_fem::Point;
use serde::Deserialize;

/// The bodies of a flow and how they moved.
///
/// ```
/// assert!(lumley::report::BodiesReport::default().bodies.is_empty());
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct BodiesReport {
    /// In m/s².
    pub gravity: Point,
    /// Times of the motion, in s.
    pub times: Vec<f64>,
    /// The bodies, in the order of the case.
    pub bodies: Vec<BodyMotion>,
    /// What the case asks for at given instants: name and values of each column, the times first.
    pub instants: Vec<(String, Vec<f64>)>,
}

impl BodiesReport {
    /// The body whose boundary has this name.
    pub(in crate::report::flow) fn of_boundary(&self, name: &str) -> Option<&BodyMotion> {
        self.bodies.iter().find(|body| body.setup.boundary.as_deref() == Some(name))
    }

    /// The body of this name.
    pub(in crate::report::flow) fn named(&self, name: &str) -> Option<&BodyMotion> {
        self.bodies.iter().find(|body| body.setup.name == name)
    }

    /// Displacement and turn of a body at `time`, linear between the times and held outside of them; none where
    /// nothing is known.
    pub(in crate::report::flow) fn place(&self, body: &BodyMotion, time: f64) -> [f64; 3] {
        interpolate(&self.times, &body.track, time).unwrap_or_default()
    }
}

/// A rigid body of a flow and how it moved.
///
/// ```
/// use lumley::report::BodyMotion;
///
/// let setup = toml::from_str("name = 'rod'\nmass = 1\ncentre = [0, 1]\njoint = { kind = 'fixed' }")?;
/// let rod = BodyMotion { setup, track: vec![], coordinates: vec![], numbers: Default::default() };
/// assert!(!rod.moves());
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct BodyMotion {
    /// What the case says of it.
    pub setup: RigidBody,
    /// Displacement of its centre of mass in x and y, in m, and turn, in rad, from where it is in the mesh, at the
    /// times of the motion.
    pub track: Vec<[f64; 3]>,
    /// The coordinates of its joint.
    pub coordinates: Vec<CoordinateMotion>,
    /// What the summary says of it.
    pub numbers: BodyNumbers,
}

impl BodyMotion {
    /// Whether it is ever elsewhere than in the mesh.
    pub fn moves(&self) -> bool {
        self.track.iter().flatten().any(|c| *c != 0.0)
    }
}

/// A coordinate of a joint over the times of the motion.
///
/// ```
/// let coordinate = lumley::report::CoordinateMotion { name: "angle".into(), ..Default::default() };
/// assert_eq!(coordinate.numbers.amplitude, None);
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CoordinateMotion {
    /// `x`, `y` or `distance`, in m, or `angle`, in rad.
    pub name: String,
    /// In m or rad.
    pub position: Vec<f64>,
    /// In m/s or rad/s.
    pub velocity: Vec<f64>,
    /// What the summary says of it.
    pub numbers: CoordinateNumbers,
}

/// The numbers that the summary has for a body.
///
/// ```
/// assert!(lumley::report::BodyNumbers::default().amplitudes.is_empty());
/// ```
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(default)]
pub struct BodyNumbers {
    /// `x` or `y`: which coordinate of the centre these numbers are of.
    pub direction: String,
    /// Its amplitude, in m.
    pub amplitude: Option<f64>,
    /// Its frequency, in Hz.
    pub frequency: Option<f64>,
    /// Its mean, in m.
    pub mean: Option<f64>,
    /// Full periods over which these are taken; 0 where it has none.
    pub periods: usize,
    /// From when to when these are, in s.
    pub window: Option<[f64; 2]>,
    /// Amplitude of each of these periods, in m.
    pub amplitudes: Vec<f64>,
    /// Frequency of each of these periods, in Hz.
    pub frequencies: Vec<f64>,
    /// Where it is at the end.
    pub state: Option<FinalState>,
}

/// Where a body is at the end of a run and how it moves.
///
/// ```
/// assert_eq!(lumley::report::FinalState::default().spin, 0.0);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
#[serde(default)]
pub struct FinalState {
    /// In s.
    pub time: f64,
    /// Centre of mass, in m.
    pub centre: Point,
    /// In rad.
    pub angle: f64,
    /// Of the centre of mass, in m/s.
    pub velocity: Point,
    /// In rad/s.
    pub spin: f64,
}

/// The numbers that the summary has for a coordinate.
///
/// ```
/// assert_eq!(lumley::report::CoordinateNumbers::default().position, None);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
#[serde(default)]
pub struct CoordinateNumbers {
    /// At the end, in m or rad.
    pub position: Option<f64>,
    /// At the end, in m/s or rad/s.
    pub velocity: Option<f64>,
    /// In m or rad.
    pub amplitude: Option<f64>,
    /// In Hz.
    pub frequency: Option<f64>,
}

/// Values at `time`, linear between the times at which they are given and held outside of them; `None` where
/// there are none.
pub(super) fn interpolate<const N: usize>(
    times: &[f64],
    values: &[[f64; N]],
    time: f64,
) -> Option<[f64; N]> {
    let times = &times[..times.len().min(values.len())];
    let after = times.partition_point(|t| *t < time).min(times.len().checked_sub(1)?);
    let before = after.saturating_sub(1);
    let s = ((time - times[before]) / (times[after] - times[before])).clamp(0.0, 1.0);
    let (from, to) = (values[before], values[after]);
    Some(if s.is_nan() { to } else { std::array::from_fn(|k| from[k] + s * (to[k] - from[k])) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_linear_between_their_times() {
        let times = [1.0, 2.0, 4.0];
        let values = [[0.0; 3], [1.0, 0.0, 0.5], [3.0, 2.0, 0.5]];
        let at = |time| interpolate(&times, &values, time);
        assert_eq!(at(0.0), Some([0.0; 3]));
        assert_eq!(at(1.5), Some([0.5, 0.0, 0.25]));
        assert_eq!(at(2.0), Some([1.0, 0.0, 0.5]));
        assert_eq!(at(9.0), Some([3.0, 2.0, 0.5]));
        assert_eq!(interpolate::<3>(&times, &[], 1.0), None);
        assert_eq!(interpolate(&[1.0], &[[7.0; 3]], 1.0), Some([7.0; 3]));
    }
}
