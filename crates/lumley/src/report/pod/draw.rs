//! Coefficients and modes as figures.

use super::drawn::DrawnField;
use super::{DrawnModes, FieldGrid, PodReport};
use crate::report::figure::{Axis, Drawing, Figure, HeatMap, LineChart, Series};
use crate::report::html::Section;

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
        report.coefficients.iter().take(DrawnModes::COUNT).enumerate().map(panel).collect();
    let caption = "The first temporal coefficients, *a*_{n} = (*u*, *Φ*_{n}), (7), in the unit of \
        the data times that of the inner product. Pairs of equal shape and shifted phase are \
        travelling structures.";
    Drawing::panels(2, &panels).figure("coefficients", caption)
}

pub(super) fn section(modes: Option<&DrawnModes>) -> Section {
    let section = Section::new("Modes");
    match modes {
        None => section.paragraph(
            "The modes are not drawn: the shape of the grid was not given (option --grid).",
        ),
        Some(modes) if modes.grid().is_line() => section.figure(lines(modes)),
        Some(modes) => section.figure(pictures(modes)),
    }
}

/// One chart for each component, the modes as curves.
fn lines(modes: &DrawnModes) -> Figure {
    let chart = |(component, fields): (usize, &Vec<DrawnField>)| {
        let y = Axis::new(&format!("*Φ*_{{n}}{}", of_component(modes.grid(), component)), "");
        let chart = LineChart::new(Axis::new("node", "").count(), y);
        let curve = |chart: LineChart, (k, field): (usize, &DrawnField)| {
            let name = format!("*Φ*_{{{}}}", k + 1);
            chart.series(Series::line(&name, &field.x, &field.values).colour(k))
        };
        fields.iter().enumerate().fold(chart, curve).draw(280.0)
    };
    let charts: Vec<Drawing> = modes.fields.iter().enumerate().map(chart).collect();
    Drawing::stack(&charts).figure("modes", "The first modes on the grid.")
}

/// A panel for each mode and component.
fn pictures(modes: &DrawnModes) -> Figure {
    let grid = modes.grid();
    let panel = |k: usize, component: usize| {
        let DrawnField { x, y, values } = &modes.fields[component][k];
        let title = format!("*Φ*_{{{}}}{}", k + 1, of_component(grid, component));
        let axis = |name: &str| Axis::new(name, "").count();
        let map = HeatMap::new((axis("node *i*"), x), (axis("node *j*"), y), values.clone());
        map.draw_at(350.0, map.height_of_equal_scales(350.0)).titled(&title)
    };
    let of_mode = |k: usize| (0..grid.components).map(move |component| panel(k, component));
    let panels: Vec<Drawing> = (0..modes.fields[0].len()).flat_map(of_mode).collect();
    let slice = match grid.nodes[2] {
        1 => String::new(),
        nz => format!(" Drawn is the middle slice, {} of {nz} in the third direction.", nz / 2 + 1),
    };
    let caption = format!(
        "The first modes on the grid, each with its own colours. Red and blue have opposite signs; \
         the sign of a whole mode is a convention.{slice}"
    );
    Drawing::panels(2, &panels).figure("modes", &caption)
}

fn of_component(grid: FieldGrid, component: usize) -> String {
    if grid.components == 1 { String::new() } else { format!(", component {}", component + 1) }
}
