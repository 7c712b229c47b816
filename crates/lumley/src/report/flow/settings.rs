//! The fluid and its boundaries.

use super::FlowReport;
use crate::report::html::{Section, Table};
use crate::report::literal;
use crate::report::number::{exact, short};

pub(super) fn section(report: &FlowReport) -> Section {
    let settings = &report.settings;
    let row = |name: &str, value: String| vec![name.to_string(), value];
    let number = |value: f64, unit: &str| format!("{} {unit}", exact(value)).trim_end().to_string();
    let mut rows = vec![
        row("density *ρ*", number(settings.density, "kg/m^{3}")),
        row("viscosity *μ*", number(settings.viscosity, "Pa s")),
    ];
    if let Some(reference) = settings.reference {
        rows.push(row("reference velocity *U*", number(reference.velocity, "m/s")));
        rows.push(row("reference length *L*", number(reference.length, "m")));
    }
    if let Some(reynolds) = settings.reynolds() {
        rows.push(row("Reynolds number *ρUL*/*μ*", short(reynolds)));
    }
    let said = |(name, value): &(String, String)| vec![literal(name), literal(value)];
    rows.extend(settings.choices.iter().map(said));
    let section = Section::new("The case").paragraph(
        "The incompressible Navier–Stokes equations on a mesh that may move, (11)–(15), by finite elements: \
         quadratic velocity with a bubble on triangles, biquadratic on quadrilaterals, and linear pressures \
         that jump from cell to cell.",
    );
    let section = section.table(&Table::new(&[]).labels(2).rows(rows));
    if settings.boundaries.is_empty() {
        return section;
    }
    let boundaries = settings.boundaries.iter().map(said);
    section.table(&Table::new(&["boundary", "what holds there"]).labels(2).rows(boundaries))
}
