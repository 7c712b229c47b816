//! `rom`: the reduced models of a run with other parameters and for a longer time.

use crate::Desk;
use lumley::summary::{Reduced, Summary};

fn summary(desk: &Desk, arguments: &[&str]) -> Summary {
    let answer = desk.lumley(&[&["rom", "run", "--json"], arguments].concat()).good();
    serde_json::from_str(&answer.stdout).expect("a summary")
}

fn res(summary: &Summary, label: &str) -> Option<f64> {
    summary.rom.iter().find(|model| model.label == label).and_then(Reduced::shown_res)
}

#[test]
fn unchanged_models_reproduce_the_run() {
    let desk = Desk::new();
    desk.quick_run();
    let text = std::fs::read_to_string(desk.path("run/summary.json")).expect("a summary");
    let run: Summary = serde_json::from_str(&text).expect("a summary");
    let again = summary(&desk, &["-o", "again"]);
    for model in &run.rom {
        assert_eq!(res(&again, &model.label), model.shown_res(), "{}", model.label);
    }
    assert!(desk.path("again/report.html").is_file());
}

/// Past the window of the snapshots, and with stiffness, damping and mass changed by a fifth, the models
/// with an interface condition stay at the error level of the run.
#[test]
fn long_runs_and_changed_parameters_stay_accurate() {
    let desk = Desk::new();
    desk.quick_run();
    let changes: [&[&str]; 4] = [
        &["time.end=10"],
        &["piston.stiffness=47.4"],
        &["piston.damping=0.12"],
        &["piston.mass=0.6", "piston.initial_position=0.91", "piston.viscosity=0.21"],
    ];
    for change in changes {
        let mut arguments = vec!["--compare"];
        arguments.extend(change.iter().flat_map(|setting| ["--set", setting]));
        let summary = summary(&desk, &arguments);
        for (label, bound) in [("multiplier", 4.0), ("penalty", 3.0), ("mapped", 0.3)] {
            let res = res(&summary, label).expect("it reached the end");
            assert!(res < bound, "{change:?}: {label} has Res {res} %");
        }
    }
}

/// Beyond the record there is nothing to compare with, and the summary says how far it went.
#[test]
fn a_longer_run_is_compared_as_far_as_the_record_goes() {
    let desk = Desk::new();
    desk.quick_run();
    let longer = summary(&desk, &["--set", "time.end=4", "-o", "longer"]);
    assert!(longer.warnings.iter().any(|w| w.contains("first 2 s")), "{:?}", longer.warnings);
    assert_eq!(longer.record.snapshots, 201);
    let shorter = summary(&desk, &["--set", "time.end=1", "-o", "shorter"]);
    assert_eq!(shorter.record.snapshots, 101);
}

/// Without the full-order model beside them, changed models run and are compared with nothing.
#[test]
fn changed_models_are_not_compared_with_another_flow() {
    let desk = Desk::new();
    desk.quick_run();
    let summary =
        summary(&desk, &["--set", "piston.stiffness=45", "--set", "time.end=3", "-o", "new"]);
    assert_eq!(res(&summary, "mapped"), None);
    let model = summary.rom.iter().find(|model| model.label == "mapped").expect("it ran");
    assert!(model.shown_failure().is_none() && model.shown_step_us().is_some());
}

#[test]
fn another_basis_is_refused() {
    let desk = Desk::new();
    desk.quick_run();
    let settings = [
        ("grid.nodes=101", "grid"),
        ("mesh.cells=50", "mesh"),
        ("piston.domain_length=1.2", "domain_length"),
        ("pod.center=true", "pod"),
        ("transfer.method=inverse-distance", "transfer"),
    ];
    for (setting, word) in settings {
        let arguments = ["rom", "run", "--set", setting, "-o", "other"];
        desk.lumley(&arguments).refused(2, &["lumley run", word]);
    }
    desk.lumley(&["rom", "run", "-o", "./run/", "--force"]).refused(2, &["its own reduced models"]);
    assert!(desk.path("run/record/zarr.json").is_file());
    desk.lumley(&["rom", "piston", "-o", "other"]).refused(2, &["no run of lumley here"]);
    assert!(!desk.path("other").exists() && !desk.path("other.partial").exists());
}
