//! What a killed writer leaves does no harm and goes away.

use crate::{Desk, FORCE, NEW, RESUME};
use lumley::format::atomic;

/// In a container every process has the same number.
#[test]
fn a_temporary_file_of_the_same_process_number_does_not_stop_a_writer() {
    let desk = Desk::new();
    let process = std::process::id();
    for count in 0..1000 {
        desk.write(&format!(".checkpoint.{process}-{count}.tmp"), b"half");
    }
    atomic::write(&desk.path("checkpoint"), b"whole").expect("written");
    assert_eq!(desk.read("checkpoint"), "whole");
}

#[test]
fn a_resumed_run_is_swept() {
    let desk = Desk::new();
    desk.manifest("run.partial", false);
    for kept in ["checkpoint", ".notes.tmp", "record/.c.1-0.tmp"] {
        desk.write(&format!("run.partial/{kept}"), b"");
    }
    for half in [".checkpoint.71-4.tmp", "basis/.fixed.npz.71-5.tmp", "work/.1-modes.sum.71-6.tmp"]
    {
        desk.write(&format!("run.partial/{half}"), b"half");
    }
    let _place = desk.claim("run", RESUME);
    let left =
        [".lumley-lock", ".notes.tmp", "basis", "checkpoint", "manifest.json", "record", "work"];
    assert_eq!(desk.names("run.partial"), left);
    for swept in ["basis", "work"] {
        assert!(desk.names(&format!("run.partial/{swept}")).is_empty(), "{swept}");
    }
    assert_eq!(desk.names("run.partial/record"), [".c.1-0.tmp"], "the record sweeps its own");
}

/// Names of ours alone are taken for temporary.
#[test]
fn a_temporary_name_has_a_process_and_a_count() {
    for name in [".summary.json.71-0.tmp", "run/.0.4021-17.tmp"] {
        assert!(atomic::is_temporary(name.as_ref()), "{name}");
    }
    for name in ["summary.json", ".notes.tmp", ".notes.x-1.tmp", "a.71-0.tmp", ".71-0.tmp"] {
        assert!(!atomic::is_temporary(name.as_ref()), "{name}");
    }
}

/// An old run that was moved aside by a process that then died is not in the way of one with its number.
#[test]
fn a_name_to_move_aside_to_is_always_free() {
    let desk = Desk::new();
    desk.run("run", "old", NEW);
    let stale = format!(".run.replaced-{}", std::process::id());
    desk.write(&format!("{stale}/summary.json"), b"older");
    desk.run("run", "new", FORCE);
    assert_eq!(desk.read(&format!("{stale}/summary.json")), "older");
    assert_eq!(desk.names(""), [stale.as_str(), "run"]);
}
