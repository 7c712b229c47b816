//! The decomposition of the velocity.

use super::pictures::solids;
use super::{FlowModes, FlowReport};
use crate::report::energy;
use crate::report::figure::{Axis, Curves, Figure, HeatMap, LineChart, Series};
use crate::report::html::Section;
use crate::report::pod::draw::{CAPTION, COEFFICIENTS, coefficients, panels};
use crate::report::pod::{DrawnField, energies};
use lumley_fem::UniformGrid;

/// Modes that are shown.
pub(super) const SHOWN: usize = 4;

/// Eigenvalues below this part of the first are not shown.
const NOISE: f64 = 1e-12;

/// The sections of the decomposition, where there is one.
pub(super) fn sections(report: &FlowReport) -> Vec<Section> {
    let Some(pod) = &report.modes else { return Vec::new() };
    // What is smaller is round-off.
    let least = NOISE * pod.eigenvalues.first().copied().unwrap_or(0.0);
    let kept: Vec<f64> = pod.eigenvalues.iter().copied().take_while(|l| *l > least).collect();
    let shares = energy::shares(&kept, pod.total_energy);
    let mut sections = vec![energies(&shares, "m^{4}/s^{2}")];
    let mean =
        if pod.centred { "after the mean over time was subtracted" } else { "the mean included" };
    let section = Section::new("Modes").paragraph(&format!(
        "Proper orthogonal modes of the velocity on the fixed grid, with the velocity of the body inside of \
         bodies, {mean}."
    ));
    let section = match pictures(report, pod) {
        Some(figure) => section.figure(figure),
        None => section.paragraph("There are no modes to show."),
    };
    let section = match residual(pod) {
        Some(figure) => section.figure(figure),
        None => section,
    };
    sections.push(if pod.coefficients.is_empty() {
        section
    } else {
        let drawing = coefficients(&pod.times, &pod.coefficients, "m^{2}/s");
        section.figure(drawing.figure("coefficients", COEFFICIENTS))
    });
    sections
}

/// Each mode's two components over the plane, with the bodies and where they went.
fn pictures(report: &FlowReport, pod: &FlowModes) -> Option<Figure> {
    let modes = pod.modes.as_ref()?;
    let tracks = tracks(report);
    // What a body sweeps over is a part of the modes.
    let seen = |body: Curves| if tracks.is_empty() { body } else { body.hollow() };
    let bodies = solids(report, pod.times.first().copied().unwrap_or(0.0));
    let bodies: Vec<Curves> = bodies.into_iter().map(seen).collect();
    let map = |DrawnField { x, y, values }: &DrawnField| {
        let (x, y) = (along(&pod.grid, 0, x), along(&pod.grid, 1, y));
        let map =
            HeatMap::new((Axis::new("*x*", "m"), &x), (Axis::new("*y*", "m"), &y), values.clone())
                .values("", "m^{−1}");
        let map = bodies.iter().cloned().fold(map, HeatMap::curves);
        tracks.iter().cloned().fold(map, HeatMap::overlay)
    };
    let said = |component: usize| if component == 0 { ", *u*" } else { ", *v*" }.to_string();
    let with_tracks = match tracks.as_slice() {
        [] => "",
        _ => " A body stands where it was first; the line is the track of its pivot.",
    };
    let caption = format!("{CAPTION}{with_tracks}");
    let (lower, upper) = pod.grid.bounds();
    let columns = if upper[1] - lower[1] < 0.3 * (upper[0] - lower[0]) { 1 } else { 2 };
    Some(panels(modes, columns, said, map).figure("modes", &caption))
}

/// Coordinates of nodes that are counted from 1, in m.
fn along(grid: &UniformGrid, d: usize, nodes: &[f64]) -> Vec<f64> {
    let (lower, _) = grid.bounds();
    nodes.iter().map(|node| lower[d] + (node - 1.0) * grid.spacing()[d]).collect()
}

/// Where the pivots of the bodies went.
fn tracks(report: &FlowReport) -> Vec<Series> {
    let track = |track: &super::Track| {
        let along =
            |d: usize| track.positions.iter().map(|p| track.pivot[d] + p[d]).collect::<Vec<_>>();
        Series::line("", &along(0), &along(1))
    };
    report.scene.tracks.iter().map(track).collect()
}

fn residual(pod: &FlowModes) -> Option<Figure> {
    if pod.residuals.is_empty() {
        return None;
    }
    let n: Vec<f64> = (1..=pod.residuals.len()).map(|n| n as f64).collect();
    let modes = Axis::new("modes *N*", "").count().range(0.5, n.len() as f64 + 0.5);
    let caption = "Largest error over time of the projection on the first *N* modes, relative to the largest \
        velocity, both in L^{2}, (32).";
    let chart = LineChart::new(modes, Axis::new("Res(*N*)", "%").log())
        .series(Series::marked("", &n, &pod.residuals).colour(0));
    Some(chart.draw(240.0).figure("projection", caption))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_become_places() {
        let grid = UniformGrid::rectangle([1.0, -1.0], [3.0, 1.0], [5, 3]);
        assert_eq!(along(&grid, 0, &[1.0, 2.0, 5.0]), [1.0, 1.5, 3.0]);
        assert_eq!(along(&grid, 1, &[3.0]), [1.0]);
    }
}
