//! Coefficients and modes as figures.

use super::{FieldGrid, PodReport};
use crate::report::figure::{Axis, Drawing, Figure, HeatMap, LineChart, Series};
use crate::report::html::Section;

/// How many modes and coefficients are drawn.
const SHOWN: usize = 6;

pub(super) fn coefficients(report: &PodReport) -> Figure {
    let times: Vec<f64> = match report.times.as_slice() {
        [] => (1..=report.snapshots).map(|k| k as f64).collect(),
        times => times.to_vec(),
    };
    let axis = || match report.times.as_slice() {
        [] => Axis::new("snapshot", "").count(),
        _ => Axis::new("time *t*", "s"),
    };
    let panel = |(n, a): (usize, &Vec<f64>)| {
        LineChart::new(axis(), Axis::new(&format!("*a*_{{{}}}", n + 1), ""))
            .series(Series::line("", &times, a).colour(0))
            .draw_at(346.0, 160.0)
    };
    let panels: Vec<Drawing> =
        report.coefficients.iter().take(SHOWN).enumerate().map(panel).collect();
    let caption = "The first temporal coefficients, *a*_{n} = (*u*, *Φ*_{n}), (7), in the unit of \
        the data times that of the inner product. Pairs of equal shape and shifted phase are \
        travelling structures.";
    Drawing::panels(2, &panels).figure("coefficients", caption)
}

pub(super) fn section(report: &PodReport) -> Section {
    let section = Section::new("Modes");
    match report.grid {
        None => section.paragraph(
            "The modes are not drawn: the shape of the grid was not given (option --grid).",
        ),
        Some(grid) if grid.is_empty() || report.modes.iter().any(|m| m.len() != grid.len()) => {
            section.paragraph("The modes are not drawn: they do not fit the grid that was given.")
        }
        Some(grid) if grid.nodes[1] == 1 && grid.nodes[2] == 1 => {
            section.figure(lines(report, grid))
        }
        Some(grid) => section.figure(pictures(report, grid)),
    }
}

/// One chart for each component, the modes as curves.
fn lines(report: &PodReport, grid: FieldGrid) -> Figure {
    let nodes: Vec<f64> = (1..=grid.nodes[0]).map(|i| i as f64).collect();
    let chart = |component: usize| {
        let y = Axis::new(&format!("*Φ*_{{n}}{}", of_component(grid, component)), "");
        let chart = LineChart::new(Axis::new("node", "").count(), y);
        let curve = |chart: LineChart, (k, mode): (usize, &Vec<f64>)| {
            let values = &mode[component * nodes.len()..][..nodes.len()];
            chart.series(Series::line(&format!("*Φ*_{{{}}}", k + 1), &nodes, values).colour(k))
        };
        report.modes.iter().take(SHOWN).enumerate().fold(chart, curve).draw(280.0)
    };
    let charts: Vec<Drawing> = (0..grid.components).map(chart).collect();
    Drawing::stack(&charts).figure("modes", "The first modes on the grid.")
}

/// A panel for each mode and component.
fn pictures(report: &PodReport, grid: FieldGrid) -> Figure {
    let panel = |mode: &[f64], k: usize, component: usize| {
        let [nx, ny, _] = grid.nodes;
        let axis = |count: usize| (1..=count).map(|i| i as f64).collect::<Vec<f64>>();
        let values = middle_slice(mode, grid, component);
        let title = format!("*Φ*_{{{}}}{}", k + 1, of_component(grid, component));
        let (x, y) = (Axis::new("node *i*", "").count(), Axis::new("node *j*", "").count());
        let map = HeatMap::new((x, &axis(nx)), (y, &axis(ny)), values);
        map.draw_at(350.0, map.height_of_equal_scales(350.0)).titled(&title)
    };
    let modes = report.modes.iter().take(SHOWN).enumerate();
    let panels = modes.flat_map(|(k, mode)| (0..grid.components).map(move |c| panel(mode, k, c)));
    let slice = match grid.nodes[2] {
        1 => String::new(),
        nz => format!(" Drawn is the middle slice, {} of {nz} in the third direction.", nz / 2 + 1),
    };
    let caption = format!(
        "The first modes on the grid, each with its own colours. Red and blue have opposite signs; \
         the sign of a whole mode is a convention.{slice}"
    );
    Drawing::panels(2, &panels.collect::<Vec<_>>()).figure("modes", &caption)
}

/// The component at the nodes of the middle slice in the third direction.
fn middle_slice(mode: &[f64], grid: FieldGrid, component: usize) -> Vec<f64> {
    let [nx, ny, nz] = grid.nodes;
    let start = (component * nz + nz / 2) * nx * ny;
    mode[start..start + nx * ny].to_vec()
}

fn of_component(grid: FieldGrid, component: usize) -> String {
    if grid.components == 1 { String::new() } else { format!(", component {}", component + 1) }
}
