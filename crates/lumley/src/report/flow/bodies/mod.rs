//! The bodies: how they are held, how they moved, and where they are at the end.

mod charts;
mod data;
mod energy;
mod instants;
mod periods;
mod quantity;
mod words;

pub use data::{
    BodiesReport, BodyMotion, BodyNumbers, CoordinateMotion, CoordinateNumbers, FinalState,
};
pub(super) use words::springs;

use super::FlowReport;
use crate::report::html::{Section, Table};
use crate::report::literal;
use crate::report::number::{NOTHING, short, significant};
use quantity::Quantity;

/// The section of the bodies, where there are any.
pub(super) fn section(report: &FlowReport) -> Option<Section> {
    let bodies = &report.bodies;
    if bodies.bodies.is_empty() {
        return None;
    }
    let section = Section::new("Bodies").paragraph(&what(report)).table(&words::table(bodies));
    let section = charts::figures(report).into_iter().fold(section, Section::figure);
    let section = periods::add(report, section);
    let section = energy::figure(report).into_iter().fold(section, Section::figure);
    let section = end(bodies).iter().fold(section, Section::table);
    let section = coordinates(bodies).iter().fold(section, Section::table);
    Some(instants::add(report, section))
}

fn what(report: &FlowReport) -> String {
    let [gx, gy] = report.bodies.gravity;
    let weight = if [gx, gy] == [0.0; 2] {
        String::new()
    } else {
        format!(
            " Gravity is ({}, {}) m/s^{{2}}; a body in the fluid feels its weight less that of the fluid that it \
             displaces.",
            short(gx),
            short(gy)
        )
    };
    format!(
        "Rigid bodies, moved by the fluid, by springs and by what is prescribed, (16)–(23). An angle is that of \
         the body itself, counterclockwise; loads are about the centre of mass. Bodies without a boundary \
         are dry: the fluid does not see them.{weight}"
    )
}

/// Key numbers of the first body that has periods.
pub(super) fn facts(report: &FlowReport) -> Vec<(String, String)> {
    let mut periodic = report.bodies.bodies.iter().filter(|body| body.numbers.periods > 0);
    let Some(BodyMotion { setup, numbers, .. }) = periodic.next() else { return Vec::new() };
    let all = [(numbers.amplitude, "m", "amplitude"), (numbers.frequency, "Hz", "frequency")];
    let fact = |(value, unit, what): (Option<f64>, &str, &str)| {
        let value = format!("{}\u{a0}{unit}", significant(value?, 4));
        Some((value, format!("{what} of {}", literal(&setup.name))))
    };
    all.into_iter().filter_map(fact).collect()
}

/// Where the bodies are at the end, as far as the summary says it.
fn end(bodies: &BodiesReport) -> Option<Table> {
    let states = || bodies.bodies.iter().filter_map(|b| Some((&b.setup.name, b.numbers.state?)));
    let (_, FinalState { time, .. }) = states().next()?;
    let row = |(name, state): (&String, FinalState)| {
        let FinalState { centre: [x, y], angle, velocity: [u, v], spin, .. } = state;
        let numbers = [x, y, angle, u, v, spin].map(|value| significant(value, 6));
        std::iter::once(literal(name)).chain(numbers).collect()
    };
    let first = format!("at *t* = {} s", short(time));
    let head = [
        &first,
        "*x*_{G} (m)",
        "*y*_{G} (m)",
        "angle (rad)",
        "*u*_{G} (m/s)",
        "*v*_{G} (m/s)",
        "spin (rad/s)",
    ];
    Some(Table::new(&head).rows(states().map(row)))
}

/// The numbers that the summary has of the coordinates.
fn coordinates(bodies: &BodiesReport) -> Option<Table> {
    let all = bodies.bodies.iter().flat_map(|b| b.coordinates.iter().map(move |c| (b, c)));
    let known: Vec<_> = all.filter(|(_, c)| c.numbers.position.is_some()).collect();
    let row = |(body, coordinate): &(&BodyMotion, &CoordinateMotion)| {
        let Quantity { symbol, unit, .. } = Quantity::of(&coordinate.name);
        let n = &coordinate.numbers;
        // Without periods an amplitude says nothing.
        let amplitude = n.amplitude.filter(|_| n.frequency.is_some());
        let numbers = [n.position, n.velocity, amplitude, n.frequency];
        let numbers = numbers.map(|value| value.map_or(NOTHING.into(), |v| significant(v, 6)));
        let name = format!("{symbol} of {} ({unit})", literal(&body.setup.name));
        std::iter::once(name).chain(numbers).collect()
    };
    let head = ["coordinate", "at the end", "velocity (per s)", "amplitude", "frequency (Hz)"];
    (!known.is_empty()).then(|| Table::new(&head).rows(known.iter().map(row)))
}
