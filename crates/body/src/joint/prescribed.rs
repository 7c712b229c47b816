use super::Drive;
use super::layout::{Layout, Slide, Turning};
use crate::Point;
use serde::{Deserialize, Serialize};

/// The body moves as functions of time say, against the ground or another body. Its coordinates are the
/// displacement of its pivot and the angle from the placement as given; loads do not change them.
///
/// ```
/// use lumley_body::joint::{Drive, Joint, Prescribed};
/// #[derive(serde::Deserialize)]
/// struct Body { joint: Joint }
/// let body: Body = toml::from_str(
///     "[joint]\nkind = 'prescribed'\nx = 0.5\nangle = { times = [0, 1], values = [0, 0.2] }",
/// )?;
/// let Joint::Prescribed(Prescribed { x, y, .. }) = body.joint else { panic!("another joint") };
/// assert_eq!((x, y), (Drive::Constant(0.5), Drive::Constant(0.0)));
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Prescribed {
    /// The pivot in the placement as given, in m; the body's centre if none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<Point>,
    /// The other body, in whose directions of the placement as given it moves; the ground if none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to: Option<String>,
    /// Displacement of the pivot along x, in m.
    pub x: Drive,
    /// Displacement of the pivot along y, in m.
    pub y: Drive,
    /// Angle, counterclockwise, in rad.
    pub angle: Drive,
}

impl Prescribed {
    pub(super) fn layout(&self) -> Layout<'_> {
        Layout {
            to: self.to.as_deref(),
            at: self.at,
            slides: Slide::both([None; 2]),
            turn: Turning::Beyond,
            drives: vec![&self.x, &self.y, &self.angle],
        }
    }
}
