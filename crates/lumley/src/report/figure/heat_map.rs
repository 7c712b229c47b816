//! A field over two axes as a picture.

use super::axis::{Axis, LARGEST, Scale};
use super::colour::ColourMap;
use super::curves::Curves;
use super::frame::{Frame, LABEL, RAISE, label_width, positions};
use super::raster;
use super::series::Series;
use super::svg::{Px, Svg};
use super::{Drawing, WIDTH};

/// Most pixels along one axis; finer data are sampled.
const PIXELS: usize = 480;

/// Width of the colour bar.
const BAR: f64 = 14.0;

/// Values over (x, y) as colours, with a colour bar and optional curves on top.
///
/// Signed values get a diverging map symmetric about zero, values of one sign a sequential one.
/// Each pixel has the value of the node nearest to it; non-finite values are transparent.
///
/// ```
/// use lumley::report::figure::{Axis, HeatMap, Series};
///
/// let (t, x) = ([0.0, 1.0], [0.0, 0.5, 1.0]);
/// let v = vec![0.0, 0.1, 0.0, -0.2, 0.0, 0.0]; // x by x, the time running fastest
/// let map = HeatMap::new((Axis::new("time *t*", "s"), &t), (Axis::new("*x*", "m"), &x), v)
///     .values("velocity *v*", "m/s")
///     .overlay(Series::line("interface", &t, &[0.9, 0.95]));
/// assert!(map.draw(200.0).figure("field", "").inline().contains("data:image/png"));
/// ```
#[derive(Debug, Clone)]
pub struct HeatMap {
    x: (Axis, Vec<f64>),
    y: (Axis, Vec<f64>),
    values: Vec<f64>,
    scale: Axis,
    shades: Shades,
    overlays: Vec<Series>,
    curves: Vec<Curves>,
}

/// Which values the colours stand for.
#[derive(Debug, Clone, Copy)]
enum Shades {
    /// All that there are.
    Fitted,
    /// Signed values up to this size.
    Signed(f64),
    /// Values from the first to the second.
    Between(f64, f64),
}

impl HeatMap {
    /// The picture of `values[j * x.len() + i]` at (`x[i]`, `y[j]`); nodes ascend.
    ///
    /// # Panics
    /// If there is not one value per node.
    pub fn new(x: (Axis, &[f64]), y: (Axis, &[f64]), values: Vec<f64>) -> Self {
        assert_eq!(values.len(), x.1.len() * y.1.len(), "one value for each node of the picture");
        Self {
            x: (x.0, x.1.to_vec()),
            y: (y.0, y.1.to_vec()),
            values,
            scale: Axis::new("", ""),
            shades: Shades::Fitted,
            overlays: Vec::new(),
            curves: Vec::new(),
        }
    }

    /// What the colours mean: name and unit, in markup.
    #[must_use]
    pub fn values(mut self, name: &str, unit: &str) -> Self {
        self.scale = Axis::new(name, unit);
        self
    }

    /// Fixes the diverging map to [−`limit`, `limit`], so that pictures can be compared; what is
    /// larger gets the last colour. A limit that is negative or not finite is ignored.
    #[must_use]
    pub fn limit(mut self, limit: f64) -> Self {
        if limit >= 0.0 && limit.is_finite() {
            self.shades = Shades::Signed(limit);
        }
        self
    }

    /// Fixes the sequential map to `lo` to `hi`, in the same way. A range that is empty or not finite is
    /// ignored.
    #[must_use]
    pub fn range(mut self, lo: f64, hi: f64) -> Self {
        if lo < hi && (hi - lo).is_finite() {
            self.shades = Shades::Between(lo, hi);
        }
        self
    }

    /// Draws a curve over the picture.
    #[must_use]
    pub fn overlay(mut self, series: Series) -> Self {
        self.overlays.push(series);
        self
    }

    /// Draws outlines over the picture, in the coordinates of its axes.
    #[must_use]
    pub fn curves(mut self, curves: Curves) -> Self {
        self.curves.push(curves);
        self
    }

    /// Largest |value|; 0 without finite values.
    pub fn peak(&self) -> f64 {
        self.values.iter().filter(|v| v.is_finite()).fold(0.0, |m, v| v.abs().max(m))
    }

    /// The picture at full width and the given height.
    pub fn draw(&self, height: f64) -> Drawing {
        self.draw_at(WIDTH, height)
    }

    /// The picture at a width of its own.
    pub fn draw_at(&self, width: f64, height: f64) -> Drawing {
        self.draw_in((width, height), Frame::new)
    }

    /// The picture with one unit of x as long as one of y, at most so wide and high.
    pub fn draw_equal(&self, width: f64, most: f64) -> Drawing {
        self.draw_in((width, most), Frame::equal)
    }

    fn draw_in(
        &self,
        (width, height): (f64, f64),
        frame: impl Fn((f64, f64), f64, f64, Scale, Scale) -> Frame,
    ) -> Drawing {
        let (map, colours) = self.colours();
        let mut svg = Svg::default();
        let (x, y) = self.scales();
        let labels = label_width(&colours.over((0.0, height)).ticks(36.0)).max(LABEL);
        let frame = frame((width, height), 0.0, BAR + 34.0 + labels, x, y);
        frame.draw(&mut svg, &self.x.0, &self.y.0);
        frame.plot(&mut svg, |svg| {
            if let Some(uri) = self.uri() {
                picture(svg, (0.0, 0.0, frame.width, frame.height), &uri);
            }
            self.curves.iter().for_each(|c| c.draw(svg, &frame));
            self.overlays.iter().for_each(|s| s.draw(svg, &frame));
        });
        self.draw_bar(&mut svg, &frame, map, colours);
        Drawing { width, height: frame.total_height(), svg }
    }

    fn scales(&self) -> (Scale, Scale) {
        let fit =
            |(axis, nodes): &(Axis, Vec<f64>)| axis.fit(nodes.iter().copied(), 0.0, (0.0, 1.0));
        (fit(&self.x), fit(&self.y))
    }

    /// The colour map and the scale of its values.
    fn colours(&self) -> (ColourMap, Scale) {
        let finite = || self.values.iter().copied().filter(|v| v.is_finite());
        let shades = match self.shades {
            Shades::Fitted if finite().any(|v| v < 0.0) => Shades::Signed(self.peak()),
            shades => shades,
        };
        let pixels = (0.0, 1.0);
        match shades {
            Shades::Signed(limit) => {
                let limit = limit.min(LARGEST);
                (ColourMap::Diverging, self.scale.fit([-limit, limit], 0.0, pixels))
            }
            Shades::Between(lo, hi) => {
                (ColourMap::Sequential, self.scale.fit([lo, hi], 0.0, pixels))
            }
            Shades::Fitted => {
                (ColourMap::Sequential, self.scale.fit(finite().chain([0.0]), 0.0, pixels))
            }
        }
    }

    /// The coloured values as the data URI of a picture, `None` where there are none.
    pub fn uri(&self) -> Option<String> {
        if self.values.is_empty() {
            return None;
        }
        let (map, colours) = self.colours();
        let (x, y) = self.scales();
        let columns = nearest_nodes(&self.x.1, x);
        let rows = nearest_nodes(&self.y.1, y);
        let value = |j: usize, i: usize| self.values[j * self.x.1.len() + i];
        let shade = |v: f64| colours.position(v).unwrap_or(f64::NAN);
        let pixels: Vec<f64> = rows
            .iter()
            .rev()
            .flat_map(|&j| columns.iter().map(move |&i| shade(value(j, i))))
            .collect();
        Some(raster::data_uri(size(&columns), size(&rows), &pixels, map))
    }

    /// The colour bar right of the plot, with its ticks and title.
    fn draw_bar(&self, svg: &mut Svg, frame: &Frame, map: ColourMap, colours: Scale) {
        let left = frame.left + frame.width + 18.0;
        let shades: Vec<f64> = (0..256).map(|k| 1.0 - f64::from(k) / 255.0).collect();
        let uri = raster::data_uri(1, 256, &shades, map);
        picture(svg, (left, frame.top, BAR, frame.height), &uri);
        let scale = colours.over((frame.height, 0.0));
        let ticks = scale.ticks(36.0);
        for (position, label) in positions(scale, &ticks) {
            let at = frame.top + position;
            svg.line((left + BAR, at), (left + BAR + 4.0, at), "axis");
            svg.text(left + BAR + 8.0, at + 4.0, "key", label);
        }
        let end = left + BAR + 16.0 + label_width(&ticks).max(LABEL);
        svg.text(end, frame.top - RAISE, "title end", &self.scale.title(ticks.exponent));
    }
}

/// An embedded picture stretched over a rectangle (left, top, width, height).
fn picture(svg: &mut Svg, (x, y, width, height): (f64, f64, f64, f64), uri: &str) {
    svg.element(
        "image",
        &[
            ("x", &Px(x)),
            ("y", &Px(y)),
            ("width", &Px(width)),
            ("height", &Px(height)),
            ("preserveAspectRatio", &"none"),
            ("href", &uri),
        ],
    );
}

/// For each pixel along an axis, the index of the node nearest to its centre.
fn nearest_nodes(nodes: &[f64], scale: Scale) -> Vec<usize> {
    let count = nodes.len().min(PIXELS);
    (0..count)
        .map(|p| {
            let at = scale.value((p as f64 + 0.5) / count as f64);
            let after = nodes.partition_point(|&node| node < at).clamp(1, nodes.len().max(2) - 1);
            let before = after - 1;
            let closer = nodes.get(after).is_some_and(|&node| node - at < at - nodes[before]);
            if closer { after } else { before }
        })
        .collect()
}

fn size(indices: &[usize]) -> u32 {
    u32::try_from(indices.len()).expect("at most PIXELS")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scale(nodes: &[f64]) -> Scale {
        Axis::new("", "").fit(nodes.iter().copied(), 0.0, (0.0, 1.0))
    }

    #[test]
    fn pixels_take_the_nearest_node_also_of_uneven_ones() {
        let nodes = [0.0, 1.0, 2.0, 3.0];
        assert_eq!(nearest_nodes(&nodes, scale(&nodes)), [0, 1, 2, 3]);
        let nodes = [0.0, 0.1, 0.2, 4.0];
        assert_eq!(nearest_nodes(&nodes, scale(&nodes)), [2, 2, 3, 3]);
        assert_eq!(nearest_nodes(&[5.0], scale(&[5.0])), [0]);
        assert!(nearest_nodes(&[], scale(&[])).is_empty());
    }

    #[test]
    fn sign_decides_the_map() {
        let map = |v: Vec<f64>| {
            HeatMap::new((Axis::new("", ""), &[0.0, 1.0]), (Axis::new("", ""), &[0.0]), v).colours()
        };
        let (kind, scale) = map(vec![-2.0, 1.0]);
        assert_eq!((kind, scale.range()), (ColourMap::Diverging, (-2.0, 2.0)));
        let (kind, scale) = map(vec![3.0, f64::NAN]);
        assert_eq!((kind, scale.range()), (ColourMap::Sequential, (0.0, 3.0)));
    }
}
