//! The first modes, paper Fig. 10.

use super::{ModeSet, PistonReport};
use crate::report::figure::{Axis, LineChart, Series};
use crate::report::html::Section;

/// How many modes a figure shows, as the paper does.
const SHOWN: usize = 4;

pub(super) fn section(report: &PistonReport) -> Section {
    let fixed_grid = "Modes of the global velocity on the fixed grid; shaded, where the interface \
        moves. Where there is always a block, every mode is constant: a rigid body has one \
        velocity. The kink of the velocity at the moving interface is smeared over the shaded \
        range, which is what costs the fixed grid its accuracy.";
    let mapped = "Modes in the frame of the moving mesh, *ξ* = *x*/*X*(*t*), of the velocity less \
        its linear part *X*′*ξ*: they vanish at both ends, and the interface stands still at *ξ* = 1.";
    let section = Section::new("Modes")
        .figure(fixed_grid_chart(report).draw(320.0).figure("modes", fixed_grid));
    if report.reference.modes.is_empty() {
        return section;
    }
    let x = Axis::new("reference position *ξ*", "");
    let chart = LineChart::new(x, Axis::new("mapped mode *φ*_{n}", ""));
    let chart = curves(chart, "φ", &report.reference);
    section.figure(chart.draw(300.0).figure("mapped-modes", mapped))
}

fn fixed_grid_chart(report: &PistonReport) -> LineChart {
    let y = Axis::new("mode *Φ*_{n}", "m^{−1/2}");
    let chart = LineChart::new(Axis::new("position *x*", "m"), y);
    let chart = curves(chart, "Φ", &report.fixed_grid);
    let positions = || report.full.position.iter().copied().filter(|x| x.is_finite());
    match (positions().reduce(f64::min), positions().reduce(f64::max)) {
        (Some(lo), Some(hi)) => chart.band(lo, hi, "range of the interface"),
        _ => chart,
    }
}

fn curves(chart: LineChart, symbol: &str, set: &ModeSet) -> LineChart {
    set.modes.iter().take(SHOWN).enumerate().fold(chart, |chart, (k, mode)| {
        let name = format!("*{symbol}*_{{{}}}", k + 1);
        chart.series(Series::line(&name, &set.nodes, mode).colour(k))
    })
}
