//! Errors against the number of modes.

use super::{Outcome, PistonReport, RomRun};
use crate::report::figure::{Axis, Figure, LineChart, Series};
use crate::report::html::{Section, Table};
use crate::report::literal;
use crate::report::number::{fixed, significant};

pub(super) fn section(report: &PistonReport) -> Section {
    let mapped = match report.reference.modes.as_slice() {
        [] => "",
        _ => {
            " The mapped model has modes of its own, in the frame of the moving mesh, and may fall \
             below it."
        }
    };
    let section = Section::new("Error against the number of modes")
        .paragraph(&format!(
            "Res(*N*) is the largest error over time, in the norm of L^{{2}}(Ω), relative to the \
             largest velocity in the same norm, (32). The projection of the snapshots is the best \
             that any model on the same modes can do.{mapped}"
        ))
        .figure(figure(report))
        .table(&table(report));
    blow_ups(report).into_iter().fold(section, |section, text| section.warning(&text))
}

fn figure(report: &PistonReport) -> Figure {
    let number: Vec<f64> = (1..=report.projection.len()).map(|n| n as f64).collect();
    let most = report.reduced.iter().flat_map(|m| &m.runs).map(|run| run.modes).max();
    let last = most.unwrap_or(1).max(number.len());
    let modes = Axis::new("number of modes *N*", "").count().range(0.7, last as f64 + 0.3);
    let chart = LineChart::new(modes, Axis::new("Res(*N*)", "%").log())
        .level(4.0, "paper: under 4 % with six modes")
        .series(Series::marked("projection", &number, &report.projection));
    let chart = report.reduced.iter().enumerate().fold(chart, |chart, (k, model)| {
        let n: Vec<f64> = model.runs.iter().map(|run| run.modes as f64).collect();
        let res: Vec<f64> =
            model.runs.iter().map(|run| run.drawn_percent().unwrap_or(f64::NAN)).collect();
        chart.series(Series::marked(&literal(&model.name), &n, &res).colour(k))
    });
    let caption = "Error of the projection and of each reduced model. A curve that follows the \
        projection loses nothing to the dynamics; a missing marker is a run that blew up or whose \
        error exceeds 1000 %.";
    chart.draw(400.0).figure("residual", caption)
}

fn table(report: &PistonReport) -> Table {
    let models = report.reduced.iter().map(|model| format!("{} (%)", literal(&model.name)));
    let head: Vec<String> =
        ["*N*".to_string(), "projection (%)".into()].into_iter().chain(models).collect();
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    let most = report.reduced.iter().flat_map(|m| &m.runs).map(|run| run.modes).max().unwrap_or(0);
    let rows = (1..=most.max(report.projection.len())).map(|n| {
        let projection = report.projection.get(n - 1).map_or(String::new(), |&r| significant(r, 3));
        let cell = |runs: &Vec<RomRun>| {
            runs.iter()
                .find(|run| run.modes == n)
                .map_or(String::new(), |run| outcome(&run.outcome))
        };
        let cells = report.reduced.iter().map(|model| cell(&model.runs));
        [n.to_string(), projection].into_iter().chain(cells).collect()
    });
    Table::new(&head).rows(rows)
}

fn outcome(outcome: &Outcome) -> String {
    match outcome {
        Outcome::Finished { res_percent } => significant(*res_percent, 3),
        Outcome::BlewUp { time, .. } => format!("blew up at {} s", fixed(*time, 2)),
    }
}

/// One sentence for each model that blew up: where, when first, and what it said.
fn blow_ups(report: &PistonReport) -> Vec<String> {
    let mut sentences = Vec::new();
    for model in &report.reduced {
        let failed = |run: &RomRun| match &run.outcome {
            Outcome::BlewUp { time, message } => Some((run.modes, *time, message.clone())),
            Outcome::Finished { .. } => None,
        };
        let failed: Vec<_> = model.runs.iter().filter_map(failed).collect();
        let Some((modes, time, message)) = failed.first() else { continue };
        let all: Vec<String> = failed.iter().map(|(n, _, _)| n.to_string()).collect();
        sentences.push(format!(
            "“{}” blew up with *N* = {}; with *N* = {modes} at *t* = {}\u{a0}s: {}",
            literal(&model.name),
            all.join(", "),
            fixed(*time, 3),
            literal(message),
        ));
    }
    sentences
}
