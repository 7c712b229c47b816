use super::Spring;
use super::layout::{Layout, Turning};
use crate::Point;
use serde::{Deserialize, Serialize};

/// A hinge. Its coordinate is the angle of the body itself, not that against the other body, as theta and phi in
/// the paper's (16); its spring acts on the angle against the other body.
///
/// ```
/// use lumley_body::joint::{Joint, Revolute};
/// #[derive(serde::Deserialize)]
/// struct Body { joint: Joint }
/// let body: Body = toml::from_str("joint = { kind = 'revolute', at = [7, 5.5], to = 'bar' }")?;
/// let hinge = Revolute { at: [7.0, 5.5], to: Some("bar".into()), spring: None };
/// assert_eq!(body.joint, Joint::Revolute(hinge));
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Revolute {
    /// Where the hinge is in the placement as given, in m.
    pub at: Point,
    /// The other body; the ground if none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<String>,
    /// On the angle against the other body, in rad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spring: Option<Spring>,
}

impl Revolute {
    pub(super) fn layout(&self) -> Layout<'_> {
        Layout {
            to: self.to.as_deref(),
            at: Some(self.at),
            slides: Vec::new(),
            turn: Turning::Free(self.spring),
            drives: Vec::new(),
        }
    }
}
