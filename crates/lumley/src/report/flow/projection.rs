//! What the projection on the first modes loses, also with fewer snapshots.

use super::known;
use super::{FlowModes, FlowReport, ThinnedModes};
use crate::report::figure::{Axis, Figure, LineChart, Series};
use crate::report::html::{Section, Table};
use crate::report::number::{count, significant};

/// Most modes in the table.
const MODES: usize = 10;

/// A column: its head, and its values in text.
type Column = (String, Vec<String>);

/// The section of these errors, where there are any.
pub(super) fn section(report: &FlowReport, pod: &FlowModes) -> Option<Section> {
    if pod.residuals.is_empty() {
        return None;
    }
    let section = Section::new("Error of the projection").paragraph(
        "Res(*N*) is the largest error over time of the projection of the snapshots on their first *N* modes, \
         relative to the largest velocity, both in L^{2}, (32): the best that a reduced model on these modes can \
         do.",
    );
    let section = section.figure(figure(report, pod));
    let Some(thinned) = &pod.thinned else { return Some(section) };
    let section = section.paragraph(&format!(
        "One snapshot in {} asks less of the modes. Where its curve lies far below the other, the modes of all \
         snapshots are spent on what changes fastest, such as the start of a flow.",
        thinned.every
    ));
    Some(section.table(&table(report, pod, thinned)))
}

fn figure(report: &FlowReport, pod: &FlowModes) -> Figure {
    let n = |values: &[f64]| (1..=values.len()).map(|n| n as f64).collect::<Vec<f64>>();
    let (all, few) = (&pod.residuals, pod.thinned.as_ref());
    let most = all.len().max(few.map_or(0, |few| few.res_percent.len()));
    let modes = Axis::new("modes *N*", "").count().range(0.5, most as f64 + 0.5);
    let names = match few {
        None => [String::new(), String::new()],
        Some(few) => [
            format!("all {} snapshots", count(pod.times.len())),
            format!("one in {}, {} snapshots", few.every, count(few.snapshots)),
        ],
    };
    let chart = LineChart::new(modes, Axis::new("Res(*N*)", "%").log());
    let chart = if known::modes(report).is_some() {
        chart.level(1.0, "paper: under 1 % with four modes")
    } else {
        chart
    };
    let chart = chart.series(Series::marked(&names[0], &n(all), all).colour(0));
    let chart = few.iter().fold(chart, |chart, few| {
        let res = &few.res_percent;
        chart.series(Series::marked(&names[1], &n(res), res).colour(1))
    });
    chart.draw(270.0).figure("projection", "Largest error over time against the number of modes.")
}

/// Eigenvalues and errors of all snapshots and of a part of them, beside what is known.
fn table(report: &FlowReport, pod: &FlowModes, few: &ThinnedModes) -> Table {
    let known = known::modes(report).filter(|_| few.every == known::EVERY).unwrap_or_default();
    let eigenvalue = |values: &[f64]| values.iter().map(|v| significant(*v, 4)).collect();
    let percent = |values: &[f64]| values.iter().map(|v| significant(*v, 3)).collect();
    let column = |head: &str, values: Vec<String>| -> Column { (head.to_owned(), values) };
    let reference = |values: Vec<String>| column("reference", values);
    let of = |value: fn(&known::Mode) -> f64| known.iter().map(value).collect::<Vec<f64>>();
    let one_in = format!("one in {}", few.every);
    let columns = [
        column("Res, all (%)", percent(&pod.residuals)),
        reference(percent(&of(|mode| mode.residual))),
        column(&format!("Res, {one_in} (%)"), percent(&few.res_percent)),
        reference(percent(&of(|mode| mode.residual_of_fifth))),
        column(&format!("*λ*_{{N}}, {one_in}"), eigenvalue(&few.eigenvalues)),
        reference(eigenvalue(&of(|mode| mode.eigenvalue_of_fifth))),
    ];
    let columns: Vec<Column> = columns.into_iter().filter(|(_, v)| !v.is_empty()).collect();
    let rows = columns.iter().map(|(_, values)| values.len()).max().unwrap_or(0).min(MODES);
    let heads: Vec<&str> = std::iter::once("*N*").chain(columns.iter().map(|c| &*c.0)).collect();
    let cell = |k: usize, values: &[String]| values.get(k).cloned().unwrap_or_default();
    Table::new(&heads).rows((0..rows).map(|k| {
        let cells = columns.iter().map(|(_, values)| cell(k, values));
        std::iter::once((k + 1).to_string()).chain(cells).collect()
    }))
}
