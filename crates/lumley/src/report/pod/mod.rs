//! The report of a decomposition of snapshots that lumley did not make.

pub(super) mod draw;
mod drawn;
#[cfg(test)]
mod tests;

pub(super) use drawn::DrawnField;
pub use drawn::{DrawnModes, FieldGrid};

use super::energy::{self, Share};
use super::figure::{Axis, Figure, LineChart, Series};
use super::html::{Page, Report, Section, Table};
use super::literal;
use super::number::{count, fixed, scientific, significant};
use super::provenance::Provenance;

/// Everything that the report of a decomposition shows; what is missing is left out.
///
/// ```
/// use lumley::report::PodReport;
///
/// let report = PodReport {
///     source: "wake.npy".into(),
///     snapshots: 3,
///     unknowns: 2,
///     eigenvalues: vec![2.0, 0.5],
///     total_energy: 2.5,
///     ..PodReport::default()
/// };
/// assert!(report.render().page.contains("wake.npy"));
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PodReport {
    /// What was read.
    pub source: String,
    /// M, the number of snapshots.
    pub snapshots: usize,
    /// n, the numbers in one.
    pub unknowns: usize,
    /// The inner product in words: "identity", "weights of w.npy".
    pub inner_product: String,
    /// Whether the mean over time was subtracted.
    pub centred: bool,
    /// The algorithm.
    pub method: String,
    /// Why this one.
    pub reason: String,
    /// λ of the modes kept, largest first, in the square of the data's unit.
    pub eigenvalues: Vec<f64>,
    /// Sum of all λ, also of modes that are not kept.
    pub total_energy: f64,
    /// Most that an eigenvalue may be smaller than the exact one, where the method approximates.
    pub error_bound: Option<f64>,
    /// What is drawn of the modes, where their grid is known.
    pub modes: Option<DrawnModes>,
    /// `a_n` at the snapshots, one row for each mode.
    pub coefficients: Vec<Vec<f64>>,
    /// Times of the snapshots; empty if not given.
    pub times: Vec<f64>,
    /// What the user should know.
    pub warnings: Vec<String>,
    /// Where the numbers come from.
    pub provenance: Provenance,
}

impl PodReport {
    /// The page and its figures.
    pub fn render(&self) -> Report {
        let shares = energy::shares(&self.eigenvalues, self.total_energy);
        let page =
            Page::new(&literal(&self.source), "Proper orthogonal decomposition of snapshots.");
        let page = page.facts(self.facts(&shares));
        page.section(self.what())
            .section(energies(&shares, ""))
            .section(self.coefficients())
            .section(draw::section(self.modes.as_ref()))
            .section(self.provenance.section())
            .render()
    }

    fn facts(&self, shares: &[Share]) -> Vec<(String, String)> {
        let mut facts = vec![
            (count(self.snapshots), "snapshots".into()),
            (count(self.unknowns), "numbers in each".into()),
            (count(shares.len()), "modes kept".into()),
        ];
        if let Some(last) = shares.last() {
            let error = significant(last.rms_percent, 2) + " %";
            facts.push((error, "RMS error of the projection on them".into()));
        }
        facts
    }

    fn what(&self) -> Section {
        let mean = if self.centred { "subtracted" } else { "not subtracted" };
        let row = |name: &str, value: String| vec![name.to_string(), value];
        let bound = |most| format!("*λ* at most {} too small", significant(most, 2));
        let table = Table::new(&[]).labels(2).rows([
            row("snapshots", literal(&self.source)),
            row("size", format!("{} × {}", count(self.snapshots), count(self.unknowns))),
            row("mean over time", mean.into()),
            row("inner product", literal(&self.inner_product)),
            row("method", literal(&self.method)),
            row("because", literal(&self.reason)),
        ]);
        let table = table.rows(self.error_bound.map(|most| row("error bound", bound(most))));
        let section = Section::new("What was done").table(&table);
        self.warnings.iter().fold(section, |section, text| section.warning(&literal(text)))
    }

    fn coefficients(&self) -> Section {
        let section = Section::new("Temporal coefficients");
        match self.coefficients.as_slice() {
            [] => section.paragraph("There are none."),
            rows => section.figure(
                draw::coefficients(&self.times, rows, "")
                    .figure("coefficients", draw::COEFFICIENTS),
            ),
        }
    }
}

/// Table and spectrum of the energies, λ in `unit`, in markup.
pub(super) fn energies(shares: &[Share], unit: &str) -> Section {
    let row = |(i, share): (usize, &Share)| {
        vec![
            (i + 1).to_string(),
            scientific(share.eigenvalue, 4),
            significant(share.percent, 4),
            fixed(share.cumulative_percent, 4),
            significant(share.rms_percent, 3),
        ]
    };
    let eigenvalue = match unit {
        "" => "*λ*_{i}".to_string(),
        unit => format!("*λ*_{{i}} ({unit})"),
    };
    let head = [
        "mode *i*",
        &eigenvalue,
        "energy (%)",
        "cumulative *E* (%)",
        "RMS error √(1\u{a0}−\u{a0}*E*) (%)",
    ];
    let sentence = match energy::modes_for_target(shares) {
        Some(1) => "One mode holds 99.99 % of the energy, (31).".into(),
        Some(n) => format!("{} modes hold 99.99 % of the energy, (31).", count(n)),
        None => "The modes found hold less than 99.99 % of the energy, (31).".to_string(),
    };
    Section::new("Energy of the modes")
        .paragraph(&sentence)
        .figure(spectrum(shares))
        .table(&Table::new(&head).rows(shares.iter().take(20).enumerate().map(row)))
}

fn spectrum(shares: &[Share]) -> Figure {
    let n: Vec<f64> = (1..=shares.len()).map(|n| n as f64).collect();
    let column = |value: fn(&Share) -> f64| shares.iter().map(value).collect::<Vec<f64>>();
    let (energy, error) = (column(|s| s.percent), column(|s| s.rms_percent));
    let series = if n.len() <= 40 { Series::marked } else { Series::line };
    let modes = Axis::new("mode *i*", "").count().range(0.5, n.len() as f64 + 0.5);
    let caption = "Energy of each mode and the RMS error of the projection on all modes up to it. \
        A steep fall means that few modes suffice; a floor is noise or round-off.";
    LineChart::new(modes, Axis::new("share", "%").log())
        .series(series("energy *λ*_{i}/Σ*λ*", &n, &energy).colour(0))
        .series(series("RMS error √(1\u{a0}−\u{a0}*E*)", &n, &error).colour(1))
        .draw(320.0)
        .figure("spectrum", caption)
}
