//! Loads on the boundaries: over time, in numbers, and their frequencies.

use super::film::quantile;
use super::{BoundaryLoads, FlowReport};
use crate::report::figure::{Axis, Drawing, Figure, LineChart, Series};
use crate::report::html::{Section, Table};
use crate::report::literal;
use crate::report::number::{NOTHING, short, significant};

/// Most bodies that get curves.
const BODIES: usize = 6;

pub(super) fn section(report: &FlowReport) -> Section {
    let section = Section::new("Loads");
    if report.loads.is_empty() {
        return section.paragraph("There are no loads: none were computed.");
    }
    let section = section.paragraph(&what(report));
    let section = if curves(report).is_empty() {
        section
    } else {
        let section = section.figure(over_time(report));
        spectra(report).into_iter().fold(section, Section::figure)
    };
    let section = coefficients(report).iter().fold(section, Section::table);
    section.table(&forces(report)).paragraph(
        "The last column tells how far the surface integral (17) of the computed stresses is from the \
         consistent force at the end: a check of the resolution at the wall.",
    )
}

fn what(report: &FlowReport) -> String {
    let method = "Forces on the boundaries by the consistent (residual) method";
    match report.settings.reference {
        Some(r) => format!(
            "{method}; coefficients are 2*F*/(*ρU*^{{2}}*L*) with *U* = {} m/s, *L* = {} m and *ρ* = {} \
             kg/m^{{3}}.",
            short(r.velocity),
            short(r.length),
            short(r.density)
        ),
        None => format!(
            "{method}, in N for each metre of span; without a reference there are no coefficients."
        ),
    }
}

/// The bodies that have something to draw.
fn curves(report: &FlowReport) -> Vec<&BoundaryLoads> {
    let drawn = report.loads.iter().filter(|b| b.is_body && b.drag.len().max(b.lift.len()) > 1);
    drawn.take(BODIES).collect()
}

fn over_time(report: &FlowReport) -> Figure {
    let bodies = curves(report);
    let titles = match report.settings.reference {
        Some(_) => [("drag coefficient *C*_{D}", ""), ("lift coefficient *C*_{L}", "")],
        None => [("drag *F*_{x}", "N/m"), ("lift *F*_{y}", "N/m")],
    };
    let mut cut = false;
    let mut panels = Vec::new();
    for (k, body) in bodies.iter().enumerate() {
        for ((name, unit), values) in titles.iter().zip([&body.drag, &body.lift]) {
            let axis = Axis::new(name, unit);
            let range = settled_range(values);
            cut |= range.is_some();
            let axis = range.map_or(axis.clone(), |(lo, hi)| axis.range(lo, hi));
            let chart = LineChart::new(Axis::new("time *t*", "s"), axis)
                .series(Series::line("", &report.load_times, values).colour(k));
            let chart = match body.numbers.window {
                Some([from, to]) => chart.band(from, to, ""),
                None => chart,
            };
            let drawing = chart.draw(180.0);
            let title = if bodies.len() > 1 { literal(&body.name) } else { String::new() };
            panels.push(if title.is_empty() { drawing } else { drawing.titled(&title) });
        }
    }
    let names: Vec<String> = bodies.iter().map(|body| literal(&body.name)).collect();
    let mut caption = format!("Loads on {}.", names.join(", "));
    if bodies.iter().any(|body| body.numbers.window.is_some()) {
        caption += " Shaded, what the numbers below are taken from: the last full periods of the lift, \
            or the later half of the run where it has none.";
    }
    if cut {
        caption += " The axes show the greater part of the run; the load of the start leaves them.";
    }
    Drawing::stack(&panels).figure("loads", &caption)
}

/// A range without the peak of an impulsive start, where there is one that would flatten the rest.
pub(super) fn settled_range(values: &[f64]) -> Option<(f64, f64)> {
    let all = |s| quantile(values.to_vec(), s);
    let (lo, hi) = (all(0.02), all(0.98));
    let pad = 0.3 * (hi - lo);
    let wider = all(1.0) - all(0.0) > 2.2 * (hi - lo);
    (wider && pad > 0.0).then_some((lo - pad, hi + pad))
}

fn spectra(report: &FlowReport) -> Option<Figure> {
    let bodies = curves(report);
    let mut chart: Option<LineChart> = None;
    let mut peak = None;
    for (k, body) in bodies.iter().enumerate() {
        let Some((frequencies, amplitudes)) = &body.spectrum else { continue };
        let unit = if report.settings.reference.is_some() { "" } else { "N/m" };
        let empty = || {
            let amplitude = Axis::new("amplitude of the lift", unit).log();
            let most = 8.0 * body.numbers.frequency.unwrap_or(0.0);
            let frequency = Axis::new("frequency *f*", "Hz").range(0.0, most);
            LineChart::new(frequency, shown_decades(amplitude, amplitudes))
        };
        let name = if bodies.len() > 1 { literal(&body.name) } else { String::new() };
        let series = Series::line(&name, frequencies, amplitudes).colour(k);
        chart = Some(chart.unwrap_or_else(empty).series(series));
        peak = peak.or_else(|| Some((body.numbers.frequency?, body.numbers.strouhal)));
    }
    let chart = match peak {
        None => chart?,
        Some((f, strouhal)) => {
            let strouhal =
                strouhal.map_or(String::new(), |st| format!(", St = {}", significant(st, 4)));
            chart?.mark(f, &format!("*f* = {} Hz{strouhal}", significant(f, 4)))
        }
    };
    let caption = "Amplitude spectrum of the lift over the shaded periods; the marked frequency is that of \
        the periods themselves, St = *fL*/*U*.";
    Some(chart.draw(260.0).figure("lift-spectrum", caption))
}

/// Five decades below the peak, as what is lower is round-off and leakage, and room for its label.
fn shown_decades(axis: Axis, amplitudes: &[f64]) -> Axis {
    let top = amplitudes.iter().copied().filter(|a| a.is_finite()).fold(0.0, f64::max);
    axis.range(1e-5 * top, 8.0 * top)
}

/// The coefficients that the summary has of the bodies, or of all boundaries where there is no body.
fn coefficients(report: &FlowReport) -> Option<Table> {
    report.settings.reference?;
    let any = report.loads.iter().any(|boundary| boundary.is_body);
    let row = |boundary: &BoundaryLoads| {
        let n = &boundary.numbers;
        let all = [n.drag_max, n.drag_mean, n.lift_max, n.lift_mean, n.lift_rms, n.strouhal];
        let periods = if n.periods > 0 { n.periods.to_string() } else { NOTHING.into() };
        let cells = all.map(number).into_iter().chain([periods]);
        std::iter::once(literal(&boundary.name)).chain(cells).collect()
    };
    let drag = ["", "largest *C*_{D}", "mean *C*_{D}"];
    let lift = ["largest *C*_{L}", "mean *C*_{L}", "RMS of *C*_{L}", "St", "periods"];
    let shown = report.loads.iter().filter(|boundary| boundary.is_body || !any);
    Some(Table::new(&[&drag[..], &lift[..]].concat()).rows(shown.map(row)))
}

/// The forces that the summary has of all boundaries.
fn forces(report: &FlowReport) -> Table {
    let row = |boundary: &BoundaryLoads| {
        let n = &boundary.numbers;
        let [x, y] = [0, 1].map(|d| number(n.force_mean.map(|force| force[d])));
        let check = n.cross_check.map_or(NOTHING.into(), |c| significant(100.0 * c, 2));
        vec![literal(&boundary.name), x, y, check]
    };
    let head = ["boundary", "mean *F*_{x} (N/m)", "mean *F*_{y} (N/m)", "integral (%)"];
    Table::new(&head).rows(report.loads.iter().map(row))
}

fn number(value: Option<f64>) -> String {
    value.map_or(NOTHING.into(), |v| significant(v, 5))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_start_does_not_flatten_the_rest() {
        let settled: Vec<f64> = (0..1000).map(|k| 3.0 + (0.1 * f64::from(k)).sin()).collect();
        assert_eq!(settled_range(&settled), None);
        let mut started = settled;
        started[0] = 500.0;
        let (lo, hi) = settled_range(&started).expect("cut");
        assert!((1.0..2.0).contains(&lo) && (4.0..5.0).contains(&hi), "{lo} {hi}");
        assert_eq!(settled_range(&[2.0; 9]), None);
        assert_eq!(settled_range(&[]), None);
    }
}
