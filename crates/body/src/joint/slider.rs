use super::Spring;
use super::layout::{Layout, Slide, Turning};
use crate::Point;
use serde::{Deserialize, Serialize};

/// The joint `prismatic`: the body slides along a direction of the ground or of another body, and turns with it.
/// Its coordinate is the distance from the placement as given.
///
/// ```
/// use lumley_body::joint::{Joint, Slider, Spring};
/// #[derive(serde::Deserialize)]
/// struct Body { joint: Joint }
/// let body: Body = toml::from_str(
///     "joint = { kind = 'prismatic', along = [0, 1], spring = { stiffness = 2.37 } }",
/// )?;
/// let spring = Some(Spring { stiffness: 2.37, ..Spring::default() });
/// assert_eq!(body.joint, Joint::Prismatic(Slider { along: [0.0, 1.0], to: None, spring }));
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Slider {
    /// Direction in the placement as given; its length does not matter.
    pub along: Point,
    /// The other body; the ground if none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<String>,
    /// On the distance, in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spring: Option<Spring>,
}

impl Slider {
    pub(super) fn layout(&self) -> Layout<'_> {
        let slide = Slide { name: "distance", direction: self.along, spring: self.spring };
        Layout {
            to: self.to.as_deref(),
            at: None,
            slides: vec![slide],
            turn: Turning::With,
            drives: Vec::new(),
        }
    }
}
