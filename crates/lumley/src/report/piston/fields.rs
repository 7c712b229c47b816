//! Pictures of the velocity over space and time.

use super::{PistonReport, RomResults, Trajectory, named};
use crate::report::figure::{Axis, Drawing, HeatMap, Series};
use crate::report::html::Section;

pub(super) fn section(report: &PistonReport) -> Section {
    let full = picture(report, &report.full, "velocity *v*");
    let limit = full.peak();
    let mut drawings = vec![full.limit(limit).draw(HEIGHT).titled("full model")];
    let mut caption = "Velocity *v*(*x*, *t*) of fluid and block together; the line is the \
        interface *X*(*t*), above which the block moves as one."
        .to_string();
    if let Some(best) = report.best() {
        let reduced = picture(report, &best.trajectory, "velocity *v*").limit(limit);
        drawings.push(reduced.draw(HEIGHT).titled(&named(best)));
        drawings.push(difference(report, best).draw(HEIGHT).titled("difference: reduced − full"));
        caption += " The most accurate reduced model has the same colours; the difference has its \
            own, and shows where the error lives.";
    }
    Section::new("Velocity in space and time")
        .figure(Drawing::stack(&drawings).figure("velocity", &caption))
}

const HEIGHT: f64 = 190.0;

fn picture(report: &PistonReport, model: &Trajectory, name: &str) -> HeatMap {
    let steps = whole_frames(report, model);
    image(report, steps, |k| model.field[k], name).overlay(Series::line(
        "",
        &report.times,
        &model.position,
    ))
}

fn difference(report: &PistonReport, model: &RomResults) -> HeatMap {
    let (reduced, full) = (&model.trajectory, &report.full);
    let steps = whole_frames(report, reduced).min(whole_frames(report, full));
    let picture = image(report, steps, |k| reduced.field[k] - full.field[k], "error in *v*")
        .overlay(Series::line("", &report.times, &full.position));
    let limit = picture.peak();
    picture.limit(limit)
}

/// The picture of the first `steps` frames: time runs to the right and x upwards, while a frame
/// follows a frame in `value`.
fn image(report: &PistonReport, steps: usize, value: impl Fn(usize) -> f64, name: &str) -> HeatMap {
    let nodes = report.fixed_grid.nodes.len();
    let value = &value;
    let values = (0..nodes).flat_map(|i| (0..steps).map(move |t| value(t * nodes + i))).collect();
    HeatMap::new(
        (Axis::new("time *t*", "s"), &report.times[..steps]),
        (Axis::new("position *x*", "m"), &report.fixed_grid.nodes),
        values,
    )
    .values(name, "m/s")
}

/// The number of frames that the model has completely.
pub(super) fn whole_frames(report: &PistonReport, model: &Trajectory) -> usize {
    model
        .field
        .len()
        .checked_div(report.fixed_grid.nodes.len())
        .unwrap_or(0)
        .min(report.times.len())
}
