//! Energies of the modes, in the layout of the paper's Tables 1 and 2.

use super::PistonReport;
use crate::report::energy::{Share, modes_for_target};
use crate::report::html::{Section, Table};
use crate::report::number::{fixed, scientific, significant};

/// The paper's Table 2: eigenvalues and cumulative energy in %.
const PAPER: [(&str, &str); 6] = [
    ("18.255", "91.648"),
    ("1.515", "99.256"),
    ("8.393 × 10^{−2}", "99.677"),
    ("6.079 × 10^{−2}", "99.982"),
    ("2.347 × 10^{−3}", "99.994"),
    ("7.804 × 10^{−4}", "99.999"),
];

pub(super) fn section(report: &PistonReport) -> Section {
    let shares = report.shares();
    let table = Table::new(&[
        "mode *i*",
        "*λ*_{i} (m^{3}/s^{2})",
        "energy (%)",
        "cumulative *E* (%)",
        "RMS error √(1\u{a0}−\u{a0}*E*) (%)",
        "paper: *λ*_{i}",
        "paper: *E* (%)",
    ])
    .rows(shares.iter().take(10).enumerate().map(|(i, share)| row(i, share)));
    let count = match modes_for_target(&shares) {
        Some(1) => "One mode holds 99.99 % of the energy, (31). ".into(),
        Some(n) => format!("{n} modes hold 99.99 % of the energy, (31). "),
        None => String::new(),
    };
    Section::new("Energy of the modes")
        .paragraph(&format!(
            "{count}*E* is the share of the energy in the first *i* modes; √(1\u{a0}−\u{a0}*E*), the \
             root-mean-square error of a projection on them, is the plainer measure: 99.99 % of \
             the energy still leaves 1 % of the velocity."
        ))
        .table(&table)
        .paragraph(
            "The paper’s figures (its Table 2) stand beside for their structure. Its eigenvalues \
             come from an unweighted sum over about 1000 nodes instead of the integral over the \
             domain, so they differ in scale, and it leaves part of its parameters unstated.",
        )
}

fn row(i: usize, share: &Share) -> Vec<String> {
    let (eigenvalue, energy) = PAPER.get(i).copied().unwrap_or_default();
    vec![
        (i + 1).to_string(),
        scientific(share.eigenvalue, 4),
        fixed(share.percent, 5),
        fixed(share.cumulative_percent, 4),
        significant(share.rms_percent, 3),
        eigenvalue.into(),
        energy.into(),
    ]
}
