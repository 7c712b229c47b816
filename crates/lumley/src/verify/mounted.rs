//! A cylinder that a stream moves across itself, Re = 100: on a spring, as Shiels, Leonard and Roshko (2001) have it with m* = 5 and
//! k* = 4.74, and without mass and spring.

use super::Tolerance::{Absolute, AtMost, Relative};
use super::flow::{Benchmark, Expected, Line};
use crate::summary::Summary;

pub(super) const BENCHMARKS: &[Benchmark] = &[
    Benchmark {
        name: "viv",
        case: "viv",
        settings: &[BRIEF],
        coarse: false,
        full: true,
        expected: Expected::Numbers(on_a_spring),
    },
    Benchmark {
        name: "viv dt/2",
        case: "viv",
        settings: &[BRIEF, "time.step=0.025", "time.end=130", "record.start=110"],
        coarse: false,
        full: true,
        expected: Expected::Numbers(on_a_spring),
    },
    Benchmark {
        name: "viv fine",
        case: "viv",
        settings: &[
            BRIEF,
            FINE[0],
            FINE[1],
            FINE[2],
            FINE[3],
            FINE[4],
            "time.end=130",
            "record.start=110",
        ],
        coarse: false,
        full: true,
        expected: Expected::Numbers(on_a_spring),
    },
    Benchmark {
        name: "massless",
        case: "massless-cylinder",
        settings: &[BRIEF],
        coarse: false,
        full: true,
        expected: Expected::Numbers(massless),
    },
    // The force that a spring needs to swing a mass at the frequency of the massless cylinder is no force: k = m (2 pi f)^2.
    Benchmark {
        name: "tuned",
        case: "viv",
        settings: &[BRIEF, "bodies.cylinder.joint.spring.stiffness=2.224"],
        coarse: false,
        full: true,
        expected: Expected::Numbers(without_force),
    },
];

const BRIEF: &str = "output.paraview=200";

/// Sizes of two thirds: 3844 cells in place of 1878.
const FINE: [&str; 5] = [
    "mesh.size=0.9",
    "mesh.growth=0.08",
    "mesh.bodies.cylinder.size=0.08",
    "mesh.bodies.cylinder.layers.first=0.025",
    "mesh.bodies.cylinder.layers.count=7",
];

/// What is accepted of amplitude and frequency round Shiels' numbers, and what an independent computation has of the drag.
fn on_a_spring(summary: &Summary) -> Vec<Line> {
    let motion = summary.bodies.get("cylinder").map(|body| &body.motion);
    vec![
        Line::new("amplitude", "m", (0.455, Absolute(0.02)), motion.map(|motion| motion.amplitude)),
        Line::new("frequency", "Hz", (0.155, Absolute(0.003)), motion.and_then(|m| m.frequency)),
        Line::new("mean drag coefficient", "1", (1.725, Relative(0.01)), drag(summary)),
    ]
}

/// Lumley's own, on meshes of 551, 1878 and 3844 cells: 0.429, 0.422, 0.421 m and 0.1503, 0.1501, 0.1500 Hz. The next case
/// agrees.
fn without_force(summary: &Summary) -> Vec<Line> {
    let motion = summary.bodies.get("cylinder").map(|body| &body.motion);
    vec![
        Line::new(
            "amplitude",
            "m",
            (0.421, Relative(0.015)),
            motion.map(|motion| motion.amplitude),
        ),
        Line::new("frequency", "Hz", (0.150, Relative(0.005)), motion.and_then(|m| m.frequency)),
        Line::new("mean drag coefficient", "1", (1.662, Relative(0.01)), drag(summary)),
    ]
}

fn massless(summary: &Summary) -> Vec<Line> {
    let lift = summary.loads.get("cylinder").and_then(|load| load.lift_coefficient_rms);
    let mut lines = without_force(summary);
    lines.push(Line::new("lift coefficient, RMS", "1", (1e-6, AtMost), lift));
    lines
}

fn drag(summary: &Summary) -> Option<f64> {
    summary.loads.get("cylinder")?.drag_coefficient_mean
}
