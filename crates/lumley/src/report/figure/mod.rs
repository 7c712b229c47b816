//! Figures: curves and pictures as SVG, written without a plotting library.
//!
//! A chart ([`LineChart`], [`HeatMap`], [`Plan`]) is drawn into a [`Drawing`]; drawings are stacked or set in
//! panels; with a name and a caption a drawing becomes a [`Figure`], which stands in a page or in
//! a file of its own. Texts are in markup: `*x*` is italic, `_{F}` a subscript, `^{2}` a
//! superscript; text from a user goes through [`literal`](crate::report::literal) first.

mod axis;
mod colour;
mod curves;
mod frame;
mod heat_map;
mod legend;
mod line_chart;
mod path;
mod plan;
mod raster;
mod series;
mod svg;
mod ticks;

pub use axis::Axis;
pub use curves::Curves;
pub use heat_map::HeatMap;
pub use line_chart::LineChart;
pub use plan::Plan;
pub use series::Series;

use self::frame::FONT;
use self::svg::{Px, Svg};
use super::markup;

/// Width of a figure, in user units (the text is 12 of them high).
pub const WIDTH: f64 = 720.0;

/// The style of every figure, for light backgrounds.
pub(super) const STYLE: &str = include_str!("figure.css");

/// A drawing of known size.
///
/// ```
/// use lumley::report::figure::{Axis, Drawing, LineChart};
///
/// let panel = |k| LineChart::new(Axis::new("*t*", "s"), Axis::new(k, "")).draw_at(340.0, 180.0);
/// let both = Drawing::panels(2, &[panel("*a*_{1}"), panel("*a*_{2}")]);
/// assert_eq!((both.width(), both.height()), (720.0, 180.0));
/// ```
#[derive(Debug, Clone)]
pub struct Drawing {
    width: f64,
    height: f64,
    svg: Svg,
}

impl Drawing {
    /// Width in user units.
    pub fn width(&self) -> f64 {
        self.width
    }

    /// Height in user units.
    pub fn height(&self) -> f64 {
        self.height
    }

    /// Drawings below each other.
    pub fn stack(drawings: &[Drawing]) -> Drawing {
        Self::panels(1, drawings)
    }

    /// Drawings in rows of `columns`, spread over the full width, row by row.
    ///
    /// # Panics
    /// If `columns` is 0.
    pub fn panels(columns: usize, drawings: &[Drawing]) -> Drawing {
        const GAP: f64 = 14.0;
        let mut out = Drawing { width: WIDTH, height: 0.0, svg: Svg::default() };
        for row in drawings.chunks(columns) {
            let top = if out.height > 0.0 { out.height + GAP } else { 0.0 };
            let used: f64 = row.iter().map(Drawing::width).sum();
            let space = (WIDTH - used).max(0.0) / columns.saturating_sub(1).max(1) as f64;
            let mut left = 0.0;
            for drawing in row {
                out.svg.place(left, top, &drawing.svg);
                left += drawing.width + space;
            }
            out.height = row.iter().map(Drawing::height).fold(top, |h, d| h.max(top + d));
        }
        out
    }

    /// The drawing below a heading, in markup.
    #[must_use]
    pub fn titled(self, title: &str) -> Drawing {
        let mut svg = Svg::default();
        svg.text(0.0, FONT, "title", title);
        svg.place(0.0, 2.0 * FONT, &self.svg);
        Drawing { width: self.width, height: self.height + 2.0 * FONT, svg }
    }

    /// The figure `name` (a file name without its extension) with a `caption` in markup that says
    /// what to see.
    pub fn figure(self, name: &str, caption: &str) -> Figure {
        Figure { name: name.into(), caption: caption.into(), drawing: self }
    }
}

/// A drawing with a name and a caption.
///
/// ```
/// use lumley::report::figure::{Axis, LineChart};
///
/// let chart = LineChart::new(Axis::new("*t*", "s"), Axis::new("*X*", "m"));
/// let (name, svg) = chart.draw(240.0).figure("motion", "Motion of the *body*.").file();
/// assert_eq!(name, "motion.svg");
/// assert!(svg.contains("<title>Motion of the body.</title>"));
/// ```
#[derive(Debug, Clone)]
pub struct Figure {
    name: String,
    caption: String,
    drawing: Drawing,
}

impl Figure {
    /// Caption in markup.
    pub fn caption(&self) -> &str {
        &self.caption
    }

    /// Name without extension.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The figure as an element of a page that holds the style of figures.
    pub fn inline(&self) -> String {
        let mut svg = Svg::default();
        let label = markup::plain(&self.caption);
        let view = self.view();
        svg.wrap(
            "svg",
            &[("class", &"fig"), ("viewBox", &view), ("role", &"img"), ("aria-label", &label)],
            |svg| svg.append(&self.drawing.svg),
        );
        svg.as_str().into()
    }

    /// File name and text of the figure as a file of its own: dark on white, whatever the viewer.
    pub fn file(&self) -> (String, String) {
        let Drawing { width, height, svg } = &self.drawing;
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"fig\" viewBox=\"{}\" width=\"{}\" \
             height=\"{}\">\n<title>{}</title>\n<style>\n{STYLE}</style>\n\
             <rect x=\"-10\" y=\"-6\" width=\"{}\" height=\"{}\" fill=\"#fff\"/>\n{}\n</svg>\n",
            self.view(),
            Px(width + 20.0),
            Px(height + 12.0),
            markup::escape(&markup::plain(&self.caption)),
            Px(width + 20.0),
            Px(height + 12.0),
            svg.as_str(),
        );
        (format!("{}.svg", self.name), text)
    }

    fn view(&self) -> String {
        let Drawing { width, height, .. } = &self.drawing;
        format!("-10 -6 {} {}", Px(width + 20.0), Px(height + 12.0))
    }
}
