//! Coefficients and modes as figures.

use super::drawn::DrawnField;
use super::{DrawnModes, FieldGrid};
use crate::report::figure::{Axis, Drawing, Figure, HeatMap, LineChart, Series, WIDTH};
use crate::report::html::Section;

/// The caption of [`coefficients`].
pub(in crate::report) const COEFFICIENTS: &str = "The first temporal coefficients, *a*_{n} = (*u*, *Φ*_{n}), \
    (7), in the unit of the data times that of the inner product. Pairs of equal shape and shifted phase are \
    travelling structures.";

/// The first coefficients over `times`, which may be missing, in `unit`.
pub(in crate::report) fn coefficients(
    times: &[f64],
    coefficients: &[Vec<f64>],
    unit: &str,
) -> Drawing {
    let longest = coefficients.iter().map(Vec::len).max().unwrap_or(0);
    let numbers: Vec<f64> = (1..=longest).map(|k| k as f64).collect();
    let x = if times.is_empty() { &numbers } else { times };
    let axis = || match times {
        [] => Axis::new("snapshot", "").count(),
        _ => Axis::new("time *t*", "s"),
    };
    let panel = |(n, a): (usize, &Vec<f64>)| {
        LineChart::new(axis(), Axis::new(&format!("*a*_{{{}}}", n + 1), unit))
            .series(Series::line("", x, a).colour(0))
            .draw_at(346.0, 160.0)
    };
    let shown = coefficients.iter().take(DrawnModes::COUNT);
    Drawing::panels(2, &shown.enumerate().map(panel).collect::<Vec<_>>())
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

/// Modes as pictures, the middle slice of those of three directions.
fn pictures(modes: &DrawnModes) -> Figure {
    let axis = |name: &str| Axis::new(name, "").count();
    let map = |DrawnField { x, y, values }: &DrawnField| {
        HeatMap::new((axis("node *i*"), x), (axis("node *j*"), y), values.clone())
    };
    let slice = match modes.grid().nodes[2] {
        1 => String::new(),
        nz => format!(" Drawn is the middle slice, {} of {nz} in the third direction.", nz / 2 + 1),
    };
    let caption = format!("{CAPTION}{slice}");
    panels(modes, 2, |component| of_component(modes.grid(), component), map)
        .figure("modes", &caption)
}

/// What the caption of [`panels`] begins with.
pub(in crate::report) const CAPTION: &str = "The first modes on the grid, each with its own colours. Red and \
    blue have opposite signs; the sign of a whole mode is a convention.";

/// A panel for each mode and component, in one column or two, titled by the mode and what is `said` of the component.
pub(in crate::report) fn panels(
    modes: &DrawnModes,
    columns: usize,
    said: impl Fn(usize) -> String,
    map: impl Fn(&DrawnField) -> HeatMap,
) -> Drawing {
    let width = if columns == 1 { WIDTH } else { 350.0 };
    let panel = |k: usize, component: usize| {
        let title = format!("*Φ*_{{{}}}{}", k + 1, said(component));
        map(&modes.fields[component][k]).draw_equal(width, 420.0).titled(&title)
    };
    let components = modes.fields.len();
    let of_mode = |k: usize| (0..components).map(move |component| (k, component));
    let shown = modes.fields.first().map_or(0, Vec::len);
    let all = (0..shown).flat_map(of_mode).map(|(k, component)| panel(k, component));
    Drawing::panels(columns, &all.collect::<Vec<_>>())
}

fn of_component(grid: FieldGrid, component: usize) -> String {
    if grid.components == 1 { String::new() } else { format!(", component {}", component + 1) }
}
