//! The frame of a chart: the plot's rectangle with ticks, grid lines and titles.

use super::axis::{Axis, Scale};
use super::svg::{Px, Svg};
use super::ticks::Ticks;
use crate::report::markup;

/// Size of the figures' text, in user units; `figure.css` says the same.
pub(super) const FONT: f64 = 12.0;

/// Height kept below the plot for tick labels and the title of the horizontal axis.
const FOOT: f64 = 40.0;

/// Height kept above the plot for the title of the vertical axis, and how far above it stands.
const TITLE: f64 = 26.0;
pub(super) const RAISE: f64 = 12.0;

/// Width kept for the shortest tick labels, so that plots above each other are aligned.
pub(super) const LABEL: f64 = 30.0;

/// The plot's rectangle within a drawing, with its scales.
#[derive(Debug, Clone)]
pub(super) struct Frame {
    pub left: f64,
    pub top: f64,
    pub width: f64,
    pub height: f64,
    /// Positions across the plot, from 0 at its left.
    pub x: Scale,
    /// Positions down the plot, from 0 at its top.
    pub y: Scale,
    x_ticks: Ticks,
    y_ticks: Ticks,
}

impl Frame {
    /// Lays a plot out in `width` × `height`, below a head and left of a margin, both given; the
    /// left margin follows from the tick labels.
    pub(super) fn new(
        (width, height): (f64, f64),
        head: f64,
        right: f64,
        x: Scale,
        y: Scale,
    ) -> Self {
        let top = head + TITLE;
        let inner = (height - top - FOOT).max(10.0);
        let y = y.over((inner, 0.0));
        let y_ticks = y.ticks(36.0);
        let left = label_width(&y_ticks).max(LABEL) + 10.0;
        let across = (width - left - right).max(10.0);
        let x = x.over((0.0, across));
        let x_ticks = x.ticks(60.0);
        Self { left, top, width: across, height: inner, x, y, x_ticks, y_ticks }
    }

    /// The same with one unit of x as long as one of y, in at most the given height; extremely flat and
    /// tall plots are less so.
    pub(super) fn equal(
        (width, most): (f64, f64),
        head: f64,
        right: f64,
        x: Scale,
        y: Scale,
    ) -> Self {
        let frame = Self::new((width, most), head, right, x, y);
        let ratio = (y.length() / x.length()).clamp(0.04, 25.0);
        let across = frame.width.min(frame.height / ratio);
        let (x, y) = (x.over((0.0, across)), y.over((across * ratio, 0.0)));
        let (x_ticks, y_ticks) = (x.ticks(60.0), y.ticks(36.0));
        Self { width: across, height: across * ratio, x, y, x_ticks, y_ticks, ..frame }
    }

    /// Height of the whole drawing.
    pub(super) fn total_height(&self) -> f64 {
        self.top + self.height + FOOT
    }

    /// Draws grid, ticks and titles; the vertical axis is titled above its top end, where it can
    /// be read without turning the head.
    pub(super) fn draw(&self, svg: &mut Svg, x: &Axis, y: &Axis) {
        let (bottom, right) = (self.top + self.height, self.left + self.width);
        for (position, label) in positions(self.y, &self.y_ticks) {
            let at = self.top + position;
            svg.line((self.left, at), (right, at), "grid");
            svg.text(self.left - 7.0, at + 4.0, "end", label);
        }
        for (position, label) in positions(self.x, &self.x_ticks) {
            let at = self.left + position;
            svg.line((at, bottom), (at, bottom + 4.0), "axis");
            svg.text(at, bottom + 17.0, "mid", label);
        }
        svg.line((self.left, bottom), (right, bottom), "axis");
        svg.text(0.0, self.top - RAISE, "title", &y.title(self.y_ticks.exponent));
        svg.text(right, bottom + 34.0, "title end", &x.title(self.x_ticks.exponent));
    }

    /// What `content` draws, clipped to the plot, in coordinates from the plot's upper left
    /// corner; a nested `svg` clips without an identifier that could clash in a page.
    ///
    /// The ranges of linear axes stand on the element for scripts.
    pub(super) fn plot(&self, svg: &mut Svg, content: impl FnOnce(&mut Svg)) {
        let ((x0, x1), (y0, y1)) = (self.x.range(), self.y.range());
        svg.wrap(
            "svg",
            &[
                ("class", &"plot"),
                ("x", &Px(self.left)),
                ("y", &Px(self.top)),
                ("width", &Px(self.width)),
                ("height", &Px(self.height)),
                ("data-range", &format!("{x0:e} {x1:e} {y0:e} {y1:e}")),
            ],
            content,
        );
    }
}

/// Width of the widest label.
pub(super) fn label_width(ticks: &Ticks) -> f64 {
    ticks.labels.iter().map(|l| FONT * markup::width(l)).fold(0.0, f64::max)
}

/// Positions and labels of the ticks that can be drawn.
pub(super) fn positions(scale: Scale, ticks: &Ticks) -> impl Iterator<Item = (f64, &str)> {
    let at = move |(&v, label): (&f64, _)| Some((scale.position(v)?, label));
    ticks.values.iter().zip(ticks.labels.iter().map(String::as_str)).filter_map(at)
}
