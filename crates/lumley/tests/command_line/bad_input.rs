//! Wrong case files and damaged runs: a short error with the place, the value and what to do.

use crate::Desk;
use std::fs;

/// Every wrong value, and what the error must say.
#[test]
fn wrong_values_are_refused_with_their_place() {
    let desk = Desk::new();
    let table: [(&str, &str, &[&str]); 22] = [
        ("mass = 0.5 ", "mass = -0.5 ", &["piston.mass = -0.5", "positive", "kg"]),
        ("mass = 0.5 ", "mas = 0.5 ", &["`mas`", "did you mean `mass`?"]),
        ("mass = 0.5 ", "mass = \"heavy\" ", &["invalid type"]),
        ("mass = 0.5 ", "mass = nan ", &["piston.mass = NaN", "finite"]),
        ("mass = 0.5 ", "mass = inf ", &["piston.mass = inf", "finite"]),
        ("mass = 0.5 ", "mass = ", &["mass ="]),
        ("viscosity = 0.2 ", "viscosity = 0.0 ", &["piston.viscosity = 0"]),
        ("initial_position = 0.9 ", "initial_position = 1.2 ", &["inside the domain", "1.1 m"]),
        ("initial_position = 0.9 ", "initial_position = 0.0 ", &["initial_position = 0"]),
        ("initial_flow = \"zero\"", "initial_flow = \"swirl\"", &["swirl", "`zero`"]),
        ("initial_flow = \"zero\"", "initial_flow = { table = \"none.csv\" }", &["none.csv"]),
        ("initial_flow = \"zero\"", "initial_flow = { sine = inf }", &["initial_flow", "finite"]),
        ("end = 2.0", "end = 0.0", &["time.end = 0", "positive"]),
        ("end = 2.0", "end = 1e300", &["time.end"]),
        ("step = 5e-4 ", "step = 3e-4 ", &["time.step", "whole fraction", "such as"]),
        ("step = 5e-4 ", "step = -5e-4 ", &["time.step = -0.0005"]),
        ("scheme = \"bdf2\"", "scheme = \"bdf7\"", &["bdf7", "did you mean `bdf2`?"]),
        ("cells = 800", "cells = 1000000000000000", &["mesh.cells", "2 to 1000000"]),
        ("nodes = 401", "nodes = 999999999999999", &["grid.nodes", "at most"]),
        ("interval = 0.01 ", "interval = 0.3 ", &["record.interval", "such as"]),
        ("method = \"auto\"", "method = \"magic\"", &["pod.method = magic", "snapshots"]),
        ("sigma = 100.0 ", "sigma = -1.0 ", &["rom.models", "sigma", "positive"]),
    ];
    let canonical = fs::read_to_string(desk.path("piston/case.toml")).expect("the case");
    for (right, wrong, words) in table {
        assert!(canonical.contains(right), "no {right:?} in the case");
        desk.write("piston/wrong.toml", canonical.replacen(right, wrong, 1).as_bytes());
        let line =
            1 + canonical.split(right).next().map_or(0, |before| before.matches('\n').count());
        let place = format!("wrong.toml, line {line}:");
        desk.lumley(&["run", "piston/wrong.toml", "-o", "out"]).refused(2, words);
        desk.lumley(&["check", "piston/wrong.toml"]).refused(2, &[&place]);
        assert!(!desk.path("out").exists() && !desk.path("out.partial").exists(), "{wrong}");
    }
}

#[test]
fn settings_are_checked_like_the_file() {
    let desk = Desk::new();
    let table: [(&str, &[&str]); 6] = [
        ("piston.mass=-1", &["--set piston.mass=-1", "positive"]),
        ("piston.mas=1", &["--set piston.mas=1", "did you mean `mass`?"]),
        ("piston.mass=heavy", &["--set piston.mass", "invalid type"]),
        ("piston.mass", &["expected KEY=VALUE"]),
        ("=3", &["expected KEY=VALUE"]),
        ("title.of.work=3", &["title.of.work"]),
    ];
    for (setting, words) in table {
        desk.lumley(&["check", "piston/case.toml", "--set", setting]).refused(2, words);
    }
}

/// The overlay of `--quick` is checked even when nobody asks for it, and replaces values whole.
#[test]
fn the_quick_table_is_checked_too() {
    let desk = Desk::new();
    let canonical = fs::read_to_string(desk.path("piston/case.toml")).expect("the case");
    let slip = canonical.replace("mesh.cells = 100", "mesh.cels = 100");
    desk.write("slip.toml", slip.as_bytes());
    desk.lumley(&["check", "slip.toml"]).refused(2, &["[quick]", "did you mean `cells`?"]);
    desk.lumley(&["check", "piston/case.toml", "--set", "quick.mesh.cells=7"])
        .refused(2, &["expected KEY=VALUE"]);
    let other = canonical.replace("mesh.cells = 100", "piston.initial_flow = { sine = 0.1 }");
    let other = other.replace("initial_flow = \"zero\"", "initial_flow = { table = \"none.csv\" }");
    desk.write("other.toml", other.as_bytes());
    desk.lumley(&["check", "other.toml", "--quick"]).good();
}

/// What cannot be printed is an error, but for a reader that went away.
#[cfg(target_os = "linux")]
#[test]
fn a_result_that_cannot_be_printed_is_an_error() {
    let desk = Desk::new();
    let full = fs::OpenOptions::new().write(true).open("/dev/full").expect("a full device");
    let output = desk.command(&["cases"]).stdout(full).output().expect("lumley starts");
    crate::Answer::of(&output).refused(2, &["cannot print"]);
}

/// A device without an end is not read.
#[cfg(target_os = "linux")]
#[test]
fn a_case_file_is_a_file() {
    let desk = Desk::new();
    desk.lumley(&["run", "/dev/zero"]).refused(2, &["/dev/zero", "expected a case file"]);
}

#[test]
fn a_missing_case_or_place_is_named() {
    let desk = Desk::new();
    desk.lumley(&["run", "no/case.toml"]).refused(2, &["no/case.toml", "lumley cases"]);
    desk.lumley(&["run", "piston"]).refused(2, &["piston"]);
    desk.write("file", b"not a folder");
    let out = ["run", "piston/case.toml", "--quick", "-o", "file/run"];
    desk.lumley(&out).refused(2, &["cannot create", "file/run"]);
    assert_eq!(fs::read(desk.path("file")).expect("still there"), b"not a folder");
    desk.write("binary.toml", &[0xff, 0xfe, 0x00]);
    desk.lumley(&["run", "binary.toml"]).refused(2, &["binary.toml"]);
}

/// Nothing moves: the snapshots are all zero and there is nothing to decompose.
#[test]
fn a_flow_at_rest_has_no_modes() {
    let desk = Desk::new();
    let rest = ["run", "piston/case.toml", "--quick", "--set", "piston.initial_position=0.95"];
    desk.lumley(&[&rest[..], &["-o", "run"]].concat()).refused(2, &["hold no energy", "zero"]);
    assert!(!desk.path("run").exists());
}

/// A piston that leaves its domain is a failed computation, with the time.
#[test]
fn a_failed_computation_has_another_exit_code() {
    let desk = Desk::new();
    let thrown = ["run", "piston/case.toml", "--quick", "--set", "piston.initial_velocity=30"];
    desk.lumley(&[&thrown[..], &["-o", "run"]].concat()).refused(1, &["left the domain", "t = "]);
}

#[test]
fn a_damaged_record_is_named() {
    let desk = Desk::new();
    desk.quick_run();
    let block = desk.path("run/record/frames/fixed/values/c/0/0");
    let mut bytes = fs::read(&block).expect("a block");
    bytes[5000] ^= 4;
    fs::write(&block, bytes).expect("damaged");
    for command in ["info", "report", "pod"] {
        desk.lumley(&[command, "run"]).refused(2, &["frames/fixed/values/c/0/0"]);
    }
}

#[test]
fn a_damaged_run_directory_is_named() {
    let desk = Desk::new();
    desk.quick_run();
    desk.write("run/summary.json", b"{ \"case\": ");
    desk.lumley(&["report", "run"]).refused(2, &["summary.json"]);
    desk.lumley(&["rom", "run", "-o", "new"]).refused(2, &["summary.json"]);
    assert!(!desk.path("new").exists());
}
