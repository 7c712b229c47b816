//! One curve of a chart.

use super::frame::Frame;
use super::path;
use super::svg::{Px, Svg};

/// Which colour a curve has: the ink of the text, or one of [`COLOURS`] of a palette that readers
/// with colour blindness can tell apart (Okabe and Ito, 2008).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ink {
    Text,
    Palette(usize),
}

/// Number of palette colours; after them they repeat.
pub(super) const COLOURS: usize = 6;

impl Ink {
    /// The class that `figure.css` colours.
    pub(super) fn class(self) -> String {
        match self {
            Self::Text => "s0".into(),
            Self::Palette(k) => format!("s{}", k % COLOURS + 1),
        }
    }
}

/// How the points of a curve are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stroke {
    /// Thick and pale, to be seen under other lines.
    Reference,
    Line,
    Dashed,
    Marked,
    Points,
    /// A line, and a wash between it and the foot of the plot.
    Area,
}

/// One curve: a name for the legend, points, and a look.
///
/// A point that is not finite, or not positive on a logarithmic axis, is a gap.
///
/// ```
/// use lumley::report::figure::Series;
///
/// let position = Series::reference("full model", &[0.0, 0.01], &[0.9, 0.9008]);
/// let reduced = Series::line("mapped, *N* = 6", &[0.0, 0.01], &[0.9, f64::NAN]).colour(0);
/// # let _ = (position, reduced);
/// ```
#[derive(Debug, Clone)]
pub struct Series {
    pub(super) name: String,
    pub(super) x: Vec<f64>,
    pub(super) y: Vec<f64>,
    pub(super) ink: Ink,
    pub(super) stroke: Stroke,
}

impl Series {
    fn new(name: &str, x: &[f64], y: &[f64], ink: Ink, stroke: Stroke) -> Self {
        let shared = x.len().min(y.len());
        Self { name: name.into(), x: x[..shared].to_vec(), y: y[..shared].to_vec(), ink, stroke }
    }

    /// A thick pale line for what the others are compared with. The longer of `x` and `y` is cut
    /// to the shorter, here as for every series: a model that blew up has fewer points.
    pub fn reference(name: &str, x: &[f64], y: &[f64]) -> Self {
        Self::new(name, x, y, Ink::Text, Stroke::Reference)
    }

    /// A thin line.
    pub fn line(name: &str, x: &[f64], y: &[f64]) -> Self {
        Self::new(name, x, y, Ink::Text, Stroke::Line)
    }

    /// A dashed line.
    pub fn dashed(name: &str, x: &[f64], y: &[f64]) -> Self {
        Self::new(name, x, y, Ink::Text, Stroke::Dashed)
    }

    /// A line with a marker at every point, for few points.
    pub fn marked(name: &str, x: &[f64], y: &[f64]) -> Self {
        Self::new(name, x, y, Ink::Text, Stroke::Marked)
    }

    /// Markers without a line.
    pub fn points(name: &str, x: &[f64], y: &[f64]) -> Self {
        Self::new(name, x, y, Ink::Text, Stroke::Points)
    }

    /// A thin line and a wash below it, for histograms.
    pub fn area(name: &str, x: &[f64], y: &[f64]) -> Self {
        Self::new(name, x, y, Ink::Text, Stroke::Area)
    }

    /// The `k`-th colour of the palette instead of the text's, and the `k`-th marker.
    #[must_use]
    pub fn colour(mut self, k: usize) -> Self {
        self.ink = Ink::Palette(k);
        self
    }

    /// Draws the curve in the coordinates of the plot.
    pub(super) fn draw(&self, svg: &mut Svg, frame: &Frame) {
        let position = |(&x, &y)| Some((frame.x.position(x)?, frame.y.position(y)?));
        let points: Vec<_> = self.x.iter().zip(&self.y).map(position).collect();
        if self.stroke == Stroke::Area {
            self.draw_wash(svg, frame, &points);
        }
        if self.stroke != Stroke::Points {
            svg.element("path", &[("class", &self.class()), ("d", &path::through(&points))]);
        }
        if matches!(self.stroke, Stroke::Marked | Stroke::Points) {
            svg.wrap("g", &[("class", &self.ink.class())], |svg| {
                points.iter().flatten().for_each(|&at| marker(svg, self.ink, at));
            });
        }
    }

    /// What lies below the curve; gaps are passed over.
    fn draw_wash(&self, svg: &mut Svg, frame: &Frame, points: &[path::Point]) {
        let drawn: Vec<path::Point> = points.iter().filter(|p| p.is_some()).copied().collect();
        let (Some(Some(first)), Some(Some(last))) = (drawn.first(), drawn.last()) else { return };
        let foot = Px(frame.height);
        let d = format!("{}L{} {foot}L{} {foot}z", path::through(&drawn), Px(last.0), Px(first.0));
        svg.element("path", &[("class", &format!("area {}", self.ink.class())), ("d", &d)]);
    }

    /// Draws the sample of the legend, 22 units wide, around the height `y`.
    pub(super) fn draw_sample(&self, svg: &mut Svg, x: f64, y: f64) {
        if self.stroke != Stroke::Points {
            let d = format!("M{} {}h22", Px(x), Px(y));
            svg.element("path", &[("class", &self.class()), ("d", &d)]);
        }
        if matches!(self.stroke, Stroke::Marked | Stroke::Points) {
            let at = (x + 11.0, y);
            svg.wrap("g", &[("class", &self.ink.class())], |svg| marker(svg, self.ink, at));
        }
    }

    fn class(&self) -> String {
        let stroke = match self.stroke {
            Stroke::Reference => "line ref",
            Stroke::Dashed => "line dash",
            _ => "line",
        };
        format!("{stroke} {}", self.ink.class())
    }
}

/// A marker whose shape goes with the colour, so that either tells the curves apart.
fn marker(svg: &mut Svg, ink: Ink, (x, y): (f64, f64)) {
    let shape = match ink {
        Ink::Text => 0,
        Ink::Palette(k) => k % COLOURS + 1,
    };
    let d = match shape {
        0 => "m-3.6 0a3.6 3.6 0 1 0 7.2 0a3.6 3.6 0 1 0 -7.2 0",
        1 => "m-3.3 -3.3h6.6v6.6h-6.6z",
        2 => "m0 -4.4l4 7h-8z",
        3 => "m0 -4.6l4.6 4.6l-4.6 4.6l-4.6 -4.6z",
        4 => "m0 4.4l4 -7h-8z",
        5 => "m-4.4 -1.3h3.1v-3.1h2.6v3.1h3.1v2.6h-3.1v3.1h-2.6v-3.1h-3.1z",
        _ => "m-4.4 0l4.4 -2.6l4.4 2.6l-4.4 2.6z",
    };
    svg.element("path", &[("class", &"mark"), ("d", &format!("M{} {}{d}", Px(x), Px(y)))]);
}
