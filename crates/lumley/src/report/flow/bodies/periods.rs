//! Amplitude and frequency, period by period.

use super::super::FlowReport;
use super::BodyMotion;
use crate::report::figure::{Axis, Drawing, Figure, LineChart, Series};
use crate::report::html::{Section, Table};
use crate::report::literal;
use crate::report::number::{NOTHING, significant};

/// Adds what there is of bodies whose motion has periods.
pub(super) fn add(report: &FlowReport, section: Section) -> Section {
    let bodies = &report.bodies.bodies;
    let periodic: Vec<&BodyMotion> = bodies.iter().filter(|b| b.numbers.periods > 0).collect();
    if periodic.is_empty() {
        return section;
    }
    let section = periodic.iter().fold(section, |section, body| section.paragraph(&settled(body)));
    let section = figure(&periodic).into_iter().fold(section, Section::figure);
    section.table(&table(report, &periodic))
}

/// How far the amplitude still changes, over the later half of the periods that are known.
fn settled(body: &BodyMotion) -> String {
    let all = &body.numbers.amplitudes;
    let last = &all[all.len() / 2..];
    let name = literal(&body.setup.name);
    let (low, high) =
        last.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), a| (l.min(*a), h.max(*a)));
    let change = 200.0 * (high - low) / (high + low);
    match last.len() {
        0 | 1 => {
            format!("The motion of {name} has too few periods to tell whether it has settled.")
        }
        n if change < 1.0 => format!(
            "The motion of {name} has settled: the amplitudes of its last {n} periods differ by {} %.",
            significant(change, 2)
        ),
        n => format!(
            "The motion of {name} has not settled: the amplitudes of its last {n} periods differ by {} %. A longer \
             run would tell where it goes.",
            significant(change, 2)
        ),
    }
}

fn figure(periodic: &[&BodyMotion]) -> Option<Figure> {
    let amplitude = panel(periodic, Axis::new("amplitude", "m"), |b| &b.numbers.amplitudes);
    let frequency = panel(periodic, Axis::new("frequency", "Hz"), |b| &b.numbers.frequencies);
    let caption = "Amplitude and frequency of each of the last periods of the motion. Where the curves are level \
        the motion has forgotten its start.";
    let some = periodic.iter().any(|body| body.numbers.amplitudes.len() > 1);
    some.then(|| Drawing::panels(2, &[amplitude, frequency]).figure("periods", caption))
}

fn panel(periodic: &[&BodyMotion], axis: Axis, values: fn(&BodyMotion) -> &[f64]) -> Drawing {
    let most = periodic.iter().map(|body| values(body).len()).max().unwrap_or(0);
    let period = Axis::new("period", "").count().range(0.5, most as f64 + 0.5);
    let chart = LineChart::new(period, axis);
    let chart = periodic.iter().enumerate().fold(chart, |chart, (k, body)| {
        let values = values(body);
        let n: Vec<f64> = (1..=values.len()).map(|n| n as f64).collect();
        let name = if periodic.len() > 1 { literal(&body.setup.name) } else { String::new() };
        let series = if n.len() <= 40 { Series::marked } else { Series::line };
        chart.series(series(&name, &n, values).colour(k))
    });
    chart.draw_at(346.0, 210.0)
}

/// What the summary says of the last periods.
fn table(report: &FlowReport, periodic: &[&BodyMotion]) -> Table {
    let reference = report.settings.reference;
    let row = |body: &&BodyMotion| {
        let n = &body.numbers;
        let number = |value: Option<f64>| value.map_or(NOTHING.into(), |v| significant(v, 5));
        let scaled = reference.map(|r| {
            let amplitude = number(n.amplitude.map(|a| a / r.length));
            [amplitude, number(n.frequency.map(|f| f * r.length / r.velocity))]
        });
        let name = format!("*{}* of {}", literal(&n.direction), literal(&body.setup.name));
        let plain = [name, number(n.amplitude), number(n.frequency), number(n.mean)];
        let plain = plain.into_iter().chain(scaled.into_iter().flatten());
        plain.chain([n.periods.to_string()]).collect()
    };
    let mut head = vec!["centre", "amplitude (m)", "frequency (Hz)", "mean (m)"];
    if reference.is_some() {
        head.extend(["amplitude/*L*", "*fL*/*U*"]);
    }
    head.push("periods");
    Table::new(&head).rows(periodic.iter().map(row))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::BodyNumbers;

    #[test]
    fn settled_is_what_changes_no_more() -> Result<(), toml::de::Error> {
        let setup = toml::from_str("name = 'a'\ncentre = [0, 0]\njoint = { kind = 'fixed' }")?;
        let (track, coordinates) = (vec![], vec![]);
        let mut body = BodyMotion { setup, track, coordinates, numbers: BodyNumbers::default() };
        let mut said = |amplitudes: &[f64]| {
            body.numbers.amplitudes = amplitudes.to_vec();
            settled(&body)
        };
        assert!(said(&[0.1, 0.2, 0.4]).contains("has not settled: the amplitudes of its last 2"));
        let grown = [[0.1; 3].as_slice(), &[0.4; 6], &[0.402]].concat();
        assert!(said(&grown).contains("last 5 periods differ by 0.50 %"), "{}", said(&grown));
        assert!(said(&[0.4]).contains("too few"));
        Ok(())
    }
}
