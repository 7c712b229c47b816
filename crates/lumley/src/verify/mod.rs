//! The reference numbers, and what this program makes of them.
//!
//! The piston in two canonical cases: A leaves the block alone (c_F = 0), B is truly coupled (c_F = 1). The flow past a
//! cylinder in a channel in the benchmark's cases 2D-1 and 2D-2. Bodies that a flow moves: the paper's disc on a hinged bar,
//! cylinders across a stream, a disc that sinks. Everything is computed by the same stages as `lumley run`, in a directory that is
//! removed afterwards.

mod flow;
mod full;
mod mounted;
mod pendulum;
mod piston;
mod sinking;

use crate::Error;
use crate::progress::Progress;
use crate::summary::Summary;
use flow::benchmarks;
use full::Bench;
use piston::{CASES, rows};
use std::path::Path;

/// Computes the table, in runs below `folder`, and hands it over case by case. With `full`, the lines that
/// take longer too: the accuracy of the time schemes, long runs, changed parameters, 2D-2, most of the bodies.
///
/// # Errors
/// Whatever ends a run.
pub fn table(
    folder: &Path,
    full: bool,
    progress: &mut Progress,
    mut show: impl FnMut(&Row) -> Result<(), Error>,
) -> Result<Vec<Row>, Error> {
    let mut all = Vec::new();
    let mut bench = Bench::new(folder, progress);
    for (k, (name, settings)) in CASES.iter().enumerate() {
        let settings: Vec<String> = settings.iter().map(|&s| s.to_owned()).collect();
        let (_, summary) = bench.run(name, &settings)?;
        let mut lines = rows(k, &summary);
        if full {
            lines.extend(bench.rows(k, name, &settings, &summary)?);
        }
        for line in &lines {
            show(line)?;
        }
        all.extend(lines);
    }
    for benchmark in benchmarks().filter(|benchmark| full || !benchmark.full) {
        let lines = bench.flow(benchmark)?;
        for line in &lines {
            show(line)?;
        }
        all.extend(lines);
    }
    Ok(all)
}

/// One line of the table.
///
/// ```
/// use lumley::verify::{Row, Tolerance};
/// let row = Row {
///     case: "A", quantity: "X(1)".into(), unit: "m",
///     reference: 0.9886101, tolerance: Tolerance::Absolute(5e-6), computed: Some(0.988_612),
/// };
/// assert!(row.passes());
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// `A` or `B` of the piston, or a short name of a flow.
    pub case: &'static str,
    /// What is compared.
    pub quantity: String,
    /// Its unit.
    pub unit: &'static str,
    /// The reference number.
    pub reference: f64,
    /// How far from it a right program may be.
    pub tolerance: Tolerance,
    /// What came out; `None` where nothing did.
    pub computed: Option<f64>,
}

/// How far a number may be from its reference.
///
/// ```
/// use lumley::verify::Tolerance;
/// assert_eq!(Tolerance::Relative(0.01).width(-50.0), 0.5);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tolerance {
    /// This far, in the quantity's unit.
    Absolute(f64),
    /// This share of the reference.
    Relative(f64),
    /// At least the reference: the claim is that it is bad. A blow-up, infinite, passes.
    AtLeast,
    /// At most the reference.
    AtMost,
}

impl Tolerance {
    /// The width round `reference`, in its unit.
    pub fn width(self, reference: f64) -> f64 {
        match self {
            Self::Absolute(width) => width,
            Self::Relative(share) => share * reference.abs(),
            Self::AtLeast | Self::AtMost => f64::INFINITY,
        }
    }
}

impl Row {
    /// Whether the computed number is within the tolerance.
    pub fn passes(&self) -> bool {
        match (self.tolerance, self.computed) {
            (_, None) => false,
            (Tolerance::AtLeast, Some(x)) => x >= self.reference,
            (Tolerance::AtMost, Some(x)) => x <= self.reference,
            (tolerance, Some(x)) => (x - self.reference).abs() <= tolerance.width(self.reference),
        }
    }

    /// The line as it is printed.
    pub fn line(&self) -> String {
        let computed = match self.computed {
            None => "nothing".to_owned(),
            Some(x) if x.is_infinite() => "blew up".to_owned(),
            Some(x) => format!("{x:.7}"),
        };
        let tolerance = match self.tolerance {
            Tolerance::AtLeast => "or more".to_owned(),
            Tolerance::AtMost => "or less".to_owned(),
            Tolerance::Absolute(width) => format!("{width}"),
            Tolerance::Relative(share) => format!("{} %", 100.0 * share),
        };
        let verdict = if self.passes() { "pass" } else { "FAIL" };
        let Self { case, quantity, unit, .. } = self;
        let reference = format!("{:.7}", self.reference);
        let reference = reference.trim_end_matches('0').trim_end_matches('.');
        format!(
            "{case:<9} {quantity:<34} {reference:>12} {computed:>13} {unit:<6} {tolerance:>8}  {verdict}"
        )
    }

    /// The heading above [`line`](Self::line)s.
    pub fn heading() -> String {
        let (quantity, reference, computed, tolerance) =
            ("quantity", "reference", "computed", "within");
        let (case, unit) = ("case", "unit");
        format!("{case:<9} {quantity:<34} {reference:>12} {computed:>13} {unit:<6} {tolerance:>8}")
    }
}

/// Res of a reduced model with `modes` modes, in percent, as the summary has it; infinite where it blew up.
fn res(summary: &Summary, label: &str, modes: usize) -> Option<f64> {
    let model = summary.rom.iter().find(|model| model.label == label)?;
    let place = model.modes.iter().position(|n| *n == modes)?;
    let blew_up = model.failure[place].as_ref().map(|_| f64::INFINITY);
    model.res_percent[place].or(blew_up)
}
