use super::{Drive, Spring};
use crate::Point;

/// What the tree of bodies knows of a joint: the body's point is carried by the other body and slides along
/// directions of it; about that point the body may turn.
pub(crate) struct Layout<'a> {
    /// The other body; the ground if none.
    pub to: Option<&'a str>,
    /// The body's point; its centre if none.
    pub at: Option<Point>,
    pub slides: Vec<Slide>,
    pub turn: Turning,
    /// What prescribes the coordinates, where they are prescribed: the slides, then the turn.
    pub drives: Vec<&'a Drive>,
}

pub(crate) struct Slide {
    pub name: &'static str,
    pub direction: Point,
    pub spring: Option<Spring>,
}

/// How a body gets its angle.
pub(crate) enum Turning {
    /// It turns with the body that holds it.
    With,
    /// It turns by a coordinate, its own angle.
    Free(Option<Spring>),
    /// It turns with the body that holds it, and by a coordinate more.
    Beyond,
}

impl Slide {
    /// Along x and along y.
    pub fn both(springs: [Option<Spring>; 2]) -> Vec<Self> {
        let [x, y] = springs;
        vec![
            Self { name: "x", direction: [1.0, 0.0], spring: x },
            Self { name: "y", direction: [0.0, 1.0], spring: y },
        ]
    }
}
