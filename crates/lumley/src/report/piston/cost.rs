//! What the models cost, and what the transfer to the fixed grid loses.

use super::{FomVariant, PistonReport, RomResults, named};
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
    let section = match report.best().and_then(|best| Some((best, speed_ratio(report, best)?))) {
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

/// Cost of the cheapest full model that is no less accurate than the shown run of `model`, over
/// the cost of that run.
pub(super) fn speed_ratio(report: &PistonReport, model: &RomResults) -> Option<f64> {
    let ratio = equal(report, model)?.seconds() / seconds(model)?;
    (ratio.is_finite() && ratio > 0.0).then_some(ratio)
}

fn equal<'a>(report: &'a PistonReport, model: &RomResults) -> Option<&'a FomVariant> {
    let res = model.shown_res()?;
    let accurate = report.variants.iter().filter(|full| full.error_percent <= res);
    accurate.min_by(|a, b| a.seconds().total_cmp(&b.seconds()))
}

/// Time of the shown run, in s.
fn seconds(model: &RomResults) -> Option<f64> {
    let step_us = model.shown_run()?.step_us;
    Some(model.steps as f64 * step_us * 1e-6)
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
        let (x, y): (Vec<f64>, Vec<f64>) = finished.unzip();
        chart.series(Series::points(&literal(&model.name), &x, &y).colour(k))
    });
    let caption = "Error against computing time: lower left is better. Each marker of a reduced \
        model is a number of modes; read the saving along a horizontal line, from a reduced model \
        to the full models. The full model of this run has no error here and no place.";
    chart.draw(360.0).figure("cost", caption)
}

fn table(report: &PistonReport) -> Table {
    let head = [
        "model",
        "error (%)",
        "time per step (µs)",
        "steps",
        "total",
        "full model as accurate",
        "ratio",
    ];
    let full = report.variants.iter().map(|full| {
        let name = format!("full, {} cells, Δ*t* = {}\u{a0}s", count(full.cells), exact(full.dt));
        let error = match full.error_percent {
            0.0 => "this run".into(),
            error => significant(error, 3),
        };
        row(name, error, full.step_us, full.steps)
    });
    let reduced = report.reduced.iter().filter_map(|model| {
        let run = model.shown_run()?;
        let mut cells = row(
            named(model),
            model.shown_res().map_or("blew up".into(), |res| significant(res, 3)),
            run.step_us,
            model.steps,
        );
        if let Some(full) = equal(report, model) {
            cells[5] = format!("{} cells, {}\u{a0}s", count(full.cells), exact(full.dt));
            cells[6] = speed_ratio(report, model).map_or(String::new(), |r| significant(r, 2));
        }
        Some(cells)
    });
    Table::new(&head).rows(full.chain(reduced))
}

fn row(name: String, error: String, step_us: f64, steps: usize) -> Vec<String> {
    let total = duration(steps as f64 * step_us * 1e-6);
    vec![name, error, significant(step_us, 3), count(steps), total, String::new(), String::new()]
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
