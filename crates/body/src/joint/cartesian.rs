use super::Spring;
use super::layout::{Layout, Slide, Turning};
use serde::{Deserialize, Serialize};

/// The body moves in both directions and does not turn against the ground or the other body: a cylinder mounted
/// elastically along and across the flow. Its coordinates are the displacements from the placement as given.
///
/// ```
/// use lumley_body::joint::{Cartesian, Joint, Spring};
/// #[derive(serde::Deserialize)]
/// struct Body { joint: Joint }
/// let body: Body = toml::from_str("joint = { kind = 'cartesian', spring_y = { damping = 1 } }")?;
/// let spring_y = Some(Spring { damping: 1.0, ..Spring::default() });
/// assert_eq!(body.joint, Joint::Cartesian(Cartesian { spring_y, ..Cartesian::default() }));
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cartesian {
    /// The other body, in whose directions of the placement as given it moves; the ground if none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<String>,
    /// On the displacement along x, in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spring_x: Option<Spring>,
    /// On the displacement along y, in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spring_y: Option<Spring>,
}

impl Cartesian {
    pub(super) fn layout(&self) -> Layout<'_> {
        Layout {
            to: self.to.as_deref(),
            at: None,
            slides: Slide::both([self.spring_x, self.spring_y]),
            turn: Turning::With,
            drives: Vec::new(),
        }
    }
}
