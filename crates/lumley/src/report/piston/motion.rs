//! Motion of the block and the traction on it.

use super::{PistonReport, Trajectory};
use crate::report::figure::{Axis, Drawing, LineChart};
use crate::report::html::Section;

pub(super) fn section(report: &PistonReport) -> Section {
    let position = chart(report, Axis::new("position *X*", "m"), |t| &t.position);
    let velocity = chart(report, Axis::new("velocity *X*′", "m/s"), |t| &t.velocity);
    let traction = chart(
        report,
        Axis::new("viscous traction *ν* ∂*u*/∂*x*(*X*^{−})", "m^{2}/s^{2}"),
        |t| &t.traction,
    );
    let drawing = Drawing::stack(&[
        position.legend(),
        position.without_legend().draw(190.0),
        velocity.without_legend().draw(190.0),
        traction.without_legend().draw(210.0),
    ]);
    let caption = "Motion of the block and traction of the fluid on it. A reduced model is good \
        when its thin line runs inside the broad one of the full model; the traction, a \
        derivative at the interface, asks most of it. The axes follow the full model: \
        what leaves them is cut.";
    Section::new("Motion of the block").figure(drawing.figure("motion", caption))
}

fn chart(report: &PistonReport, y: Axis, quantity: fn(&Trajectory) -> &[f64]) -> LineChart {
    let y = match around(quantity(&report.full)) {
        Some((lo, hi)) => y.range(lo, hi),
        None => y,
    };
    let chart = LineChart::new(Axis::new("time *t*", "s"), y);
    report.compare(quantity).into_iter().fold(chart, LineChart::series)
}

/// The range of the values and a fifth of it on both sides: one model that blows up must not
/// flatten the others.
pub(super) fn around(values: &[f64]) -> Option<(f64, f64)> {
    let finite = || values.iter().copied().filter(|v| v.is_finite());
    let (lo, hi) = (finite().reduce(f64::min)?, finite().reduce(f64::max)?);
    let pad = 0.2 * (hi - lo);
    (pad > 0.0).then_some((lo - pad, hi + pad))
}
