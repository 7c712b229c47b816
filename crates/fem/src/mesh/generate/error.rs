use crate::Point;

/// Why no mesh can be made of a channel and its bodies.
///
/// ```
/// use lumley_fem::generate::{Channel, GenerateError};
/// let text = "x = [0, 2]\ny = [0, 1]\nsize = -0.1";
/// let channel: Channel = toml::from_str(text)?;
/// let error = channel.mesh().unwrap_err();
/// assert!(matches!(error, GenerateError::Quantity { value: -0.1, .. }));
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GenerateError {
    /// A quantity outside of its range.
    #[error("mesh: {what} is {value}, expected {expected} (lengths in m)")]
    Quantity {
        /// Which one.
        what: String,
        /// The value found.
        value: f64,
        /// What was expected.
        expected: &'static str,
    },
    /// The ends of an interval are not in order.
    #[error("mesh: {what} is {ends:?} m, expected its lower and its upper end, both finite")]
    Interval {
        /// Which one.
        what: &'static str,
        /// Its ends, in m.
        ends: [f64; 2],
    },
    /// A name that is empty or stands for two boundaries.
    #[error(
        "mesh: body {name:?}: expected a name of its own; left, right, bottom and top are the sides of the channel"
    )]
    Name {
        /// The name.
        name: String,
    },
    /// A polygon without an area.
    #[error("mesh: body {body}: a polygon of {corners} corners\n  help: give at least 3")]
    FewCorners {
        /// The body.
        body: String,
        /// How many it has.
        corners: usize,
    },
    /// A polygon that crosses or touches itself.
    #[error("mesh: body {body}: its sides {first} and {second} (counted from 0) touch near ({:.6}, {:.6}) m\n  help: give the corners in their order round the body, each once", near[0], near[1])]
    CrossesItself {
        /// The body.
        body: String,
        /// The first side.
        first: usize,
        /// The other.
        second: usize,
        /// A point of the first side, in m.
        near: Point,
    },
    /// Layers that meet those of another part of their own body.
    #[error("mesh: body {body}: its layers, {thickness} m thick, fold onto themselves near ({:.6}, {:.6}) m\n  help: make them thinner: fewer rows or a smaller first one", near[0], near[1])]
    LayersFold {
        /// The body.
        body: String,
        /// Their thickness, in m.
        thickness: f64,
        /// Where, in m.
        near: Point,
    },
    /// Two bodies, or their layers, have points in common.
    #[error("mesh: bodies {first} and {second}, with layers of {} and {} m, overlap near ({:.6}, {:.6}) m\n  help: move them apart or make the layers thinner", thickness[0], thickness[1], near[0], near[1])]
    Overlap {
        /// A body.
        first: String,
        /// The other.
        second: String,
        /// Thickness of their layers, in m.
        thickness: [f64; 2],
        /// Where, in m.
        near: Point,
    },
    /// A body or its layers reach a side of the channel, or of the rectangle of triangles.
    #[error("mesh: body {body}, with layers of {thickness} m, reaches ({:.6}, {:.6}) m, beyond {side} at {at} m\n  help: move the body, make its layers thinner, or move that side", reach[0], reach[1])]
    Outside {
        /// The body.
        body: String,
        /// Thickness of its layers, in m.
        thickness: f64,
        /// How far it reaches, in m.
        reach: Point,
        /// Which side.
        side: &'static str,
        /// Where the side is, in m.
        at: f64,
    },
    /// A gap that the points along the body are too coarse for.
    #[error("mesh: body {body}, with its layers, comes within {gap} m of another body or a side near ({:.6}, {:.6}) m; its size resolves gaps of {least} m\n  help: make the body's size smaller, or move the body", near[0], near[1])]
    Gap {
        /// The body.
        body: String,
        /// Width of the gap, in m.
        gap: f64,
        /// Where, in m.
        near: Point,
        /// The narrowest gap that can be meshed with this size and growth, in m.
        least: f64,
    },
    /// The rectangle of triangles is not in the channel.
    #[error(
        "mesh: triangles from {found:?} m, but the channel is {channel:?} m\n  help: keep the rectangle within the channel"
    )]
    Rectangle {
        /// x and y of the rectangle, in m.
        found: [[f64; 2]; 2],
        /// x and y of the channel, in m.
        channel: [[f64; 2]; 2],
    },
    /// The sizes lead to more cells than are allowed.
    #[error(
        "mesh: more than {limit} cells\n  help: make the sizes larger, move bodies apart that nearly touch, or raise the limit"
    )]
    TooManyCells {
        /// Most cells that are allowed.
        limit: usize,
    },
    /// A cell that is not valid.
    #[error("mesh: the cell at ({:.6}, {:.6}) m is folded\n  help: make the cells smaller or the layers thinner there", at[0], at[1])]
    Folded {
        /// Its centre, in m.
        at: Point,
    },
    /// Coordinates of too different magnitude to be told apart.
    #[error(
        "mesh: nodes cannot be told apart: {reason}\n  help: scale the lengths so that they are near 1 m, or make the sizes larger"
    )]
    Coordinates {
        /// What the triangulation says.
        reason: String,
    },
}
