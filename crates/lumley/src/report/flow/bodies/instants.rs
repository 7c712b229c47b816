//! What the case asks for of a body at given instants, beside what is known of it.

use super::super::{FlowReport, known};
use crate::report::html::{Section, Table};
use crate::report::literal;
use crate::report::number::{fixed, short, significant};

/// Adds the table of the instants where there are any.
pub(super) fn add(report: &FlowReport, section: Section) -> Section {
    let [(_, times), columns @ ..] = report.bodies.instants.as_slice() else { return section };
    let heads: Vec<String> = columns.iter().map(|(name, _)| head(name)).collect();
    let known = known::instants(report);
    let first = if known.is_some() { &["*t* (s)", ""][..] } else { &["*t* (s)"] };
    let heads: Vec<&str> = first.iter().copied().chain(heads.iter().map(String::as_str)).collect();
    let mut table = Table::new(&heads).labels(first.len());
    for (k, &time) in times.iter().enumerate() {
        let value = |(name, values): &(String, Vec<f64>)| number(name, values.get(k).copied());
        let values = columns.iter().map(value);
        let said = known.as_ref().map(|_| "this run".to_string());
        table = table.row(std::iter::once(short(time)).chain(said).chain(values));
        let reference = known.as_ref().and_then(|rows| rows.iter().find(|row| row.is_at(time)));
        if let Some(row) = reference {
            let values = columns.iter().map(|(name, _)| number(name, row.value(name)));
            let said = [String::new(), "reference".into()];
            table = table.row(said.into_iter().chain(values));
        }
    }
    let section = section.table(&table);
    match known {
        None => section,
        Some(_) => section.paragraph(
            "The rows of the reference are of an independent computation with 7080 biquadratic cells. *F*_{x} \
             moves the disc; *F*_{y} and *M*_{G} are small, as the motion hardly disturbs the symmetry.",
        ),
    }
}

/// A value in the digits that it has in the source of the references, where it has some there.
fn number(name: &str, value: Option<f64>) -> String {
    let value = value.unwrap_or(f64::NAN);
    match name {
        "theta" | "phi" | "fy" => fixed(value, 5),
        "fx" => fixed(value, 4),
        "mg" => fixed(value, 6),
        _ => significant(value, 6),
    }
}

/// The name of a column in markup, with its unit.
fn head(name: &str) -> String {
    match name {
        "theta" => "*θ* (rad)".into(),
        "phi" => "*φ* (rad)".into(),
        "fx" => "*F*_{x} (N/m)".into(),
        "fy" => "*F*_{y} (N/m)".into(),
        "mg" => "*M*_{G} (N)".into(),
        other => literal(other),
    }
}
