//! Temporal coefficients, projected and computed, paper Fig. 9.

use super::motion::around;
use super::{Frame, PistonReport, RomResults, named};
use crate::report::figure::{Axis, Drawing, Figure, LineChart, Series};
use crate::report::html::Section;

/// How many coefficients a figure shows, as the paper does.
const SHOWN: usize = 4;

pub(super) fn section(report: &PistonReport) -> Section {
    let section = Section::new("Temporal coefficients").paragraph(
        "Broad lines: the snapshots projected on the modes, *a*_{n} = (*v*, *Φ*_{n}), (7). Thin \
         lines: what the reduced models compute from the first of them alone.",
    );
    let frames = [Frame::FixedGrid, Frame::Reference];
    frames.into_iter().filter_map(|f| figure(report, f)).fold(section, Section::figure)
}

fn figure(report: &PistonReport, frame: Frame) -> Option<Figure> {
    let count = report.mode_set(frame).projected.len().min(SHOWN);
    let charts: Vec<LineChart> = (0..count).map(|n| chart(report, frame, n)).collect();
    let legend = charts.first()?.legend();
    let panels: Vec<Drawing> =
        charts.into_iter().map(|c| c.without_legend().draw_at(346.0, 175.0)).collect();
    let drawing = Drawing::stack(&[legend, Drawing::panels(2, &panels)]);
    let axes = "The axes follow the projection: what leaves them is cut, and a line that ends \
        blew up.";
    Some(match frame {
        Frame::FixedGrid => drawing.figure(
            "coefficients",
            &format!("First temporal coefficients of the models on the fixed grid. {axes}"),
        ),
        Frame::Reference => drawing.figure(
            "mapped-coefficients",
            &format!("The same in the frame of the moving mesh, which has its own modes. {axes}"),
        ),
    })
}

fn chart(report: &PistonReport, frame: Frame, n: usize) -> LineChart {
    let unit = match frame {
        Frame::FixedGrid => "m^{3/2}/s",
        Frame::Reference => "m/s",
    };
    let projected = &report.mode_set(frame).projected[n];
    let axis = Axis::new(&format!("*a*_{{{}}}", n + 1), unit);
    let axis = match around(projected) {
        Some((lo, hi)) => axis.range(lo, hi),
        None => axis,
    };
    let chart = LineChart::new(Axis::new("time *t*", "s"), axis).series(Series::reference(
        "projected",
        &report.times,
        projected,
    ));
    let curve = |chart: LineChart, (k, model): (usize, &RomResults)| {
        let computed = model.coefficients.get(n).map_or(&[][..], Vec::as_slice);
        chart.series(Series::line(&named(model), &report.times, computed).colour(k))
    };
    report.reduced.iter().enumerate().filter(|(_, m)| m.frame == frame).fold(chart, curve)
}
