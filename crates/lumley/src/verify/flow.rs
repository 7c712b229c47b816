//! The benchmark of Schäfer and Turek (1996): a cylinder in a channel, steady (2D-1) and shedding vortices (2D-2).

use super::Row;
use super::Tolerance::{self, Absolute, Relative};
use crate::summary::Summary;

/// What is compared, its unit, the reference, the tolerance, and where it stands.
type Line = (&'static str, &'static str, f64, Tolerance, fn(&Summary) -> Option<f64>);

/// A case of lumley's own with these settings, and what must come out.
pub(super) struct Benchmark {
    pub name: &'static str,
    pub case: &'static str,
    pub settings: &'static [&'static str],
    /// Whether it takes long.
    pub full: bool,
    lines: &'static [Line],
}

/// Digits of later computations with spectral and high-order elements.
const STEADY: &[Line] = &[
    ("drag coefficient", "1", 5.579_54, Relative(1e-3), |s| {
        s.loads.get("cylinder")?.drag_coefficient_max
    }),
    ("lift coefficient", "1", 0.010_619, Relative(5e-3), |s| {
        s.loads.get("cylinder")?.lift_coefficient_max
    }),
    ("pressure difference", "Pa", 0.117_52, Relative(1e-3), |s| s.pressure_difference),
];

const UNSTEADY: &[Line] = &[
    ("largest drag coefficient", "1", 3.2277, Relative(5e-3), |s| {
        s.loads.get("cylinder")?.drag_coefficient_max
    }),
    ("largest lift coefficient", "1", 0.9869, Relative(1e-2), |s| {
        s.loads.get("cylinder")?.lift_coefficient_max
    }),
    ("Strouhal number", "1", 0.300, Absolute(5e-3), |s| s.loads.get("cylinder")?.strouhal),
];

pub(super) const BENCHMARKS: &[Benchmark] = &[
    Benchmark { name: "2D-1", case: "cylinder-2d1", settings: &[], full: false, lines: STEADY },
    Benchmark {
        name: "2D-2",
        case: "cylinder-2d2",
        settings: &["output.paraview=8"],
        full: true,
        lines: UNSTEADY,
    },
    // 2D-2 with half the step: not by luck.
    Benchmark {
        name: "dt/2",
        case: "cylinder-2d2",
        settings: &["output.paraview=8", "time.step=0.0025"],
        full: true,
        lines: UNSTEADY,
    },
];

impl Benchmark {
    /// The lines, with the numbers of a run.
    pub fn rows(&self, summary: &Summary) -> Vec<Row> {
        let row = |&(quantity, unit, reference, tolerance, computed): &Line| Row {
            case: self.name,
            quantity,
            unit,
            reference,
            tolerance,
            computed: computed(summary),
        };
        self.lines.iter().map(row).collect()
    }
}
