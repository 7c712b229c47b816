//! The velocity profile at one time, and a slider that moves the time where scripts run.

use serde_json::{Value, json};

use super::fields::whole_frames;
use super::{PistonReport, Trajectory, named};
use crate::report::figure::{Axis, Figure, LineChart, Series};
use crate::report::html::{Section, controls, rounded, script, spread};
use crate::report::number::fixed;

/// Most frames and most points of a curve that the slider has.
const FRAMES: usize = 81;
const POINTS: usize = 111;

/// Steps of the rounded velocities within the largest one: less than a tenth of a pixel.
const LEVELS: f64 = 4000.0;

pub(super) fn section(report: &PistonReport) -> Section {
    let section = Section::new("The flow at a glance");
    let frames = whole_frames(report, &report.full);
    if frames == 0 {
        return section.paragraph("There are no snapshots to show.");
    }
    let (start, peak) = fastest(report, frames);
    let data = frames_json(report, frames, start, peak);
    section
        .raw(&controls(&[]))
        .figure(profiles(report, start, peak))
        .raw(&script(&data, include_str!("profiles.js")))
}

/// The frame with the largest |v|, and that value; the profile to open with.
fn fastest(report: &PistonReport, frames: usize) -> (usize, f64) {
    let nodes = report.fixed_grid.nodes.len();
    let mut found = (0, 0.0);
    for (k, v) in report.full.field[..frames * nodes].iter().enumerate() {
        if v.abs() > found.1 && v.is_finite() {
            found = (k / nodes, v.abs());
        }
    }
    found
}

fn profiles(report: &PistonReport, frame: usize, peak: f64) -> Figure {
    let y = Axis::new("velocity *v*", "m/s").range(-1.15 * peak, 1.15 * peak);
    let chart = LineChart::new(Axis::new("position *x*", "m"), y);
    let chart = models(report).into_iter().fold(chart, |chart, (name, model, colour)| {
        let v = profile(report, model, frame).unwrap_or(&[]);
        chart.series(match colour {
            None => Series::reference(&name, &report.fixed_grid.nodes, v),
            Some(k) => Series::line(&name, &report.fixed_grid.nodes, v).colour(k),
        })
    });
    let face = report.full.position.get(frame).copied().unwrap_or(f64::NAN);
    let end = report.fixed_grid.nodes.last().copied().unwrap_or(f64::NAN);
    let caption = format!(
        "Velocity of fluid and block (shaded) at *t* = {} s, when the flow is fastest, and with \
         the slider at any other time. The fluid is held at *x* = 0 and moves with the block at \
         its face; inside the block the velocity is one number.",
        fixed(report.times[frame], 2)
    );
    chart.band(face, end, "block").draw(330.0).figure("profiles", &caption)
}

/// Name, trajectory and colour of every model, the full one first.
fn models(report: &PistonReport) -> Vec<(String, &Trajectory, Option<usize>)> {
    let reduced = report.reduced.iter().enumerate();
    std::iter::once(("full model".to_string(), &report.full, None))
        .chain(reduced.map(|(k, model)| (named(model), &model.trajectory, Some(k))))
        .collect()
}

/// The profile at a frame, if the model came so far and its values exist.
fn profile<'a>(report: &PistonReport, model: &'a Trajectory, frame: usize) -> Option<&'a [f64]> {
    let nodes = report.fixed_grid.nodes.len();
    let v = model.field.get(frame * nodes..(frame + 1) * nodes)?;
    v.iter().all(|v| v.is_finite()).then_some(v)
}

/// The frames as compact JSON: velocities are whole multiples of `unit`.
fn frames_json(report: &PistonReport, frames: usize, start: usize, peak: f64) -> Value {
    let mut frames = spread(frames, FRAMES);
    let opening = frames.partition_point(|&frame| frame < start).min(frames.len() - 1);
    frames[opening] = start;
    let nodes = spread(report.fixed_grid.nodes.len(), POINTS);
    let unit = if peak > 0.0 { peak / LEVELS } else { 1.0 };
    #[expect(clippy::cast_possible_truncation, reason = "clamped to a few times LEVELS")]
    let level = |v: f64| (v / unit).clamp(-4.0 * LEVELS, 4.0 * LEVELS).round() as i32;
    let values = |model: &Trajectory| -> Vec<Vec<i32>> {
        let all = frames.iter().map_while(|&frame| profile(report, model, frame));
        all.map(|v| nodes.iter().map(|&i| level(v[i])).collect()).collect()
    };
    let pick = |values: &[f64]| -> Vec<f64> {
        frames.iter().map(|&k| rounded(values.get(k).copied().unwrap_or(0.0))).collect()
    };
    json!({
        "start": opening,
        "unit": unit,
        "x": nodes.iter().map(|&i| rounded(report.fixed_grid.nodes[i])).collect::<Vec<_>>(),
        "t": pick(&report.times),
        "position": pick(&report.full.position),
        "models": models(report).iter().map(|(_, model, _)| values(model)).collect::<Vec<_>>(),
    })
}
