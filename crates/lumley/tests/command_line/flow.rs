//! Flows: every case as a coarse run, what it leaves behind, and what stands on that.

use crate::{Answer, Desk};
use lumley::summary::Summary;
use serde_json::Value;
use std::fs;

impl Desk {
    /// Puts a case of lumley's own on the desk.
    pub fn take(&self, name: &str) -> String {
        let text = lumley::cases::find(name).expect("it comes with lumley").text;
        let path = format!("{name}/case.toml");
        self.write(&path, text.as_bytes());
        path
    }

    /// A coarse run of a case with these settings.
    pub fn quick(&self, name: &str, settings: &[&str], run: &str) -> Answer {
        let path = self.take(name);
        let mut arguments = vec!["run", &path, "--quick", "--json", "-o", run];
        arguments.extend(settings.iter().flat_map(|setting| ["--set", setting]));
        self.lumley(&arguments)
    }

    /// The columns of a table of a run.
    pub fn table(&self, name: &str) -> Vec<(String, Vec<f64>)> {
        lumley::format::csv::read_columns(&self.path(name), |_| true).expect("a table")
    }

    /// The last number of a column.
    fn last(&self, name: &str, column: &str) -> f64 {
        let table = self.table(name);
        let found = table.iter().find(|(header, _)| header == column);
        *found.and_then(|(_, values)| values.last()).expect("a number")
    }
}

impl Answer {
    pub fn summary(&self) -> Summary {
        serde_json::from_str(&self.stdout).expect("one JSON object and nothing else")
    }
}

fn near(value: Option<f64>, expected: f64, share: f64) {
    let value = value.expect("a number");
    assert!((value - expected).abs() <= share * expected.abs(), "{value}, expected {expected}");
}

/// Botella and Peyret (1998) have -0.3885698 on the vertical centre line.
#[test]
fn cavity() {
    let desk = Desk::new();
    let summary = desk.quick("cavity", &[], "run").good().summary();
    near(Some(desk.last("run/probes.csv", "u-min.u")), -0.388_569_8, 0.02);
    assert!(summary.warnings.iter().any(|warning| warning.contains("its mean is zero")));
    let fom = summary.fom.expect("a flow");
    assert!(fom.residuals.last().is_some_and(|change| *change <= 1e-10));
    assert_eq!(fom.residuals.len(), fom.steps);
}

/// Drag and pressure difference of the benchmark 2D-1.
#[test]
fn cylinder_2d1() {
    let desk = Desk::new();
    let summary = desk.quick("cylinder-2d1", &[], "run").good().summary();
    let load = summary.loads["cylinder"];
    near(load.drag_coefficient_mean, 5.579_54, 0.03);
    assert_eq!(load.drag_coefficient_mean, load.drag_coefficient_max);
    near(summary.pressure_difference, 0.117_52, 0.04);
    assert!(load.cross_check.is_some_and(|difference| difference < 0.1));
    assert_eq!(load.strouhal, None);
}

/// The Strouhal number of the benchmark 2D-2, and everything that such a run leaves.
#[test]
fn cylinder_2d2() {
    let desk = Desk::new();
    let later = ["time.end=4.5", "record.start=3.5"];
    let answer = desk.quick("cylinder-2d2", &later, "run").good();
    let summary = answer.summary();
    let load = summary.loads["cylinder"];
    near(load.strouhal, 0.3, 0.05);
    near(load.drag_coefficient_max, 3.2277, 0.1);
    assert!(load.periods >= 3 && load.window[1] <= 4.5);
    let value: Value = serde_json::from_str(&answer.stdout).expect("JSON");
    let numbers = [
        "/fom/step_ms",
        "/fom/unknowns",
        "/fom/steps",
        "/fom/iterations_mean",
        "/fom/renewals",
        "/record/max_norm",
        "/pressure_difference",
        "/loads/cylinder/drag_coefficient_mean",
        "/loads/cylinder/lift_coefficient_max",
        "/loads/cylinder/lift_coefficient_rms",
        "/loads/cylinder/cross_check",
        "/pod/eigenvalues/9",
        "/projection/res_percent/0",
    ];
    for at in numbers {
        assert!(value.pointer(at).is_some_and(Value::is_number), "{at}");
    }
    for at in ["/loads/left/strouhal", "/loads/right/strouhal", "/loads/top", "/loads/bottom"] {
        assert!(value.pointer(at).is_some(), "{at}");
    }
    assert_eq!((summary.record.snapshots, summary.record.unknowns), (51, 2 * 111 * 22));
    leaves_its_files(&desk);
    is_of_use_to_other_commands(&desk);
}

fn leaves_its_files(desk: &Desk) {
    for file in [
        "case.toml",
        "manifest.json",
        "summary.json",
        "report.html",
        "mesh.npz",
        "end.npz",
        "steps.csv",
        "record/zarr.json",
        "pictures/zarr.json",
        "basis/fixed.npz",
        "paraview/flow.pvd",
        "paraview/flow-000045.vtu",
    ] {
        assert!(desk.path("run").join(file).is_file(), "no {file}");
    }
    assert!(!desk.path("run/paraview/flow-000046.vtu").exists(), "0 to 4.5 s by 0.1 s");
    assert!(!desk.path("run/checkpoint").exists());
    let series = fs::read_to_string(desk.path("run/paraview/flow.pvd")).expect("a series");
    assert_eq!(series.matches("<DataSet").count(), 46);
    let first = fs::read(desk.path("run/paraview/flow-000000.vtu")).expect("a file");
    let head = String::from_utf8_lossy(&first[..first.len().min(4000)]).into_owned();
    for field in ["velocity", "pressure", "vorticity", "mesh_velocity"] {
        assert!(head.contains(&format!("Name=\"{field}\"")), "no {field} in {head}");
    }
    let loads = desk.table("run/loads.csv");
    assert_eq!((loads[0].0.as_str(), loads[0].1.len()), ("time", 450));
    assert!(loads.iter().any(|(header, _)| header == "cylinder.cd"));
    assert_eq!(loads[0].1.last(), Some(&4.5), "without the round-off of summed steps");
    let record = lumley::record::Record::open(desk.path("run/record")).expect("a record");
    assert_eq!(record.times()[0], 3.5);
    assert!(record.series("loads-cylinder").is_ok() && record.series("cfl").is_ok());
}

fn is_of_use_to_other_commands(desk: &Desk) {
    let info = desk.lumley(&["info", "run"]).good().stdout;
    for word in ["complete", "51 snapshots", "picture", "Cd max", "vorticity in 1/s"] {
        assert!(info.contains(word), "no {word} in {info}");
    }
    fs::remove_file(desk.path("run/report.html")).expect("removed");
    desk.lumley(&["report", "run"]).good();
    assert!(desk.path("run/report.html").is_file());
    desk.lumley(&["pod", "run/record", "--modes", "3", "-o", "pod"]).good();
    assert!(desk.path("pod/pod.npz").is_file());
    desk.lumley(&["rom", "run", "-o", "rom"]).refused(2, &["flow", "piston"]);
    // The run directory reproduces itself.
    desk.lumley(&["check", "run/case.toml"]).good();
}

/// A moving body: its places are recorded, and the drag is what a stream of that speed gives.
#[test]
fn oscillating_cylinder() {
    let desk = Desk::new();
    let summary = desk.quick("oscillating-cylinder", &[], "run").good().summary();
    near(summary.loads["cylinder"].drag_coefficient_mean, 1.25, 0.15);
    let record = lumley::record::Record::open(desk.path("run/record")).expect("a record");
    let position = record.series("position-cylinder").expect("the body moves");
    let angle = std::f64::consts::TAU * 0.156 * record.times()[7];
    assert!((position.at(7)[1] - 0.2 * angle.sin()).abs() < 1e-12);
}

/// Steps that follow the error still end where the case wants snapshots.
#[test]
fn adaptive_steps() {
    let desk = Desk::new();
    let settings = [
        "time.adaptive={ tolerance = 2e-2, shortest = 1e-4, longest = 0.05 }",
        "time.end=0.5",
        "record.start=0.1",
        "record.interval=0.1",
    ];
    let summary = desk.quick("cylinder-2d2", &settings, "run").good().summary();
    assert_eq!(summary.record.snapshots, 5);
    let steps = desk.table("run/steps.csv");
    let column = |name: &str| &steps.iter().find(|(header, _)| header == name).expect(name).1;
    assert!((column("time").last().expect("a step") - 0.5).abs() < 1e-9);
    let sizes = column("step");
    let (least, most) = sizes.iter().fold((1.0_f64, 0.0_f64), |(a, b), &dt| (a.min(dt), b.max(dt)));
    assert!(least < 0.5 * most && most <= 0.05, "{least} to {most} s");
}

/// The end of a run is the start of another, on another mesh.
#[test]
fn a_run_starts_from_the_end_of_another() {
    let desk = Desk::new();
    let short = ["time.end=0.5", "record.start=0.5", "record.interval=0.5", "pod.center=false"];
    desk.quick("cylinder-2d2", &short, "coarse").good();
    let finer = ["flow.initial={ run = \"../coarse\" }", "mesh.size=0.05", "output.paraview=0.5"];
    desk.quick("cylinder-2d2", &[&short[..], &finer].concat(), "fine").good();
    let table = desk.table("fine/loads.csv");
    let drag = &table.iter().find(|(header, _)| header == "cylinder.cd").expect("a drag").1;
    let developed = drag[10..].iter().all(|cd| (2.8..3.6).contains(cd));
    assert!(developed, "no start-up peak after a developed flow: {:?}", &drag[..20]);

    let other = ["flow.initial={ run = \"../coarse\" }", "mesh.x=[0, 2.5]"];
    desk.quick("cylinder-2d2", &other, "long")
        .refused(2, &["coarse has no flow at", "same domain"]);
    assert!(!desk.path("long").exists() && !desk.path("long.partial").exists());
}

/// What can be seen before anything is computed is said then.
#[test]
fn points_must_be_in_the_fluid() {
    let desk = Desk::new();
    let inside = ["flow.pressure_difference.points=[[0.2, 0.2], [0.25, 0.2]]"];
    desk.quick("cylinder-2d2", &inside, "run")
        .refused(2, &["flow.pressure_difference [0.2, 0.2]", "in the fluid"]);
    assert!(!desk.path("run.partial").exists());
}

/// A mesh that tangles stops the run; what was computed is kept, and the message says where.
#[test]
fn a_tangled_mesh_keeps_what_was_computed() {
    let desk = Desk::new();
    let far = ["bodies.cylinder.joint.y=\"2*t\"", "record.start=1.0"];
    let answer = desk.quick("oscillating-cylinder", &far, "run");
    answer.refused(1, &["t = ", "kept: everything up to here, in run.partial", "--resume"]);
    assert!(!desk.path("run").exists());
    let loads = desk.table("run.partial/loads.csv");
    assert!(loads[0].1.len() > 10, "{} rows", loads[0].1.len());
    let record = lumley::record::Record::open(desk.path("run.partial/record")).expect("a record");
    assert!(!record.is_empty());
    assert!(desk.path("run.partial/paraview/flow.pvd").is_file());
}

/// A step far too long for the motion stops the run, by its linear system or by its growth: no number of any size
/// comes out.
#[test]
fn a_flow_that_is_unstable_is_no_result() {
    let desk = Desk::new();
    let fast = ["bodies.cylinder.joint.y=\"0.2*sin(20*t)\"", "record.start=1.0"];
    let answer = desk.quick("oscillating-cylinder", &fast, "run");
    answer.refused(1, &["t = 1 s", "smaller step", "kept: everything up to here"]);
    assert_eq!(desk.table("run.partial/loads.csv")[0].1.len(), 9);
}

/// What the help says can be given to a shell as it stands.
#[cfg(unix)]
#[test]
fn the_command_that_goes_on_is_quoted() {
    let desk = Desk::new();
    let settings = ["bodies.cylinder.joint.y=\"2*t\"", "record.start=1.0"];
    let answer = desk.quick("oscillating-cylinder", &settings, "run");
    answer.refused(1, &["'bodies.cylinder.joint.y=\"2*t\"' --set record.start=1.0"]);
    answer.refused(1, &["the mesh tangled at t = 3.5 s in cell "]);
}

/// A steady flow that is not found says so, and keeps how it went.
#[test]
fn a_steady_flow_that_is_not_found() {
    let desk = Desk::new();
    let answer = desk.quick("cavity", &["steady.iterations=2"], "run");
    answer.refused(1, &["after 2 iterations", "kept:", "run.partial"]);
    assert_eq!(desk.table("run.partial/residuals.csv")[1].1.len(), 2);
}
