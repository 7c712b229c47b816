//! Probes over time, and how the solver worked.

use super::loads::settled_range;
use super::{FlowReport, History, ProbeSeries};
use crate::report::figure::{Axis, Drawing, Figure, LineChart, Series};
use crate::report::html::{Section, Table};
use crate::report::literal;
use crate::report::number::{count, significant};

/// The section of the probes, where there are any.
pub(super) fn probes(report: &FlowReport) -> Option<Section> {
    let history = &report.history;
    if history.probes.is_empty() && report.pressure_difference.is_none() {
        return None;
    }
    let section = Section::new("Probes");
    let section = match report.pressure_difference {
        None => section,
        Some(p) => section.paragraph(&format!(
            "Pressure difference between the two points of the case at the end: {} Pa.",
            significant(p, 6)
        )),
    };
    let section =
        if history.times.len() > 1 { section.figure(probe_figure(history)) } else { section };
    Some(if history.probes.is_empty() { section } else { section.table(&last_values(history)) })
}

/// What the probes say at the end.
fn last_values(history: &History) -> Table {
    let row = |probe: &ProbeSeries| {
        let last = |values: &[f64]| significant(values.last().copied().unwrap_or(f64::NAN), 5);
        vec![literal(&probe.name), last(&probe.u), last(&probe.v), last(&probe.pressure)]
    };
    let head = ["probe, at the end", "*u* (m/s)", "*v* (m/s)", "*p* (Pa)"];
    Table::new(&head).rows(history.probes.iter().map(row))
}

fn probe_figure(history: &History) -> Figure {
    let names: Vec<String> = history.probes.iter().map(|probe| literal(&probe.name)).collect();
    let of = |values: fn(&ProbeSeries) -> &[f64]| {
        names.iter().map(String::as_str).zip(history.probes.iter().map(values)).collect::<Vec<_>>()
    };
    let charts = [
        over_time(history, Axis::new("*u*", "m/s"), &of(|p| &p.u)),
        over_time(history, Axis::new("*v*", "m/s"), &of(|p| &p.v)),
        over_time(history, Axis::new("*p*", "Pa"), &of(|p| &p.pressure)),
    ];
    let mut panels = Vec::new();
    if !names.is_empty() {
        panels.push(charts[0].legend());
        panels.extend(charts.map(|chart| chart.without_legend().draw(160.0)));
    }
    if !history.pressure_difference.is_empty() {
        let axis = Axis::new("pressure difference Δ*p*", "Pa");
        panels.push(over_time(history, axis, &[("", &history.pressure_difference)]).draw(160.0));
    }
    let caption = "Velocity and pressure at the probes. Of an impulsive start, the axes show what is left of it \
        after the first steps.";
    Drawing::stack(&panels).figure("probes", caption)
}

/// Curves over the times of the probes.
fn over_time(history: &History, axis: Axis, curves: &[(&str, &[f64])]) -> LineChart {
    let all: Vec<f64> = curves.iter().flat_map(|(_, values)| values.iter().copied()).collect();
    let axis = settled_range(&all).map_or(axis.clone(), |(lo, hi)| axis.range(lo, hi));
    let chart = LineChart::new(Axis::new("time *t*", "s"), axis);
    curves.iter().enumerate().fold(chart, |chart, (k, (name, values))| {
        chart.series(Series::line(name, &history.times, values).colour(k))
    })
}

pub(super) fn solver(report: &FlowReport) -> Section {
    let section = Section::new("The solver");
    let section = match solver_figure(&report.history) {
        Some(figure) => section.figure(figure),
        None => section,
    };
    let section = match report.history.residuals.as_slice() {
        [] => section,
        residuals => section.figure(residual_figure(residuals)),
    };
    section.table(&work(report))
}

fn solver_figure(history: &History) -> Option<Figure> {
    let panel = |name: &str, values: &[f64]| {
        let axis = Axis::new(name, "");
        LineChart::new(Axis::new("time *t*", "s"), axis)
            .series(Series::line("", &history.step_times, values).colour(0))
            .draw(150.0)
    };
    let panels: Vec<Drawing> =
        [("Courant number", &history.cfl), ("iterations of a step", &history.iterations)]
            .into_iter()
            .filter(|(_, values)| values.len() > 1)
            .map(|(name, values)| panel(name, values))
            .collect();
    let caption = "The Courant number, how many cells the fluid crosses in a step at most, and the \
        iterations of the linear solver: they rise while its factorisation ages and fall when it is renewed.";
    (!panels.is_empty()).then(|| Drawing::stack(&panels).figure("solver", caption))
}

fn residual_figure(residuals: &[f64]) -> Figure {
    let n: Vec<f64> = (1..=residuals.len()).map(|n| n as f64).collect();
    let series = if n.len() <= 40 { Series::marked } else { Series::line };
    LineChart::new(Axis::new("iteration", "").count(), Axis::new("change", "").log())
        .series(series("", &n, residuals).colour(0))
        .draw(260.0)
        .figure("residuals", "Change of the velocity in each iteration to the steady flow, relative to the largest one.")
}

fn work(report: &FlowReport) -> Table {
    let work = &report.work;
    let row = |name: &str, value: Option<String>| Some(vec![name.to_string(), value?]);
    let rows = [
        row("unknowns", Some(count(work.unknowns))),
        row(if report.settings.steady { "iterations" } else { "steps" }, Some(count(work.steps))),
        row("time of one (ms)", work.step_ms.map(|ms| significant(ms, 3))),
        row("iterations of the linear solver in one", work.iterations.map(|n| significant(n, 3))),
        row("renewals of the factorisation", work.renewals.map(count)),
        row("memory (MB)", work.memory.map(|bytes| significant(bytes / 1e6, 3))),
    ];
    Table::new(&[]).labels(1).rows(rows.into_iter().flatten())
}
