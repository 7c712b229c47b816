//! What the models cost, and what the transfer to the fixed grid loses.

use super::{PistonReport, RomResults, Variant, named};
use crate::report::figure::{Axis, Figure, LineChart, Series};
use crate::report::html::{Section, Table};
use crate::report::literal;
use crate::report::number::{count, duration, exact, significant};

pub(super) fn section(report: &PistonReport) -> Section {
    let section = Section::new("Cost").paragraph(
        "A reduced model is worth what it saves against the cheapest full model that is no less \
         accurate, not against the one it was made from. Errors are against the full model of \
         this run, in the norm of (32).",
    );
    let section = match report.best().and_then(|best| Some((best, speed_ratio(best)?))) {
        Some((best, ratio)) => section.paragraph(&format!(
            "At equal accuracy “{}” with *N* = {} is {} times as fast as the full model.",
            literal(&best.name),
            best.shown,
            significant(ratio, 2),
        )),
        None => section,
    };
    section.figure(figure(report)).table(&table(report))
}

/// How many times as fast as a full model of equal accuracy the shown run is.
pub(super) fn speed_ratio(model: &RomResults) -> Option<f64> {
    let ratio = model.equal.as_ref()?.ratio();
    (ratio.is_finite() && ratio > 0.0).then_some(ratio)
}

fn figure(report: &PistonReport) -> Figure {
    let time = Axis::new("computing time", "ms").log();
    let (x, y): (Vec<f64>, Vec<f64>) =
        report.variants.iter().map(|full| (1e3 * full.seconds(), full.error_percent)).unzip();
    let chart = LineChart::new(time, Axis::new("error", "%").log()).series(Series::marked(
        "full models, coarser and coarser",
        &x,
        &y,
    ));
    let chart = report.reduced.iter().enumerate().fold(chart, |chart, (k, model)| {
        let finished = model.runs.iter().filter_map(|run| {
            Some((model.steps as f64 * run.step_us * 1e-3, run.drawn_percent()?))
        });
        let longest = model.equal.as_ref().map(|equal| &equal.reduced);
        let longest = longest.map(|run| (1e3 * run.seconds(), run.error_percent));
        let (x, y): (Vec<f64>, Vec<f64>) = finished.chain(longest).unzip();
        chart.series(Series::points(&literal(&model.name), &x, &y).colour(k))
    });
    let caption = "Error against computing time: lower left is better. Each marker of a reduced \
        model is a number of modes with the step of the case; the leftmost is the shown number with \
        the longest step that keeps its accuracy. Read the saving along a horizontal line, from there \
        to the full models.";
    chart.draw(360.0).figure("cost", caption)
}

fn table(report: &PistonReport) -> Table {
    let head = [
        "model",
        "error (%)",
        "Δ*t* (s)",
        "time per step (µs)",
        "steps",
        "total",
        "full model as accurate",
        "ratio",
    ];
    let full =
        report.variants.iter().map(|full| row(format!("full, {} cells", count(full.size)), full));
    let reduced = report.reduced.iter().filter_map(|model| {
        let equal = model.equal.as_ref()?;
        let mut cells = row(named(model), &equal.reduced);
        cells[6] = format!("{} cells, {}\u{a0}s", count(equal.full.size), exact(equal.full.step));
        cells[7] = speed_ratio(model).map_or(String::new(), |ratio| significant(ratio, 2));
        Some(cells)
    });
    Table::new(&head).rows(full.chain(reduced))
}

fn row(name: String, model: &Variant) -> Vec<String> {
    let mut cells = vec![
        name,
        significant(model.error_percent, 3),
        exact(model.step),
        significant(model.step_us, 3),
        count(model.steps),
        duration(model.seconds()),
    ];
    cells.resize(8, String::new());
    cells
}

pub(super) fn transfer_section(report: &PistonReport) -> Section {
    let rows = report
        .transfer
        .iter()
        .map(|way| vec![literal(&way.method), significant(way.error_percent, 3)]);
    let section = Section::new("Transfer to the fixed grid").paragraph(
        "The velocity on the moving mesh is brought to the fixed grid by evaluating the finite \
         elements where the nodes of the grid lie, or by the paper's inverse-distance weighting \
         of the nearest mesh nodes, (27)–(30). The error is the largest over time in \
         L^{2}(Ω), relative to the largest velocity in the same norm.",
    );
    section.table(&Table::new(&["method", "error (%)"]).rows(rows))
}
