//! Flows that are killed, interrupted or run out of disk lose nothing and go on, to the last bit.

use crate::flow_bodies::PENDULUM;
use crate::{Answer, Desk};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// A cylinder that is moved over some checkpoints, one whose steps follow the error, and a pendulum that the flow moves.
const RUNS: [(&str, &[&str]); 3] = [
    ("oscillating-cylinder", &["time.end=30", "record.start=2.0", "output.paraview=2.0"]),
    (
        "cylinder-2d2",
        &[
            "time.end=2.0",
            "record.start=0.5",
            "time.step=0.005",
            "time.adaptive={ tolerance = 1e-2, shortest = 1e-4, longest = 5e-3 }",
        ],
    ),
    (PENDULUM, &["time.end=2.5", "time.step=0.005", "time.scheme=\"bdf2\"", "output.paraview=1.0"]),
];

/// Puts the case of a run on the desk.
fn take(desk: &Desk, name: &str) -> String {
    if name == PENDULUM { desk.take_pendulum() } else { desk.take(name) }
}

fn arguments<'a>(path: &'a str, settings: &[&'a str], run: &'a str) -> Vec<&'a str> {
    let mut arguments = vec!["run", path, "--quick", "--checkpoint", "0", "-o", run];
    arguments.extend(settings.iter().flat_map(|setting| ["--set", setting]));
    arguments
}

/// Starts a run and waits for a checkpoint of its own, and a little longer.
fn begun(desk: &Desk, arguments: &[&str], run: &str) -> Child {
    let path = desk.path(&format!("{run}.partial/checkpoint"));
    let written = || fs::metadata(&path).and_then(|file| file.modified()).ok();
    let (before, started) = (written(), Instant::now());
    let child = desk.command(arguments).stderr(Stdio::piped()).spawn().expect("lumley starts");
    while written().is_none() || written() == before {
        assert!(started.elapsed() < Duration::from_secs(120), "no checkpoint in two minutes");
        sleep(Duration::from_millis(2));
    }
    sleep(Duration::from_millis(50));
    child
}

/// Everything in a run directory that must not depend on how often it was stopped.
fn results(desk: &Desk, run: &str) -> Vec<(PathBuf, Vec<u8>)> {
    let root = desk.path(run);
    let is_result = |path: &Path| {
        !["manifest.json", "report.html", "summary.json"].iter().any(|name| path.ends_with(name))
            && !path.starts_with("figures")
    };
    let files = desk.files(run).into_iter();
    let files =
        files.map(|(path, bytes)| (path.strip_prefix(&root).expect("below").to_owned(), bytes));
    files.filter(|(path, _)| is_result(path)).collect()
}

/// The summary without times, memory, and where the run is.
fn summary(desk: &Desk, run: &str) -> Value {
    let text = fs::read_to_string(desk.path(run).join("summary.json")).expect("a summary");
    let mut value: Value = serde_json::from_str(&text).expect("JSON");
    value["directory"].take();
    for key in ["step_us", "step_ms", "memory_bytes"] {
        value["fom"][key].take();
    }
    for method in ["finite-element", "inverse-distance"] {
        value["transfer"][method]["ms"].take();
    }
    value
}

fn assert_same(desk: &Desk, one: &str, other: &str) {
    let (a, b) = (results(desk, one), results(desk, other));
    let names =
        |files: &[(PathBuf, Vec<u8>)]| files.iter().map(|(p, _)| p.clone()).collect::<Vec<_>>();
    assert_eq!(names(&a), names(&b));
    for ((path, a), (_, b)) in a.iter().zip(&b) {
        assert!(a == b, "{} differs", path.display());
    }
    assert_eq!(summary(desk, one), summary(desk, other));
}

/// Killed at any moment, interrupted politely, or not at all: the same bits.
#[cfg(unix)]
#[test]
fn stopped_runs_go_on_bit_for_bit() {
    for (name, settings) in RUNS {
        let desk = Desk::new();
        let path = take(&desk, name);
        desk.lumley(&arguments(&path, settings, "whole")).good();

        let run = arguments(&path, settings, "stopped");
        let mut child = begun(&desk, &run, "stopped");
        child.kill().expect("killed");
        child.wait().expect("gone");
        assert!(desk.path("stopped.partial").exists(), "{name} was over too soon");
        desk.lumley(&run).refused(2, &["unfinished run", "--resume"]);

        let resume = [&run[..], &["--resume"]].concat();
        let child = begun(&desk, &resume, "stopped");
        let interrupt = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
        assert!(interrupt.expect("kill starts").success());
        let answer = Answer::of(&child.wait_with_output().expect("it ends"));
        answer.refused(130, &["interrupted", "stopped.partial", "--resume` goes on from t ="]);

        desk.lumley(&resume).good();
        assert_same(&desk, "whole", "stopped");
    }
}

/// The same bits on one thread and on two.
#[test]
fn threads_do_not_change_the_bits() {
    for (name, settings) in [RUNS[0], RUNS[2]] {
        let desk = Desk::new();
        let path = take(&desk, name);
        for (run, threads) in [("one", "1"), ("two", "2")] {
            let all = [&arguments(&path, settings, run)[..], &["--threads", threads]].concat();
            desk.lumley(&all).good();
        }
        assert_same(&desk, "one", "two");
    }
}

/// A limit on the size of files stands for a full disk: every write beyond it fails.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error_and_the_flow_resumes() {
    let desk = Desk::new();
    let path = desk.take("cylinder-2d2");
    let lumley = env!("CARGO_BIN_EXE_lumley");
    let run = format!("exec '{lumley}' run {path} --quick -o run --set time.end=2.2");
    let limited = format!("trap '' XFSZ; ulimit -f 200; {run}");
    let output = Command::new("sh").args(["-c", &limited]).current_dir(desk.0.path()).output();
    Answer::of(&output.expect("sh starts")).refused(2, &["run.partial", "cannot write"]);
    assert!(!desk.path("run").exists());
    let again = ["run", &path, "--quick", "-o", "run", "--set", "time.end=2.2", "--resume"];
    desk.lumley(&again).good();
    assert!(desk.path("run/report.html").is_file());
}

/// A run that ended before its case was on the disk has nothing that another case could contradict.
#[test]
fn a_run_that_had_not_begun_begins() {
    let desk = Desk::new();
    desk.quick("cavity", &["steady.iterations=2"], "run").refused(1, &["after 2 iterations"]);
    fs::remove_file(desk.path("run.partial/case.toml")).expect("removed");
    desk.lumley(&["run", "cavity/case.toml", "--quick", "--resume", "-o", "run"]).good();
    assert!(desk.path("run/report.html").is_file());
}
