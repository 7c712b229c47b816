use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The full-order model at one time.
///
/// ```
/// use lumley::summary::Probe;
/// let json = r#"{ "time": 0.55, "theta": 1.56862, "fx": 0.7161, "fy": 3.2e-4, "mg": 7.3e-5 }"#;
/// let Probe::Flow(probe) = serde_json::from_str(json)? else { panic!("it has a force") };
/// assert_eq!(probe.coordinates["theta"], 1.56862);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Probe {
    /// Of a piston.
    Piston(PistonProbe),
    /// Of a flow with bodies.
    Flow(FlowProbe),
}

impl Probe {
    /// The probe of a piston, if it is one.
    pub fn piston(&self) -> Option<PistonProbe> {
        match self {
            Self::Piston(probe) => Some(*probe),
            Self::Flow(_) => None,
        }
    }

    /// The probe of a flow, if it is one.
    pub fn flow(&self) -> Option<&FlowProbe> {
        match self {
            Self::Flow(probe) => Some(probe),
            Self::Piston(_) => None,
        }
    }
}

/// A piston at one time.
///
/// ```
/// assert_eq!(lumley::summary::PistonProbe::default().time, 0.0);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct PistonProbe {
    /// In s.
    pub time: f64,
    /// The piston.
    pub body: BodyProbe,
    /// u(0.5, t), in m/s.
    pub velocity_mid: f64,
    /// nu u_x(X-), in m²/s².
    pub traction: f64,
}

/// The piston's block at one time.
///
/// ```
/// assert_eq!(lumley::summary::BodyProbe::default().position, 0.0);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct BodyProbe {
    /// X, in m.
    pub position: f64,
    /// X', in m/s.
    pub velocity: f64,
}

/// Bodies in a flow at one time, with the load on one of them: of the step that ends then, or on the straight line
/// between the rows of `bodies.csv` and `loads.csv` before and after.
///
/// ```
/// assert_eq!(lumley::summary::FlowProbe::default().fx, 0.0);
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FlowProbe {
    /// In s.
    pub time: f64,
    /// Coordinates of the bodies by the names that the case gives them, in m or rad.
    #[serde(flatten)]
    pub coordinates: BTreeMap<String, f64>,
    /// Force along x, in N/m.
    pub fx: f64,
    /// Force along y, in N/m.
    pub fy: f64,
    /// Moment about the centre of mass, in N.
    pub mg: f64,
}
