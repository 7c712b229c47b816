//! Runs that are killed or run out of disk lose nothing and go on.

use crate::{Answer, Desk};
use std::fs;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Half a simulated second on many cells, with a checkpoint at every snapshot.
const FINE: [&str; 8] = [
    "run",
    "piston/case.toml",
    "--set",
    "mesh.cells=3000",
    "--set",
    "time.end=0.5",
    "--checkpoint",
    "0",
];

#[test]
fn a_killed_run_resumes_bit_for_bit() {
    let desk = Desk::new();
    let mut child = desk
        .command(&[&FINE[..], &["-o", "killed"]].concat())
        .stderr(Stdio::null())
        .spawn()
        .expect("lumley starts");
    let started = Instant::now();
    while !desk.path("killed.partial/checkpoint").exists() {
        assert!(started.elapsed() < Duration::from_secs(60), "no checkpoint in a minute");
        sleep(Duration::from_millis(2));
    }
    child.kill().expect("killed");
    child.wait().expect("gone");
    assert!(!desk.path("killed").exists(), "an unfinished run does not look finished");

    let again = [&FINE[..], &["-o", "killed"]].concat();
    desk.lumley(&again).refused(2, &["unfinished run", "--resume"]);
    desk.lumley(&[&again[..], &["--resume", "--set", "piston.mass=0.7"]].concat())
        .refused(2, &["another case"]);
    desk.lumley(&[&again[..], &["--resume"]].concat()).good();
    desk.lumley(&[&FINE[..], &["-o", "whole"]].concat()).good();
    let relative = |run: &str| -> Vec<_> {
        let root = desk.path(run);
        let strip = |(path, bytes): (std::path::PathBuf, Vec<u8>)| {
            (path.strip_prefix(&root).expect("below").to_owned(), bytes)
        };
        desk.files(&format!("{run}/record")).into_iter().map(strip).collect()
    };
    assert!(relative("killed") == relative("whole"), "the records differ");
}

/// A run that is killed behind the full-order model does not compute that again, and another table of the
/// initial flow is another case.
#[test]
fn later_stages_resume_from_the_record() {
    let desk = Desk::new();
    desk.write("piston/flow.csv", b"x,u\n0,0\n0.45,0.05\n0.9,0\n");
    let flow = "piston.initial_flow={ table = \"flow.csv\" }";
    let run = ["run", "piston/case.toml", "--quick", "-o", "late", "--set", flow];
    let mut child = desk.command(&run).stderr(Stdio::null()).spawn().expect("lumley starts");
    let started = Instant::now();
    while !desk.path("late.partial/basis/fixed.npz").exists() {
        assert!(started.elapsed() < Duration::from_secs(60), "no basis in a minute");
        sleep(Duration::from_millis(1));
    }
    child.kill().expect("killed");
    child.wait().expect("gone");
    desk.write("piston/flow.csv", b"x,u\n0,0\n0.45,0.06\n0.9,0\n");
    let resume = [&run[..], &["--resume"]].concat();
    desk.lumley(&resume).refused(2, &["another case"]);
    desk.write("piston/flow.csv", b"x,u\n0,0\n0.45,0.05\n0.9,0\n");
    let block = desk.path("late.partial/record/frames/fixed/values/c/0/0");
    let made = fs::metadata(&block).and_then(|about| about.modified()).expect("a block");
    desk.lumley(&resume).good();
    let block = desk.path("late/record/frames/fixed/values/c/0/0");
    let kept = fs::metadata(&block).and_then(|about| about.modified()).expect("a block");
    assert_eq!(made, kept, "the record was written again");
    assert!(!desk.path("late/checkpoint").exists());
}

#[test]
fn nothing_to_resume_is_said() {
    let desk = Desk::new();
    let resume = ["run", "piston/case.toml", "--resume", "-o", "run"];
    desk.lumley(&resume).refused(2, &["no unfinished run", "run.partial"]);
}

/// A limit on the size of files stands for a full disk: every write beyond it fails.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error_and_the_run_resumes() {
    let desk = Desk::new();
    let lumley = env!("CARGO_BIN_EXE_lumley");
    let run = format!("exec '{lumley}' run piston/case.toml --quick -o run");
    let limited = format!("trap '' XFSZ; ulimit -f 64; {run}");
    let output = Command::new("sh").args(["-c", &limited]).current_dir(desk.0.path()).output();
    Answer::of(&output.expect("sh starts")).refused(2, &["run.partial/record", "cannot write"]);
    assert!(!desk.path("run").exists());
    desk.lumley(&["run", "piston/case.toml", "--quick", "-o", "run", "--resume"]).good();
    assert!(desk.path("run/report.html").is_file());
}

/// An older run stands until the new one is complete.
#[cfg(target_os = "linux")]
#[test]
fn a_failed_replacement_leaves_the_old_run() {
    let desk = Desk::new();
    desk.quick_run();
    let before = fs::read(desk.path("run/summary.json")).expect("a summary");
    let lumley = env!("CARGO_BIN_EXE_lumley");
    let run = format!("exec '{lumley}' run piston/case.toml --quick -o run --force");
    let limited = format!("trap '' XFSZ; ulimit -f 64; {run}");
    let output = Command::new("sh").args(["-c", &limited]).current_dir(desk.0.path()).output();
    Answer::of(&output.expect("sh starts")).refused(2, &["cannot write"]);
    assert_eq!(fs::read(desk.path("run/summary.json")).expect("still there"), before);
}
