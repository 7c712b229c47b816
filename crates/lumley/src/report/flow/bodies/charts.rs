//! Each coordinate over time, the load along it, and one against the other.

use super::super::FlowReport;
use super::super::loads::settled_range;
use super::data::interpolate;
use super::quantity::{LoadAlong, Quantity, load_along};
use super::{BodyMotion, CoordinateMotion};
use crate::report::figure::{Axis, Drawing, Figure, LineChart, Series};
use crate::report::literal;

/// Most coordinates that get curves.
const COORDINATES: usize = 8;

/// Width of a panel, and the heights of one over time and of one against a coordinate.
const WIDTH: f64 = 346.0;
const OVER_TIME: f64 = 180.0;
const AGAINST: f64 = 270.0;

/// Part of the longest way of all coordinates, and angle in rad, below which a coordinate is taken for at rest.
const REST: f64 = 1e-3;
const REST_ANGLE: f64 = 1e-4;

/// A figure for each coordinate that moves.
pub(super) fn figures(report: &FlowReport) -> Vec<Figure> {
    let bodies = report.bodies.bodies.iter();
    let all = bodies.flat_map(|body| body.coordinates.iter().map(move |c| (body, c)));
    let all: Vec<(&BodyMotion, &CoordinateMotion)> = all.collect();
    let ways = all.iter().filter(|(_, c)| c.name != "angle").map(|(_, c)| way(&c.position));
    let longest = ways.fold(0.0, f64::max);
    let least = |c: &CoordinateMotion| if c.name == "angle" { REST_ANGLE } else { REST * longest };
    let moving = all.iter().filter(|(_, c)| way(&c.position) > least(c)).take(COORDINATES);
    let charts = moving.map(|(body, coordinate)| Chart::new(report, body, coordinate));
    (1..).zip(charts).map(|(k, chart)| chart.figure(k)).collect()
}

/// From the smallest to the largest of the values.
fn ends(values: &[f64]) -> (f64, f64) {
    let nothing = (f64::INFINITY, f64::NEG_INFINITY);
    values.iter().fold(nothing, |(low, high), v| (low.min(*v), high.max(*v)))
}

fn way(position: &[f64]) -> f64 {
    let (low, high) = ends(position);
    high - low
}

/// A coordinate, and what acts along it.
struct Chart<'a> {
    times: &'a [f64],
    body: &'a BodyMotion,
    coordinate: &'a CoordinateMotion,
    quantity: Quantity,
    load: Option<LoadAlong>,
    load_times: &'a [f64],
}

impl<'a> Chart<'a> {
    fn new(report: &'a FlowReport, body: &'a BodyMotion, coordinate: &'a CoordinateMotion) -> Self {
        let load = load_along(report, body, &coordinate.name);
        Self {
            times: &report.bodies.times,
            body,
            coordinate,
            quantity: Quantity::of(&coordinate.name),
            load: load.filter(|load| load.values.len() > 1),
            load_times: &report.load_times,
        }
    }

    fn figure(&self, k: usize) -> Figure {
        let panels = match &self.load {
            None => vec![self.over_time(AGAINST), self.phase()],
            Some(load) => vec![
                self.over_time(OVER_TIME),
                self.load_over_time(load),
                self.phase(),
                self.load_against_it(load),
            ],
        };
        Drawing::panels(2, &panels).figure(&format!("motion-{k}"), &self.caption())
    }

    fn caption(&self) -> String {
        let Self { quantity: Quantity { symbol, .. }, body, load, .. } = self;
        let name = literal(&body.setup.name);
        let last = match self.window() {
            None => "",
            Some(_) => " The last periods are those of the numbers below.",
        };
        match load {
            None => format!(
                "Motion of {name}: {symbol} over time, and its velocity against it. A motion that repeats \
                 itself closes there.{last}"
            ),
            Some(_) => format!(
                "Motion of {name}: {symbol} and the load along it over time; below, velocity and load against \
                 {symbol}. A motion that repeats itself closes there; the area that the load goes round, \
                 clockwise, stands for the work of the fluid.{last}"
            ),
        }
    }

    fn over_time(&self, height: f64) -> Drawing {
        let Quantity { symbol, unit, .. } = self.quantity;
        let name = format!("{symbol} of {}", literal(&self.body.setup.name));
        LineChart::new(Axis::new("time *t*", "s"), Axis::new(&name, unit))
            .series(Series::line("", self.times, &self.coordinate.position).colour(0))
            .draw_at(WIDTH, height)
    }

    fn load_over_time(&self, load: &LoadAlong) -> Drawing {
        LineChart::new(Axis::new("time *t*", "s"), load_axis(load))
            .series(Series::line("", self.load_times, &load.values).colour(0))
            .draw_at(WIDTH, OVER_TIME)
    }

    fn phase(&self) -> Drawing {
        let Quantity { rate, rate_unit, .. } = self.quantity;
        let curve = (&*self.coordinate.position, &*self.coordinate.velocity);
        self.against_it(Axis::new(rate, rate_unit), self.times, curve)
    }

    fn load_against_it(&self, load: &LoadAlong) -> Drawing {
        let position: Vec<[f64; 1]> = self.coordinate.position.iter().map(|q| [*q]).collect();
        let at = |&t: &f64| interpolate(self.times, &position, t).map_or(f64::NAN, |[q]| q);
        let position: Vec<f64> = self.load_times.iter().map(at).collect();
        self.against_it(load_axis(load), self.load_times, (&position, &load.values))
    }

    /// A curve in the plane of the coordinate and another quantity: the whole run and, where there are any, its
    /// last periods.
    fn against_it(&self, y: Axis, times: &[f64], (along, other): (&[f64], &[f64])) -> Drawing {
        let Quantity { symbol, unit, .. } = self.quantity;
        let ((low, high), space) = (ends(along), 0.05 * way(along));
        let chart = LineChart::new(Axis::new(symbol, unit).range(low - space, high + space), y);
        let chart = match self.window() {
            None => chart.series(Series::line("", along, other).colour(0)),
            Some([start, end]) => {
                let from = times.partition_point(|t| *t < start);
                let to = times.partition_point(|t| *t <= end);
                let last = |values: &[f64]| values.get(from..to).unwrap_or_default().to_vec();
                chart
                    .series(Series::line("whole run", along, other).colour(5))
                    .series(Series::line("last periods", &last(along), &last(other)).colour(1))
            }
        };
        chart.draw_at(WIDTH, AGAINST)
    }

    /// The last full periods of the body.
    fn window(&self) -> Option<[f64; 2]> {
        self.body.numbers.window.filter(|_| self.body.numbers.periods > 0)
    }
}

/// An axis without the peak of an impulsive start.
fn load_axis(load: &LoadAlong) -> Axis {
    let axis = Axis::new(load.name, load.unit);
    settled_range(&load.values).map_or(axis.clone(), |(lo, hi)| axis.range(lo, hi))
}
