//! Joints and supports: how a body may move and what holds it.
//!
//! A new joint is a file with a struct and its `layout`, and a variant of [`Joint`].

mod cartesian;
mod drive;
mod error;
mod fixed;
mod free;
mod layout;
mod prescribed;
mod prismatic;
mod revolute;
mod slider;
mod spring;
mod table;

pub use cartesian::Cartesian;
pub use drive::{Drive, TimeFunction};
pub use error::JointError;
pub use fixed::Fixed;
pub use free::Free;
pub(crate) use layout::{Layout, Turning};
pub use prescribed::Prescribed;
pub use prismatic::Prismatic;
pub use revolute::Revolute;
pub use slider::Slider;
pub use spring::Spring;
pub use table::{Table, TableError};

use serde::{Deserialize, Serialize};

/// What holds a body: `joint = { kind = "...", ... }` in a case file.
///
/// ```
/// use lumley_body::joint::{Joint, Slider};
/// let across = Joint::Prismatic(Slider { along: [0.0, 1.0], to: None, spring: None });
/// assert!(toml::to_string(&across)?.starts_with("kind = \"prismatic\""));
/// # Ok::<(), toml::ser::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Joint {
    /// One with the ground or another body.
    Fixed(Fixed),
    /// A hinge.
    Revolute(Revolute),
    /// Sliding along a direction.
    Prismatic(Slider),
    /// Moving in both directions without turning.
    Cartesian(Cartesian),
    /// Held by nothing but springs.
    Free(Free),
    /// Moving as functions of time say.
    Prescribed(Prescribed),
}

impl Joint {
    pub(crate) fn layout(&self) -> Layout<'_> {
        match self {
            Self::Fixed(joint) => joint.layout(),
            Self::Revolute(joint) => joint.layout(),
            Self::Prismatic(joint) => joint.layout(),
            Self::Cartesian(joint) => joint.layout(),
            Self::Free(joint) => joint.layout(),
            Self::Prescribed(joint) => joint.layout(),
        }
    }
}
