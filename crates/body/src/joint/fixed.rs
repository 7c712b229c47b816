use super::layout::{Layout, Turning};
use serde::{Deserialize, Serialize};

/// The body is one with the ground or with another body.
///
/// ```
/// use lumley_body::joint::{Fixed, Joint};
/// #[derive(serde::Deserialize)]
/// struct Body { joint: Joint }
/// let body: Body = toml::from_str("joint = { kind = 'fixed', to = 'bar' }")?;
/// assert_eq!(body.joint, Joint::Fixed(Fixed { to: Some("bar".into()) }));
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fixed {
    /// The other body; the ground if none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<String>,
}

impl Fixed {
    pub(super) fn layout(&self) -> Layout<'_> {
        Layout {
            to: self.to.as_deref(),
            at: None,
            slides: Vec::new(),
            turn: Turning::With,
            drives: Vec::new(),
        }
    }
}
