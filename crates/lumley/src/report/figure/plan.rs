//! A plane with curves in it, at equal scales: meshes and outlines.

use super::axis::Axis;
use super::curves::Curves;
use super::frame::Frame;
use super::legend::{self, Entry};
use super::svg::{Px, Svg};
use super::{Drawing, WIDTH};

/// Curves over a rectangle of the plane, one metre across as long as one metre up.
///
/// ```
/// use lumley::report::figure::{Curves, Plan};
///
/// let edge = [[0.0, 0.0], [2.0, 1.0], [1.0, 0.5]];
/// let plan = Plan::new([0.0, 0.0], [2.0, 1.0]).curves(Curves::line("wall", vec![edge]).colour(0));
/// assert!(plan.draw(500.0).figure("mesh", "A wall.").inline().contains("wall"));
/// ```
#[derive(Debug, Clone)]
pub struct Plan {
    x: Axis,
    y: Axis,
    layers: Vec<Curves>,
    legend: bool,
}

impl Plan {
    /// The empty rectangle from `lower` to `upper`, in m.
    pub fn new(lower: [f64; 2], upper: [f64; 2]) -> Self {
        let axis = |name: &str, d: usize| Axis::new(name, "m").range(lower[d], upper[d]);
        Self { x: axis("*x*", 0), y: axis("*y*", 1), layers: Vec::new(), legend: true }
    }

    /// Adds curves; later ones are drawn on top.
    #[must_use]
    pub fn curves(mut self, curves: Curves) -> Self {
        self.layers.push(curves);
        self
    }

    /// Leaves the legend out, for plans below one that has it.
    #[must_use]
    pub fn without_legend(mut self) -> Self {
        self.legend = false;
        self
    }

    /// The plan at full width and at most so high.
    pub fn draw(&self, most: f64) -> Drawing {
        let mut svg = Svg::default();
        let named = self.layers.iter().filter(|_| self.legend).map(Entry::of_curves);
        let head = legend::draw(&mut svg, WIDTH, &named.collect::<Vec<_>>());
        let (x, y) = (self.x.fit([], 0.0, (0.0, 1.0)), self.y.fit([], 0.0, (0.0, 1.0)));
        let frame = Frame::equal((WIDTH, most), head, 14.0, x, y);
        frame.draw(&mut svg, &self.x, &self.y);
        frame.plot(&mut svg, |svg| {
            // The lines of the grid would look like lines of the mesh.
            let size = (Px(frame.width), Px(frame.height));
            svg.element("rect", &[("class", &"sheet"), ("width", &size.0), ("height", &size.1)]);
            self.layers.iter().for_each(|c| c.draw(svg, &frame));
        });
        Drawing { width: WIDTH, height: frame.total_height(), svg }
    }
}
