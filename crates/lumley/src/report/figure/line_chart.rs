//! Curves over a common axis.

use super::axis::Axis;
use super::frame::Frame;
use super::legend::{self, Entry};
use super::series::Series;
use super::svg::{Px, Svg};
use super::{Drawing, WIDTH};

/// Curves with axes, legend, an optional shaded band and an optional level to compare with.
///
/// ```
/// use lumley::report::figure::{Axis, LineChart, Series};
///
/// let (modes, error) = ([1.0, 2.0, 3.0], [38.6, 8.9, 3.6]);
/// let chart = LineChart::new(Axis::new("modes *N*", "").count(), Axis::new("Res", "%").log())
///     .series(Series::marked("projection", &modes, &error).colour(0))
///     .level(4.0, "4 %");
/// let figure = chart.draw(300.0).figure("residual", "Error against the number of modes.");
/// assert!(figure.file().1.starts_with("<svg"));
/// ```
#[derive(Debug, Clone)]
pub struct LineChart {
    x: Axis,
    y: Axis,
    series: Vec<Series>,
    band: Option<(f64, f64, String)>,
    level: Option<(f64, String)>,
    mark: Option<(f64, String)>,
    legend: bool,
}

impl LineChart {
    /// An empty chart.
    pub fn new(x: Axis, y: Axis) -> Self {
        Self { x, y, series: Vec::new(), band: None, level: None, mark: None, legend: true }
    }

    /// Adds a curve; later ones are drawn on top.
    #[must_use]
    pub fn series(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// Shades `from` ≤ x ≤ `to`, named in the legend unless `name` is empty.
    #[must_use]
    pub fn band(mut self, from: f64, to: f64, name: &str) -> Self {
        self.band = Some((from, to, name.into()));
        self
    }

    /// A fine horizontal line at `y`, labelled at its right end.
    #[must_use]
    pub fn level(mut self, y: f64, label: &str) -> Self {
        self.level = Some((y, label.into()));
        self
    }

    /// A fine vertical line at `x`, labelled at its top.
    #[must_use]
    pub fn mark(mut self, x: f64, label: &str) -> Self {
        self.mark = Some((x, label.into()));
        self
    }

    /// Leaves the legend out, for panels that share one.
    #[must_use]
    pub fn without_legend(mut self) -> Self {
        self.legend = false;
        self
    }

    /// The legend alone, to stand above panels that share it.
    pub fn legend(&self) -> Drawing {
        let mut svg = Svg::default();
        let height = legend::draw(&mut svg, WIDTH, &self.entries());
        Drawing { width: WIDTH, height, svg }
    }

    /// The chart at full width and the given height.
    pub fn draw(&self, height: f64) -> Drawing {
        self.draw_at(WIDTH, height)
    }

    /// The chart at a width of its own, for panels side by side.
    pub fn draw_at(&self, width: f64, height: f64) -> Drawing {
        let mut svg = Svg::default();
        let entries = if self.legend { self.entries() } else { Vec::new() };
        let head = legend::draw(&mut svg, width, &entries);
        let abscissae = self.series.iter().flat_map(|s| s.x.iter().copied());
        let ordinates = self.series.iter().flat_map(|s| s.y.iter().copied());
        let x = self.x.fit(abscissae, 0.0, (0.0, 1.0));
        let y = self.y.fit(ordinates.chain(self.level.iter().map(|l| l.0)), 0.05, (0.0, 1.0));
        let frame = Frame::new((width, height), head, 14.0, x, y);
        frame.draw(&mut svg, &self.x, &self.y);
        frame.plot(&mut svg, |svg| {
            self.draw_band(svg, &frame);
            self.draw_level(svg, &frame);
            self.draw_mark(svg, &frame);
            self.series.iter().for_each(|s| s.draw(svg, &frame));
        });
        Drawing { width, height, svg }
    }

    /// The series, then the band.
    fn entries(&self) -> Vec<Entry<'_>> {
        let band = self.band.iter().map(|(_, _, name)| Entry::of_band(name));
        self.series.iter().map(Entry::of_series).chain(band).collect()
    }

    fn draw_band(&self, svg: &mut Svg, frame: &Frame) {
        let Some((from, to, _)) = self.band else { return };
        let (Some(from), Some(to)) = (frame.x.position(from), frame.x.position(to)) else { return };
        svg.element(
            "rect",
            &[
                ("class", &"band"),
                ("x", &Px(from)),
                ("y", &Px(0.0)),
                ("width", &Px((to - from).max(0.0))),
                ("height", &Px(frame.height)),
            ],
        );
    }

    fn draw_level(&self, svg: &mut Svg, frame: &Frame) {
        let Some((y, label)) = &self.level else { return };
        let Some(at) = frame.y.position(*y) else { return };
        svg.line((0.0, at), (frame.width, at), "level");
        svg.text(frame.width - 4.0, at - 5.0, "end", label);
    }

    /// The label stands on the side where there is more room.
    fn draw_mark(&self, svg: &mut Svg, frame: &Frame) {
        let Some((x, label)) = &self.mark else { return };
        let Some(at) = frame.x.position(*x) else { return };
        svg.line((at, 0.0), (at, frame.height), "level");
        let left = at > 0.6 * frame.width;
        let (place, class) = if left { (at - 6.0, "end") } else { (at + 6.0, "key") };
        svg.text(place, 13.0, class, label);
    }
}
