//! Flows with bodies: what a run says of them.

use crate::{Answer, Desk};
use faer::Mat;
use lumley::record::Record;
use lumley::summary::{FlowProbe, Probe, Summary, TransferErrors};
use std::f64::consts::FRAC_PI_2;
use std::fs;

/// Name of the case on the desk.
pub const PENDULUM: &str = "hinged-disc";
/// The paper's disc on a hinged bar, on a mesh of some 500 cells and for a second.
const CASE: &str = r#"
[flow]
density = 1.0
viscosity = 0.01
initial = { velocity = [1, 0] }
boundaries.left = { kind = "velocity", velocity = [1, 0] }
boundaries.right = { kind = "traction-free" }
boundaries.bottom = { kind = "velocity", velocity = [1, 0] }
boundaries.top = { kind = "velocity", velocity = [1, 0] }
boundaries.rim = { kind = "no-slip" }

[mesh]
x = [0, 21]
y = [0, 12]
size = 1.5
growth = 0.3
bodies = [{ name = "rim", shape = { kind = "disc", centre = [7, 6], radius = 0.5 }, size = 0.2 }]

[[bodies]]
name = "bar"
mass = 1
shape = { kind = "bar", length = 5.5 }
centre = [7, 2.75]
angle = 1.5707963267948966
joint = { kind = "revolute", at = [7, 0] }

[[bodies]]
name = "disc"
mass = 50
shape = { kind = "disc", radius = 0.5 }
centre = [7, 6]
angle = 1.5707963267948966
joint = { kind = "revolute", at = [7, 5.5], to = "bar" }
boundary = "rim"

[time]
end = 1.0
step = 0.05
scheme = "implicit-euler"

[grid]
nodes = [85, 49]

[record]
start = 0.1
interval = 0.1

[pod]
modes = 2
every = 5

[output.probes]
times = [0.55, 0.975]
body = "disc"
coordinates = { theta = "bar.angle", phi = "disc.angle" }
"#;

impl Desk {
    /// Puts the pendulum on the desk.
    pub fn take_pendulum(&self) -> String {
        let path = format!("{PENDULUM}/case.toml");
        self.write(&path, CASE.as_bytes());
        path
    }

    /// Runs it with these settings.
    fn pendulum(&self, settings: &[&str], run: &str) -> Answer {
        let path = self.take_pendulum();
        let mut arguments = vec!["run", &path, "--json", "-o", run];
        arguments.extend(settings.iter().flat_map(|setting| ["--set", setting]));
        self.lumley(&arguments)
    }

    /// A column of a table of a run.
    fn column(&self, name: &str, header: &str) -> Vec<f64> {
        let columns = self.table(name);
        let found = columns.into_iter().find(|(found, _)| found == header);
        found.unwrap_or_else(|| panic!("no {header}")).1
    }
}

fn probes(summary: &Summary) -> Vec<&FlowProbe> {
    summary.probes.iter().filter_map(Probe::flow).collect()
}

fn near(value: f64, expected: f64, distance: f64) {
    assert!((value - expected).abs() <= distance, "{value}, expected {expected}");
}

/// The table of the bodies, and all that says the same in other words.
#[test]
fn bodies_are_told_once_in_every_way() {
    let desk = Desk::new();
    let summary = desk.pendulum(&[], "run").good().summary();
    assert!(summary.warnings.is_empty(), "{:?}", summary.warnings);
    let column = |header: &str| desk.column("run/bodies.csv", header);
    let (theta, phi) = (column("bar.angle"), column("disc.angle"));
    assert_eq!(
        (theta[0], phi[0], theta.len()),
        (FRAC_PI_2, FRAC_PI_2, 21),
        "the start and 20 steps"
    );
    assert_eq!(column("time"), [vec![0.0], desk.column("run/loads.csv", "time")].concat());

    // Paper eqs. (18) and (19), and the rate of an implicit Euler step.
    let rates = column("disc.angle'");
    let [x, y] = ["disc.centre_x", "disc.centre_y"].map(&column);
    let bar = column("bar.centre_x");
    for k in 0..21 {
        near(x[k], 7.0 + 5.5 * theta[k].cos() + 0.5 * phi[k].cos(), 1e-12);
        near(y[k], 5.5 * theta[k].sin() + 0.5 * phi[k].sin(), 1e-12);
        near(bar[k], 7.0 + 2.75 * theta[k].cos(), 1e-12);
        if k > 0 {
            near(rates[k], (phi[k] - phi[k - 1]) / 0.05, 1e-9);
        }
    }
    assert_eq!(column("disc.orientation"), phi);
    assert!(x[20] > 7.02, "the stream carries it: {}", x[20]);

    the_summary_agrees(&summary, [&theta, &phi], [&x, &y]);
    the_record_agrees(&desk, [&theta, &phi], [&x, &y]);
    the_probes_agree(&desk, &summary, [&theta, &phi]);
}

fn the_summary_agrees(summary: &Summary, [theta, phi]: [&[f64]; 2], [x, y]: [&[f64]; 2]) {
    let (bar, disc) = (&summary.bodies["bar"], &summary.bodies["disc"]);
    assert_eq!(disc.state.centre, [x[20], y[20]]);
    assert_eq!((disc.state.time, disc.state.angle, bar.state.angle), (1.0, phi[20], theta[20]));
    assert_eq!(disc.coordinates["disc.angle"].position, phi[20]);
    assert_eq!(disc.state.spin, disc.coordinates["disc.angle"].velocity);
    near(disc.state.velocity[0], (x[20] - x[19]) / 0.05, 1e-4);
    // It has no period: half of the way in the later half of the run.
    assert_eq!((disc.direction.as_str(), disc.motion.frequency), ("x", None));
    assert_eq!((disc.motion.periods, disc.motion.window), (0, [0.5, 1.0]));
    near(disc.motion.amplitude, 0.5 * (x[20] - x[10]), 1e-15);
    near(bar.coordinates["bar.angle"].amplitude, 0.5 * (theta[10] - theta[20]), 1e-15);
}

/// Snapshots are at 0.1 s, 0.2 s, ...
fn the_record_agrees(desk: &Desk, [theta, phi]: [&[f64]; 2], [x, y]: [&[f64]; 2]) {
    let record = Record::open(desk.path("run/record")).expect("a record");
    let [bar, disc] = ["position-bar", "position-disc"].map(|name| record.series(name));
    let (bar, disc) = (bar.expect("dry bodies too"), disc.expect("a wet body"));
    let angle = record.series("body-disc_angle").expect("a coordinate");
    for k in 0..10 {
        let row = 2 * (k + 1);
        assert_eq!(angle.at(k)[0], phi[row]);
        let &[dx, dy, turn] = disc.at(k) else { panic!("x, y and angle") };
        near(turn, phi[row] - FRAC_PI_2, 1e-15);
        // The hinge at (7, 5.5) is the pivot, half a metre from the centre.
        near(7.0 + dx + 0.5 * phi[row].cos(), x[row], 1e-12);
        near(5.5 + dy + 0.5 * phi[row].sin(), y[row], 1e-12);
        assert_eq!(bar.at(k)[..2], [0.0, 0.0], "its pivot is the hinge on the ground");
        near(bar.at(k)[2], theta[row] - FRAC_PI_2, 1e-15);
    }
}

/// In the disc the record has its rigid motion: `l theta'` and `r phi'` across bar and radius, and the spin.
#[test]
fn the_record_has_the_velocity_of_the_body() {
    let desk = Desk::new();
    desk.pendulum(&[], "run").good();
    let column = |header: &str| *desk.column("run/bodies.csv", header).last().expect("a row");
    let [theta, phi] = ["bar.angle", "disc.angle"].map(column);
    let [bar, spin] = ["bar.angle'", "disc.angle'"].map(column);
    let centre = ["disc.centre_x", "disc.centre_y"].map(column);
    let velocity = [
        -5.5 * bar * theta.sin() - 0.5 * spin * phi.sin(),
        5.5 * bar * theta.cos() + 0.5 * spin * phi.cos(),
    ];
    let fixed = Record::open(desk.path("run/record")).and_then(|record| record.frame("fixed"));
    let mut last = Mat::zeros(2 * 85 * 49, 1);
    fixed.expect("a frame").read_block(0..last.nrows(), 9..10, last.as_mut()).expect("a snapshot");
    for [column, row] in [[28, 24], [27, 24], [29, 25]] {
        let arm = [0.25 * column as f64 - centre[0], 0.25 * row as f64 - centre[1]];
        let node = row * 85 + column;
        near(last[(node, 0)], velocity[0] - spin * arm[1], 1e-14);
        near(last[(85 * 49 + node, 0)], velocity[1] + spin * arm[0], 1e-14);
    }
}

/// A probe at a step is this step's, one between two steps is between them.
fn the_probes_agree(desk: &Desk, summary: &Summary, [theta, phi]: [&[f64]; 2]) {
    let loads = ["rim.fx", "rim.fy", "rim.moment"].map(|name| desk.column("run/loads.csv", name));
    let [at, between] = probes(summary)[..] else { panic!("two probes") };
    near(at.coordinates["theta"], theta[11], 1e-14);
    near(at.coordinates["phi"], phi[11], 1e-14);
    near(between.coordinates["theta"], 0.5 * (theta[19] + theta[20]), 1e-14);
    for (load, [there, later]) in
        loads.iter().zip([[at.fx, between.fx], [at.fy, between.fy], [at.mg, between.mg]])
    {
        near(there, load[10], 1e-12);
        near(later, 0.5 * (load[18] + load[19]), 1e-12);
    }
    // The canonical case has 0.7161 N/m at 0.55 s on a fine mesh with a fine step.
    near(at.fx, 0.7161, 0.02);
}

/// POD of every fifth snapshot is the POD of a run that records those alone.
#[test]
fn some_snapshots_are_decomposed_alone() {
    let desk = Desk::new();
    let all = desk.pendulum(&[], "all").good().summary();
    let fifth = ["record.start=0.5", "record.interval=0.5", "pod.every=2"];
    let few = desk.pendulum(&fifth, "few").good().summary();
    let every = all.pod_every.expect("every fifth");
    assert_eq!((every.every, every.snapshots, every.eigenvalues.len()), (5, 2, 2));
    assert_eq!(every.eigenvalues, few.pod.eigenvalues);
    assert_eq!(every.cumulative_percent, few.pod.cumulative_percent);
    assert_eq!(every.res_percent, few.projection.res_percent);
    assert!(every.res_percent[0] < all.projection.res_percent[0]);
    assert!(few.pod_every.is_some_and(|every| every.snapshots == 1));

    desk.pendulum(&["pod.every=11"], "none").refused(2, &["pod.every", "11", "10 snapshots"]);
    desk.pendulum(&["pod.every=1"], "none").refused(2, &["pod.every", "from 2"]);
}

/// What either way to the grid loses: more by inverse distance, less on a finer grid; and how far modes and
/// snapshots are from being free of divergence.
#[test]
fn the_way_to_the_grid_is_measured() {
    let desk = Desk::new();
    let coarse = desk.pendulum(&[], "coarse").good().summary();
    let fine = desk.pendulum(&["grid.nodes=[211, 121]"], "fine").good().summary();
    let [coarse_l2, fine_l2] = [&coarse, &fine].map(|summary| {
        let Some(TransferErrors::Flow { finite_element, inverse_distance }) = summary.transfer
        else {
            panic!("a flow")
        };
        assert_eq!(finite_element.nodes, 0.0);
        assert!((1e-4..0.05).contains(&inverse_distance.nodes), "{inverse_distance:?}");
        assert!(inverse_distance.l2 > finite_element.l2);
        assert!(finite_element.ms > 0.0 && inverse_distance.ms > finite_element.ms);
        assert!(finite_element.max > 4.0 * finite_element.l2, "at the wall: {finite_element:?}");
        finite_element.l2
    });
    // A layer of the width h at the wall, in which the error is as large as the velocity.
    assert!((0.25..0.7).contains(&(fine_l2 / coarse_l2)), "{coarse_l2} to {fine_l2}");

    for Summary { pod, .. } in [&coarse, &fine] {
        assert_eq!(pod.divergence.len(), pod.eigenvalues.len());
        let snapshots = pod.snapshot_divergence.expect("a gradient");
        let first = pod.divergence[0].expect("a gradient");
        // Nearly all of the energy is the first mode's.
        assert!(snapshots < 0.15 && (first / snapshots - 1.0).abs() < 0.3, "{first} {snapshots}");
    }
}

/// Ten periods of a motion that is known.
#[test]
fn a_known_oscillation_is_found() {
    let desk = Desk::new();
    let long = ["time.end=80", "record.start=70", "bodies.cylinder.joint.x=\"0.01*t\""];
    let summary = desk.quick("oscillating-cylinder", &long, "run").good().summary();
    let cylinder = &summary.bodies["cylinder"];
    assert_eq!((cylinder.direction.as_str(), cylinder.motion.periods), ("y", 10));
    near(cylinder.motion.amplitude, 0.2, 2e-4);
    near(cylinder.motion.mean, 0.0, 1e-3);
    near(cylinder.motion.frequency.expect("ten periods"), 0.156, 1e-5);
    assert!(cylinder.motion.amplitudes.iter().all(|a| (a - 0.2).abs() < 1e-3));
    assert!(cylinder.motion.frequencies.iter().all(|f| (f - 0.156).abs() < 1e-3));
    let y = cylinder.coordinates["cylinder.y"];
    assert_eq!((y.amplitude, y.frequency), (cylinder.motion.amplitude, cylinder.motion.frequency));
    near(cylinder.coordinates["cylinder.x"].position, 0.8, 1e-12);
    assert_eq!(cylinder.coordinates["cylinder.x"].frequency, None);
    near(cylinder.state.velocity[0], 0.01, 1e-9);
}

/// What will not go well is said at once.
#[test]
fn explicit_coupling_warns_near_its_limit() {
    let desk = Desk::new();
    let settings = |density: &'static str| {
        [
            "motion.coupling=\"explicit\"",
            "time.end=0.2",
            "output.probes.times=[0.2]",
            density,
            "pod.every=2",
        ]
    };
    for (density, words) in
        [("flow.density=40", "has 0.6"), ("flow.density=60", "will become unstable")]
    {
        let summary = desk.pendulum(&settings(density), density).good().summary();
        let warned = summary.warnings.iter().any(|w| w.contains(words) && w.contains("monolithic"));
        assert!(warned, "{density}: {:?}", summary.warnings);
    }
    let light = desk.pendulum(&settings("flow.density=10"), "light").good().summary();
    assert!(light.warnings.is_empty(), "{:?}", light.warnings);
}

/// A run replaces an older one; what is not its own it does not touch.
#[test]
fn a_flow_replaces_a_flow() {
    let desk = Desk::new();
    let short = ["time.end=0.2", "output.probes.times=[0.2]", "pod.every=2"];
    desk.pendulum(&short, "run").good();
    let path = desk.take_pendulum();
    let mut again = vec!["run", &path, "--force", "-o", "run"];
    again.extend(short.iter().flat_map(|setting| ["--set", setting]));
    desk.lumley(&again).good();
    fs::write(desk.path("run/velocity-mine.csv"), "0,1").expect("a file");
    desk.lumley(&again).refused(2, &["velocity-mine.csv is not lumley's"]);
}
