//! Whether a directory is a run, and whether that run is whole.

use crate::{Desk, NEW, RESUME};
use lumley::directory::completed;
use lumley::manifest::{MANIFEST, Manifest};
use std::fs;

#[test]
fn a_complete_run_is_complete() {
    let desk = Desk::new();
    desk.run("run", "whole", NEW);
    assert_eq!(completed(&desk.path("run")).expect("complete"), desk.path("run"));
}

/// The manifest is there from the first moment of a run.
#[test]
fn an_unfinished_run_is_not_complete() {
    let desk = Desk::new();
    desk.manifest("run.partial", false);
    let answer = completed(&desk.path("run.partial")).expect_err("unfinished").to_string();
    assert!(answer.contains("is an unfinished run"), "{answer}");
    assert!(answer.contains("--resume"), "{answer}");
}

/// What nobody can go on with leaves nothing in the way of the next.
#[test]
fn an_abandoned_run_is_gone() {
    let desk = Desk::new();
    let place = desk.claim("run", NEW);
    place.write("work/1-correlation.sum", b"").expect("written");
    place.abandon().expect("removed");
    assert!(desk.names("").is_empty());
    desk.run("run", "next", NEW);
}

#[test]
fn what_is_no_run_is_not_complete() {
    let desk = Desk::new();
    desk.write("app/manifest.json", b"{\"name\": \"app\"}");
    desk.write("file", b"");
    for (name, words) in [
        ("nothing", "no run of lumley here"),
        ("file", "no run of lumley here"),
        ("", "no run of lumley here"),
        ("app", "not written by lumley"),
    ] {
        let answer = completed(&desk.path(name)).expect_err("no run").to_string();
        assert!(answer.contains(words), "{name}: {answer}");
    }
}

/// Each kind of damage is told apart, and names the file.
#[test]
fn a_manifest_is_read_or_says_why_not() {
    let desk = Desk::new();
    desk.manifest("run", true);
    assert!(Manifest::read(&desk.path("run")).expect("a manifest").complete);
    for (content, words) in [
        ("{\"program\": \"lumley\"", "is not JSON"),
        ("{\"program\": \"npm\"}", "not written by lumley"),
        ("{\"program\": \"lumley\"}", "missing field"),
    ] {
        let path = desk.write("run/manifest.json", content.as_bytes());
        let answer = Manifest::read(&desk.path("run")).expect_err(content).to_string();
        assert!(answer.contains(words), "{content}: {answer}");
        assert!(answer.contains(&path.display().to_string()), "{answer}");
    }
    fs::remove_file(desk.path("run/manifest.json")).expect("removed");
    fs::create_dir(desk.path("run/manifest.json")).expect("a folder");
    let answer = Manifest::read(&desk.path("run")).expect_err("a folder").to_string();
    assert!(answer.contains("missing") && answer.contains(MANIFEST), "{answer}");
}

#[test]
fn a_target_without_a_name_is_refused_at_once() {
    for path in [".", "..", "/"] {
        let answer = crate::refused(path.as_ref(), NEW);
        assert!(answer.contains("name of a directory"), "{path}: {answer}");
    }
    let desk = Desk::new();
    assert!(desk.refused("run", RESUME).contains("no unfinished run"));
}
