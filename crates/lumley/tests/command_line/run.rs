//! `run` and what stands on its directory: `check`, `report`, `info`, `cases`.

use crate::Desk;
use serde_json::Value;
use std::fs;

#[test]
fn a_run_leaves_a_complete_directory() {
    let desk = Desk::new();
    desk.quick_run();
    let files = ["case.toml", "manifest.json", "summary.json", "report.html", "record/zarr.json"];
    for file in files.iter().chain(&["basis/fixed.npz", "rom/mapped/record/zarr.json"]) {
        assert!(desk.path("run").join(file).is_file(), "no {file}");
    }
    assert!(fs::read_dir(desk.path("run/figures")).expect("figures").count() >= 5);
    assert!(!desk.path("run.partial").exists());
    let manifest = fs::read_to_string(desk.path("run/manifest.json")).expect("a manifest");
    assert!(manifest.contains("\"complete\": true"));
}

/// The names that others rely on.
#[test]
fn the_summary_has_its_names_and_json_is_all_of_stdout() {
    let desk = Desk::new();
    let answer = desk.lumley(&["run", "piston/case.toml", "--quick", "--json"]).good();
    let summary: Value = serde_json::from_str(&answer.stdout).expect("one JSON object");
    let list =
        |at: &str| summary.pointer(at).and_then(Value::as_array).cloned().unwrap_or_default();
    for at in ["/pod/eigenvalues", "/pod/energy_percent", "/pod/cumulative_percent"] {
        assert!(list(at).len() >= 6, "{at}");
    }
    assert_eq!(list("/projection/res_percent").len(), 10);
    for model in list("/rom") {
        let length = |key: &str| model[key].as_array().map_or(0, Vec::len);
        assert_eq!((length("modes"), length("res_percent"), length("step_us")), (10, 10, 10));
        if model["projection"] == "printed" {
            assert!(model["res_percent"][9].is_null(), "the printed model blows up");
        }
    }
    for at in ["/fom/step_us", "/record/max_norm", "/probes/0/traction", "/probes/1/velocity_mid"] {
        assert!(summary.pointer(at).is_some_and(Value::is_number), "{at}");
    }
    for at in ["/probes/0/body/position", "/probes/0/body/velocity", "/probes/0/time"] {
        assert!(summary.pointer(at).is_some_and(Value::is_number), "{at}");
    }
    assert!(desk.path("runs/piston/report.html").is_file(), "the default directory");
}

/// What the coarse run is good for: the mapped model is at least ten times better than the penalty.
#[test]
fn the_body_frame_is_far_more_accurate() {
    let desk = Desk::new();
    let answer = desk.lumley(&["run", "piston/case.toml", "--quick", "--json"]).good();
    let summary: lumley::summary::Summary =
        serde_json::from_str(&answer.stdout).expect("a summary");
    let res = |label: &str| {
        let model = summary.rom.iter().find(|model| model.label == label);
        model.and_then(lumley::summary::Reduced::shown_res).expect("it reached the end")
    };
    assert!(res("mapped") < 0.1 * res("penalty"), "{} {}", res("mapped"), res("penalty"));
    assert!(summary.pod.cumulative_percent[5] > 99.99);
    assert!((summary.probes[0].piston().expect("a piston").body.position - 0.951_24).abs() < 1e-3);
}

#[test]
fn an_existing_directory_is_never_lost() {
    let desk = Desk::new();
    desk.quick_run();
    let again = ["run", "piston/case.toml", "--quick", "-o", "run"];
    desk.lumley(&again).refused(2, &["run exists already", "--force"]);
    desk.lumley(&[&again[..], &["--force"]].concat()).good();
    desk.write("thesis/chapter.tex", b"years of work");
    let over = ["run", "piston/case.toml", "--quick", "-o", "thesis", "--force"];
    desk.lumley(&over).refused(2, &["thesis exists and is not a run of lumley"]);
    assert_eq!(fs::read(desk.path("thesis/chapter.tex")).expect("still there"), b"years of work");
}

#[test]
fn default_directories_are_numbered() {
    let desk = Desk::new();
    for folder in ["runs/piston", "runs/piston-2", "runs/piston-3"] {
        desk.lumley(&["run", "piston/case.toml", "--quick"]).good();
        assert!(desk.path(folder).join("summary.json").is_file(), "{folder}");
    }
}

#[test]
fn check_runs_nothing() {
    let desk = Desk::new();
    let answer = desk.lumley(&["check", "piston/case.toml"]).good();
    for word in ["801 unknowns", "4000 steps", "201 snapshots", "memory", "disk", "time"] {
        assert!(answer.stdout.contains(word), "no {word} in {}", answer.stdout);
    }
    assert!(!desk.path("runs").exists());
    desk.lumley(&["check", "piston/case.toml", "--set", "piston.mass=-1"])
        .refused(2, &["piston.mass"]);
}

#[test]
fn report_is_written_again_from_disk_alone() {
    let desk = Desk::new();
    desk.quick_run();
    let page = fs::read(desk.path("run/report.html")).expect("a report");
    fs::remove_file(desk.path("run/report.html")).expect("removed");
    fs::remove_dir_all(desk.path("piston")).expect("removed");
    desk.lumley(&["report", "run"]).good();
    let again = fs::read(desk.path("run/report.html")).expect("a report");
    assert!(again.len().abs_diff(page.len()) < 200, "{} and {} bytes", page.len(), again.len());
    desk.lumley(&["report", "."]).refused(2, &["no run of lumley here"]);
}

#[test]
fn info_tells_what_is_there() {
    let desk = Desk::new();
    desk.quick_run();
    let run = desk.lumley(&["info", "run"]).good().stdout;
    assert!(run.contains("complete") && run.contains("201 snapshots"), "{run}");
    let record = desk.lumley(&["info", "run/record"]).good().stdout;
    assert!(record.contains("frame") && record.contains("all whole"), "{record}");
    let basis = desk.lumley(&["info", "run/basis/fixed.npz"]).good().stdout;
    assert!(basis.contains("modes") && basis.contains("[201, 10]"), "{basis}");
    desk.lumley(&["info", "nothing"]).refused(2, &["nothing"]);
}

#[test]
fn cases_are_listed_and_printed() {
    let desk = Desk::new();
    assert!(desk.lumley(&["cases"]).good().stdout.contains("piston"));
    let text = desk.lumley(&["cases", "piston"]).good().stdout;
    desk.write("mine.toml", text.as_bytes());
    desk.lumley(&["check", "mine.toml"]).good();
    desk.lumley(&["cases", "pistn"]).refused(2, &["pistn", "piston"]);
}

/// Case A, other schemes, degree 2, inverse distance, a centred POD, a stiff integrator, an initial flow.
#[test]
fn every_choice_of_the_case_file_runs() {
    let desk = Desk::new();
    desk.write("flow.csv", b"x,u\n0,0\n0.45,0.05\n0.9,0\n");
    fs::rename(desk.path("flow.csv"), desk.path("piston/flow.csv")).expect("moved");
    let choices: [&[&str]; 6] = [
        &["piston.force_factor=0", "time.scheme=implicit-euler"],
        &["mesh.degree=2", "mesh.cells=40", "time.scheme=crank-nicolson"],
        &["transfer.method=inverse-distance", "transfer.power=3", "transfer.neighbours=2"],
        &["pod.center=true", "pod.method=svd"],
        &["rom.integrator=rosenbrock", "rom.step=0.005", "pod.method=direct"],
        &["piston.initial_flow={ table = \"flow.csv\" }", "pod.method=snapshots"],
    ];
    for choice in choices {
        let mut arguments = vec!["run", "piston/case.toml", "--quick", "--json"];
        arguments.extend(choice.iter().flat_map(|setting| ["--set", setting]));
        let answer = desk.lumley(&arguments).good();
        let summary: lumley::summary::Summary = serde_json::from_str(&answer.stdout).expect("JSON");
        let mapped = summary.rom.last().and_then(lumley::summary::Reduced::shown_res);
        // Implicit Euler is itself far from the solution that the reduced model computes.
        let bound = if choice.contains(&"time.scheme=implicit-euler") { 20.0 } else { 1.0 };
        assert!(mapped.is_some_and(|res| res < bound), "{choice:?}: mapped Res {mapped:?} %");
    }
}
