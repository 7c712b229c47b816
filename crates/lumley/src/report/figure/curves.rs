//! Curved edges in the plane: lines of a mesh, boundaries, outlines of bodies.

use std::collections::HashSet;
use std::fmt::Write;

use super::frame::Frame;
use super::series::Ink;
use super::svg::{Px, Svg};

/// Most edges of one kind that are drawn; where they are denser than can be seen, some are left out.
const MOST: usize = 12_000;

/// A place in the figure.
type Place = (f64, f64);

/// Quadratic curves in the coordinates of a plot, each by its start, end and middle, as the edges of a mesh
/// are.
///
/// ```
/// use lumley::report::figure::Curves;
///
/// let wall = Curves::line("wall", vec![[[0.0, 0.0], [1.0, 0.0], [0.5, 0.1]]]).colour(2);
/// # let _ = wall;
/// ```
#[derive(Debug, Clone)]
pub struct Curves {
    pub(super) name: String,
    pub(super) ink: Ink,
    edges: Vec<[[f64; 2]; 3]>,
    look: Look,
}

#[derive(Debug, Clone, Copy)]
enum Look {
    Fine,
    Line,
    Rigid(Pose, Face),
}

/// What of a rigid outline is drawn.
#[derive(Debug, Clone, Copy)]
enum Face {
    Filled,
    Hollow,
    Dashed,
    Link,
}

impl Face {
    /// The class; scripts move all that are solid.
    fn class(self) -> &'static str {
        match self {
            Self::Filled => "solid",
            Self::Hollow => "solid hollow",
            Self::Dashed => "solid hollow dash",
            Self::Link => "solid link",
        }
    }
}

/// Where a rigid outline is.
#[derive(Debug, Clone, Copy, Default)]
struct Pose {
    pivot: [f64; 2],
    translation: [f64; 2],
    angle: f64,
}

impl Curves {
    fn new(name: &str, edges: Vec<[[f64; 2]; 3]>, look: Look) -> Self {
        Self { name: name.into(), ink: Ink::Text, edges, look }
    }

    /// Hairlines, for a mesh.
    pub fn fine(edges: Vec<[[f64; 2]; 3]>) -> Self {
        Self::new("", edges, Look::Fine)
    }

    /// A line that the legend names.
    pub fn line(name: &str, edges: Vec<[[f64; 2]; 3]>) -> Self {
        Self::new(name, edges, Look::Line)
    }

    /// A filled outline; edges follow each other, and a new ring begins where one does not.
    pub fn solid(edges: Vec<[[f64; 2]; 3]>) -> Self {
        Self::new("", edges, Look::Rigid(Pose::default(), Face::Filled))
    }

    /// A rigid line through points, to be moved like an outline.
    pub fn link(points: &[[f64; 2]]) -> Self {
        let middle = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|d| f64::midpoint(a[d], b[d]));
        let edges = points.windows(2).map(|ab| [ab[0], ab[1], middle(ab[0], ab[1])]).collect();
        Self::new("", edges, Look::Rigid(Pose::default(), Face::Link))
    }

    /// Turns a filled outline by `angle` in rad about `pivot` and then moves it.
    #[must_use]
    pub fn moved(mut self, pivot: [f64; 2], translation: [f64; 2], angle: f64) -> Self {
        if let Look::Rigid(pose, _) = &mut self.look {
            *pose = Pose { pivot, translation, angle };
        }
        self
    }

    /// Leaves a filled outline empty, where what is behind it is to be seen.
    #[must_use]
    pub fn hollow(self) -> Self {
        self.with(Face::Hollow)
    }

    /// Leaves a filled outline empty and dashes its rim.
    #[must_use]
    pub fn dashed(self) -> Self {
        self.with(Face::Dashed)
    }

    fn with(mut self, wanted: Face) -> Self {
        if let Look::Rigid(_, face) = &mut self.look {
            *face = wanted;
        }
        self
    }

    /// The `k`-th colour of the palette instead of the text's.
    #[must_use]
    pub fn colour(mut self, k: usize) -> Self {
        self.ink = Ink::Palette(k);
        self
    }

    /// Draws the curves in the coordinates of the plot.
    pub(super) fn draw(&self, svg: &mut Svg, frame: &Frame) {
        match self.look {
            Look::Fine => path(svg, "fine", &separate(&thinned(self.places(frame), frame))),
            Look::Line => path(svg, &self.class(), &separate(&thinned(self.places(frame), frame))),
            Look::Rigid(pose, face) => self.draw_rigid(svg, frame, pose, face),
        }
    }

    /// The class of the line, also of its sample in a legend.
    pub(super) fn class(&self) -> String {
        format!("line rim {}", self.ink.class())
    }

    /// Every edge in the figure; one without a place is left out.
    fn places(&self, frame: &Frame) -> Vec<[Place; 3]> {
        let place = |[x, y]: [f64; 2]| Some((frame.x.position(x)?, frame.y.position(y)?));
        let edge = |[a, b, middle]: &[[f64; 2]; 3]| Some([place(*a)?, place(*b)?, place(*middle)?]);
        self.edges.iter().filter_map(edge).collect()
    }

    /// The outline stands about its pivot, and a transformation puts it where it is: a script that moves it
    /// changes no more than that.
    fn draw_rigid(&self, svg: &mut Svg, frame: &Frame, pose: Pose, face: Face) {
        let place = |[x, y]: [f64; 2]| Some((frame.x.position(x)?, frame.y.position(y)?));
        let at = [0, 1].map(|d| pose.pivot[d] + pose.translation[d]);
        let (Some(pivot), Some(at)) = (place(pose.pivot), place(at)) else { return };
        let about = |(x, y): Place| (x - pivot.0, y - pivot.1);
        let edges: Vec<_> = self.places(frame).into_iter().map(|edge| edge.map(about)).collect();
        let degrees =
            Some(-pose.angle.to_degrees() % 360.0).filter(|d| d.is_finite()).unwrap_or(0.0);
        let transform = format!("translate({} {}) rotate({})", Px(at.0), Px(at.1), Px(degrees));
        let d = joined(&edges);
        svg.element("path", &[("class", &face.class()), ("transform", &transform), ("d", &d)]);
    }
}

fn path(svg: &mut Svg, class: &str, d: &str) {
    svg.element("path", &[("class", &class), ("d", &d)]);
}

/// Leaves out what lies outside of the plot, and of very many edges those that others hide.
fn thinned(mut edges: Vec<[Place; 3]>, frame: &Frame) -> Vec<[Place; 3]> {
    let outside = |c: [f64; 3], end: f64| c.iter().all(|c| *c < 0.0) || c.iter().all(|c| *c > end);
    edges.retain(|edge| {
        let (x, y) = (edge.map(|p| p.0), edge.map(|p| p.1));
        !outside(x, frame.width) && !outside(y, frame.height)
    });
    let mut spacing = 0.7;
    while edges.len() > MOST {
        let mut taken = HashSet::new();
        edges.retain(|[a, b, middle]| {
            let long = (a.0 - b.0).hypot(a.1 - b.1) > 3.0 * spacing;
            #[expect(clippy::cast_possible_truncation, reason = "places in a figure are small")]
            let bin = |c: f64| (c / spacing).floor() as i64;
            taken.insert((bin(middle.0), bin(middle.1))) || long
        });
        spacing *= 1.4;
    }
    edges
}

/// Each edge by itself.
fn separate(edges: &[[Place; 3]]) -> String {
    let mut d = String::new();
    for edge in edges {
        let [from, ..] = edge.map(tenths);
        let _ = write!(d, "M{} {}", Px(from.0), Px(from.1));
        curve(&mut d, edge);
    }
    d
}

/// Edges that follow each other as closed rings.
fn joined(edges: &[[Place; 3]]) -> String {
    let mut d = String::new();
    let mut last = None;
    for edge in edges {
        let [from, to, _] = edge.map(tenths);
        if last != Some(from) {
            let close = if last.is_some() { "z" } else { "" };
            let _ = write!(d, "{close}M{} {}", Px(from.0), Px(from.1));
        }
        curve(&mut d, edge);
        last = Some(to);
    }
    if last.is_some() { d + "z" } else { d }
}

/// The rest of an edge whose start stands; straight where the eye sees no difference.
///
/// The curve through the middle m has the control point 2m − (a + b)/2.
fn curve(d: &mut String, edge: &[Place; 3]) {
    let [a, b, m] = edge.map(tenths);
    let control = (2.0 * m.0 - 0.5 * (a.0 + b.0), 2.0 * m.1 - 0.5 * (a.1 + b.1));
    let bend = (m.0 - 0.5 * (a.0 + b.0)).hypot(m.1 - 0.5 * (a.1 + b.1));
    let to = (Px(b.0 - a.0), Px(b.1 - a.1));
    let _ = if bend <= 0.15 {
        write!(d, "l{} {}", to.0, to.1)
    } else {
        let control = tenths(control);
        write!(d, "q{} {} {} {}", Px(control.0 - a.0), Px(control.1 - a.1), to.0, to.1)
    };
}

fn tenths((x, y): Place) -> Place {
    ((x * 10.0).round() / 10.0, (y * 10.0).round() / 10.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::figure::Axis;

    fn frame() -> Frame {
        let scale = Axis::new("", "").fit([0.0, 10.0], 0.0, (0.0, 1.0));
        Frame::equal((400.0, 400.0), 0.0, 0.0, scale, scale)
    }

    #[test]
    fn a_curve_passes_through_its_middle() {
        let mut d = String::new();
        curve(&mut d, &[(0.0, 0.0), (4.0, 0.0), (2.0, 1.0)]);
        assert_eq!(d, "q2 2 4 0");
        let mut d = String::new();
        curve(&mut d, &[(1.0, 1.0), (5.0, 1.0), (3.0, 1.1)]);
        assert_eq!(d, "l4 0");
    }

    #[test]
    fn rings_are_closed() {
        let side = |a: Place, b: Place| [a, b, (f64::midpoint(a.0, b.0), f64::midpoint(a.1, b.1))];
        let [a, b, c] = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)];
        let ring = [side(a, b), side(b, c), side(c, a)];
        assert_eq!(joined(&ring), "M0 0l1 0l-1 1l0 -1z");
        assert_eq!(joined(&[ring, ring].concat()), "M0 0l1 0l-1 1l0 -1l1 0l-1 1l0 -1z");
        let far = ring.map(|edge| edge.map(|(x, y)| (x + 5.0, y)));
        assert_eq!(joined(&[ring, far].concat()), "M0 0l1 0l-1 1l0 -1zM5 0l1 0l-1 1l0 -1z");
        assert_eq!(joined(&[]), "");
    }

    /// A quarter of a million short edges and one long one: few remain, the long one among them.
    #[test]
    fn dense_edges_are_thinned_and_those_outside_left_out() {
        let frame = frame();
        let dot = |k: usize| {
            let (x, y) = ((k % 500) as f64 * frame.width / 500.0, (k / 500) as f64 * 0.5);
            [(x, y), (x + 0.1, y), (x + 0.05, y)]
        };
        let long = [(1.0, 1.0), (200.0, 1.0), (100.0, 1.0)];
        let outside = [(-5.0, 1.0), (-1.0, 1.0), (-3.0, 1.0)];
        let edges: Vec<_> = (0..250_000).map(dot).chain([outside, long]).collect();
        let kept = thinned(edges, &frame);
        assert!((1000..=MOST).contains(&kept.len()), "{}", kept.len());
        assert!(kept.contains(&long) && !kept.contains(&outside));
    }

    #[test]
    fn a_solid_is_drawn_about_its_pivot() {
        let edge = [[1.0, 2.0], [2.0, 2.0], [1.5, 2.0]];
        let solid = Curves::solid(vec![edge]).moved([1.0, 2.0], [1.0, 0.0], 0.5);
        let mut svg = Svg::default();
        let frame = frame();
        solid.draw(&mut svg, &frame);
        let unit = frame.width / 10.0;
        let at = format!("translate({} {}) rotate(-28.65)", Px(2.0 * unit), Px(8.0 * unit));
        assert!(svg.as_str().contains(&at), "{}", svg.as_str());
        assert!(svg.as_str().contains("d=\"M0 0l"), "{}", svg.as_str());
    }
}
