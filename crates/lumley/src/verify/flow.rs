//! Flows among lumley's own cases, and what must come out of them.

use super::Row;
use super::Tolerance::{self, Absolute, AtLeast, Relative};
use super::{mounted, pendulum, sinking};
use crate::summary::Summary;

/// A case of lumley's own with these settings, and what must come out.
pub(super) struct Benchmark {
    pub name: &'static str,
    pub case: &'static str,
    pub settings: &'static [&'static str],
    /// Whether the case is run as `--quick` has it.
    pub coarse: bool,
    /// Whether it takes long.
    pub full: bool,
    pub expected: Expected,
}

/// What a run must end with.
#[derive(Clone, Copy)]
pub(super) enum Expected {
    /// These numbers.
    Numbers(fn(&Summary) -> Vec<Line>),
    /// An error on the way: what it computes grows beyond all bounds.
    BlowUp(&'static str),
}

/// A number that is compared: a [`Row`] without the name of its case.
pub(super) struct Line {
    quantity: String,
    unit: &'static str,
    reference: f64,
    tolerance: Tolerance,
    computed: Option<f64>,
}

impl Line {
    pub fn new(
        quantity: impl Into<String>,
        unit: &'static str,
        (reference, tolerance): (f64, Tolerance),
        computed: Option<f64>,
    ) -> Self {
        Self { quantity: quantity.into(), unit, reference, tolerance, computed }
    }
}

/// All of them, those of a kind together.
pub(super) fn benchmarks() -> impl Iterator<Item = &'static Benchmark> {
    [CHANNEL, pendulum::BENCHMARKS, mounted::BENCHMARKS, sinking::BENCHMARKS].into_iter().flatten()
}

/// The benchmark of Schäfer and Turek (1996): a cylinder in a channel, steady (2D-1) and shedding vortices (2D-2).
const CHANNEL: &[Benchmark] = &[
    Benchmark {
        name: "2D-1",
        case: "cylinder-2d1",
        settings: &[],
        coarse: false,
        full: false,
        expected: Expected::Numbers(steady),
    },
    Benchmark {
        name: "2D-2",
        case: "cylinder-2d2",
        settings: &["output.paraview=8"],
        coarse: false,
        full: true,
        expected: Expected::Numbers(unsteady),
    },
    // 2D-2 with half the step: not by luck.
    Benchmark {
        name: "2D-2 dt/2",
        case: "cylinder-2d2",
        settings: &["output.paraview=8", "time.step=0.0025"],
        coarse: false,
        full: true,
        expected: Expected::Numbers(unsteady),
    },
];

/// Digits of later computations with spectral and high-order elements.
fn steady(summary: &Summary) -> Vec<Line> {
    let load = summary.loads.get("cylinder");
    let drag = load.and_then(|load| load.drag_coefficient_max);
    let lift = load.and_then(|load| load.lift_coefficient_max);
    vec![
        Line::new("drag coefficient", "1", (5.579_54, Relative(1e-3)), drag),
        Line::new("lift coefficient", "1", (0.010_619, Relative(5e-3)), lift),
        Line::new(
            "pressure difference",
            "Pa",
            (0.117_52, Relative(1e-3)),
            summary.pressure_difference,
        ),
    ]
}

fn unsteady(summary: &Summary) -> Vec<Line> {
    let load = summary.loads.get("cylinder");
    let drag = load.and_then(|load| load.drag_coefficient_max);
    let lift = load.and_then(|load| load.lift_coefficient_max);
    let strouhal = load.and_then(|load| load.strouhal);
    vec![
        Line::new("largest drag coefficient", "1", (3.2277, Relative(5e-3)), drag),
        Line::new("largest lift coefficient", "1", (0.9869, Relative(1e-2)), lift),
        Line::new("Strouhal number", "1", (0.300, Absolute(5e-3)), strouhal),
    ]
}

impl Benchmark {
    /// The rows of the table, with the numbers of a run; none for a run that failed.
    pub fn rows(&self, summary: Option<&Summary>) -> Vec<Row> {
        let lines = match (self.expected, summary) {
            (Expected::Numbers(lines), Some(summary)) => lines(summary),
            (Expected::Numbers(_), None) => unreachable!("a run that fails ends the table"),
            (Expected::BlowUp(quantity), summary) => {
                let computed = if summary.is_some() { 0.0 } else { f64::INFINITY };
                vec![Line::new(quantity, "1", (1.0, AtLeast), Some(computed))]
            }
        };
        let row = |Line { quantity, unit, reference, tolerance, computed }| Row {
            case: self.name,
            quantity,
            unit,
            reference,
            tolerance,
            computed,
        };
        lines.into_iter().map(row).collect()
    }
}
