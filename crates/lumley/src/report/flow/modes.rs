//! The decomposition of the velocity.

use super::near::Part;
use super::outlines::swept;
use super::{FlowModes, FlowReport, fixed_grid, known, projection};
use crate::report::energy;
use crate::report::figure::{Axis, Figure, HeatMap};
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
    let sections = [
        Some(eigenvalues(report, pod)),
        projection::section(report, pod),
        Some(modes(report, pod)),
        fixed_grid::section(report, pod),
    ];
    sections.into_iter().flatten().collect()
}

fn eigenvalues(report: &FlowReport, pod: &FlowModes) -> Section {
    // What is smaller is round-off.
    let least = NOISE * pod.eigenvalues.first().copied().unwrap_or(0.0);
    let kept: Vec<f64> = pod.eigenvalues.iter().copied().take_while(|l| *l > least).collect();
    let section = energies(&energy::shares(&kept, pod.total_energy), "m^{4}/s^{2}");
    known::add_paper_table(report, section)
}

fn modes(report: &FlowReport, pod: &FlowModes) -> Section {
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
    if pod.coefficients.is_empty() {
        return section;
    }
    let drawing = coefficients(&pod.times, &pod.coefficients, "m^{2}/s");
    section.figure(drawing.figure("coefficients", COEFFICIENTS))
}

/// Each mode's two components over the plane, with the bodies and where they went.
fn pictures(report: &FlowReport, pod: &FlowModes) -> Option<Figure> {
    let modes = pod.modes.as_ref()?;
    let time = |time: Option<&f64>| time.copied().unwrap_or(0.0);
    let (bodies, ways) = swept(report, time(pod.times.first()), time(pod.times.last()));
    let part = Part::with_all_local(modes.fields.iter().flatten());
    let map = |field: &DrawnField| {
        let cut = part.as_ref().map(|part| part.cut(field));
        let DrawnField { x, y, values } = cut.as_ref().unwrap_or(field);
        let (x, y) = (along(&pod.grid, 0, x), along(&pod.grid, 1, y));
        let map =
            HeatMap::new((Axis::new("*x*", "m"), &x), (Axis::new("*y*", "m"), &y), values.clone())
                .values("", "m^{−1}");
        let map = bodies.iter().cloned().fold(map, HeatMap::curves);
        ways.iter().cloned().fold(map, HeatMap::overlay)
    };
    let said = |component: usize| if component == 0 { ", *u*" } else { ", *v*" }.to_string();
    let with_ways = match ways.as_slice() {
        [] => "",
        _ => {
            " A body that moves is dashed where the first snapshot has it and drawn out where the last has it; \
             between them the way of its centre."
        }
    };
    let with_part = match part {
        None => "",
        Some(_) => " The rest of the grid, where they are even or nothing, is left out.",
    };
    let caption = format!("{CAPTION}{with_part}{with_ways}");
    let (lower, upper) = pod.grid.bounds();
    let flat = part.is_none() && upper[1] - lower[1] < 0.3 * (upper[0] - lower[0]);
    let columns = if flat { 1 } else { 2 };
    Some(panels(modes, columns, said, map).figure("modes", &caption))
}

/// Coordinates of nodes that are counted from 1, in m.
fn along(grid: &UniformGrid, d: usize, nodes: &[f64]) -> Vec<f64> {
    let (lower, _) = grid.bounds();
    nodes.iter().map(|node| lower[d] + (node - 1.0) * grid.spacing()[d]).collect()
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
