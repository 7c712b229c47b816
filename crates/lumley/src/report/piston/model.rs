//! The equations and the constants.

use super::{Parameters, PistonReport};
use crate::report::html::{Section, Table};
use crate::report::literal;
use crate::report::number::exact;

const FLUID: &str = include_str!("equations.html");

pub(super) fn section(report: &PistonReport) -> Section {
    let section = Section::new("The model")
        .paragraph(&format!(
            "A viscous flow on (0, *X*(*t*)) is moved by a rigid block that a spring holds, {}; the \
             block fills the rest of the domain, up to *L*. With *w* the velocity of the moving mesh:",
            if report.parameters.force_factor == 0.0 { "and does not act on it" } else { "and acts on it" },
        ))
        .raw(FLUID)
        .table(&constants(&report.parameters));
    match report.parameters.discretisation.as_str() {
        "" => section,
        text => section.paragraph(&format!("Full-order model: {}.", literal(text))),
    }
}

fn constants(p: &Parameters) -> Table {
    let row = |symbol: &str, meaning: &str, value: f64, unit: &str| {
        vec![symbol.into(), meaning.into(), format!("{} {unit}", exact(value))]
    };
    Table::new(&["", "constant", "value"]).labels(3).rows([
        row("*ν*", "kinematic viscosity", p.viscosity, "m^{2}/s"),
        row("*m*", "mass of the block", p.mass, "kg"),
        row("*K*", "stiffness of the spring", p.stiffness, "N/m"),
        row("*b*", "damping", p.damping, "N s/m"),
        row("*x*_{0}", "length of the spring at rest", p.spring_length, "m"),
        row(
            "*c*_{F}",
            "force factor (0: the fluid does not act on the block)",
            p.force_factor,
            "kg/m",
        ),
        row("*X*(0)", "initial position", p.initial_position, "m"),
        row("*X*′(0)", "initial velocity", p.initial_velocity, "m/s"),
        vec!["*u*_{0}".into(), "initial flow".into(), literal(&p.initial_flow)],
        row("*L*", "length of the domain", p.domain_length, "m"),
        row("*T*", "end", p.end, "s"),
    ])
}
