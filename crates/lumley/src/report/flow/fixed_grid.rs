//! How good the snapshots on the fixed grid are, and the modes as velocities.

use super::{FlowModes, FlowReport, TransferNumbers};
use crate::report::figure::{Axis, Figure, LineChart, Series};
use crate::report::html::{Section, Table};
use crate::report::literal;
use crate::report::number::{NOTHING, significant};

/// The section of the fixed grid, where something was measured of it.
pub(super) fn section(report: &FlowReport, pod: &FlowModes) -> Option<Section> {
    let figure = divergence(pod);
    if report.transfer.is_empty() && figure.is_none() {
        return None;
    }
    let section = Section::new("The fixed grid");
    let section = match report.transfer.as_slice() {
        [] => section,
        ways => section
            .paragraph(
                "What the way from the moving mesh to the fixed grid does to a snapshot: the difference between \
                 the last velocity as the elements have it and the bilinear function through its values at the \
                 nodes of the grid, relative to that velocity. The grid has a part in it that no way avoids, the \
                 most where the rim of a body cuts its cells; the error at the nodes is that of the way alone.",
            )
            .table(&transfer(ways)),
    };
    Some(figure.into_iter().fold(section, Section::figure))
}

fn transfer(ways: &[TransferNumbers]) -> Table {
    let number = |value: Option<f64>| value.map_or(NOTHING.into(), |v| significant(v, 3));
    let percent = |value: Option<f64>| number(value.map(|v| 100.0 * v));
    let row = |way: &TransferNumbers| {
        let errors = [way.l2, way.largest, way.nodes].map(percent);
        let numbers = errors.into_iter().chain([number(way.milliseconds)]);
        std::iter::once(literal(&way.name)).chain(numbers).collect()
    };
    let errors = ["error in L^{2} (%)", "largest error (%)", "error at the nodes (%)"];
    let head = [&["way to the grid"][..], &errors, &["a snapshot takes (ms)"]].concat();
    Table::new(&head).rows(ways.iter().map(row))
}

fn divergence(pod: &FlowModes) -> Option<Figure> {
    let percent = pod.divergence.iter().map(|d| d.map_or(f64::NAN, |d| 100.0 * d));
    let percent: Vec<f64> = percent.collect();
    let n: Vec<f64> = (1..=percent.len()).map(|n| n as f64).collect();
    let modes = Axis::new("mode *n*", "").count().range(0.5, n.len() as f64 + 0.5);
    let chart = LineChart::new(modes, Axis::new("‖div *Φ*_{n}‖/‖grad *Φ*_{n}‖", "%").log())
        .series(Series::marked("", &n, &percent).colour(0));
    let chart = match pod.snapshot_divergence {
        Some(all) => chart.level(100.0 * all, "the snapshots"),
        None => chart,
    };
    let caption = "Divergence of the modes by central differences, at nodes that no body touched in any snapshot. \
        Modes are sums of snapshots and as free of divergence as these: what is left is the error of the \
        differences and of the way to the grid, which modes of finer structure feel more.";
    (!percent.is_empty()).then(|| chart.draw(230.0).figure("divergence", caption))
}
