use super::Spring;
use super::layout::{Layout, Slide, Turning};
use serde::{Deserialize, Serialize};

/// Nothing holds the body but its springs. Its coordinates are the displacements of its centre from the placement
/// as given, and its angle.
///
/// ```
/// use lumley_body::joint::{Free, Joint};
/// #[derive(serde::Deserialize)]
/// struct Body { joint: Joint }
/// let body: Body = toml::from_str("joint = { kind = 'free' }")?;
/// assert_eq!(body.joint, Joint::Free(Free::default()));
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Free {
    /// The body against which displacements are measured, in its directions of the placement as given; the ground
    /// if none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<String>,
    /// On the displacement along x, in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spring_x: Option<Spring>,
    /// On the displacement along y, in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spring_y: Option<Spring>,
    /// On the angle against the other body, in rad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spring_angle: Option<Spring>,
}

impl Free {
    pub(super) fn layout(&self) -> Layout<'_> {
        Layout {
            to: self.to.as_deref(),
            at: None,
            slides: Slide::both([self.spring_x, self.spring_y]),
            turn: Turning::Free(self.spring_angle),
            drives: Vec::new(),
        }
    }
}
