//! An older run stands until the new one is whole.

use crate::{BOTH, Desk, FORCE, LOCK, NEW, RESUME};
use std::fs;

/// `--resume` alone may not replace, `--force` alone would throw the work away: both are said.
#[test]
fn an_interrupted_replacement_says_how_to_go_on() {
    let desk = Desk::new();
    desk.run("run", "old", NEW);
    desk.manifest("run.partial", false);
    desk.write("run.partial/checkpoint", b"hours");
    for existing in [NEW, RESUME] {
        let answer = desk.refused("run", existing);
        assert!(answer.contains("run.partial"), "{answer}");
        assert!(answer.contains("--resume --force"), "{answer}");
        assert!(answer.contains("--force alone"), "{answer}");
    }
    let place = desk.claim("run", BOTH);
    assert_eq!(desk.read("run.partial/checkpoint"), "hours");
    place.finish().expect("finished");
    assert_eq!(desk.read("run/checkpoint"), "hours");
    assert!(!desk.path("run/summary.json").exists());
    assert_eq!(desk.names(""), ["run"]);
}

#[test]
fn force_alone_begins_again() {
    let desk = Desk::new();
    desk.run("run", "old", NEW);
    desk.manifest("run.partial", false);
    desk.write("run.partial/checkpoint", b"hours");
    desk.run("run", "new", FORCE);
    assert_eq!(desk.names("run"), ["manifest.json", "summary.json"]);
    assert_eq!(desk.read("run/summary.json"), "new");
}

/// Here the partial directory is gone, so that it cannot take its name.
#[test]
fn the_old_run_comes_back_when_the_new_one_cannot_take_its_place() {
    let desk = Desk::new();
    desk.run("run", "old", NEW);
    let place = desk.claim("run", FORCE);
    fs::remove_dir_all(desk.path("run.partial")).expect("removed");
    let answer = place.finish().expect_err("nothing to rename").to_string();
    assert!(answer.contains("run.partial"), "{answer}");
    assert_eq!(desk.read("run/summary.json"), "old");
    assert_eq!(desk.names(""), ["run"]);
}

/// Somebody made the directory while the run went on.
#[test]
fn a_run_that_cannot_finish_stays_as_it_was() {
    let desk = Desk::new();
    let place = desk.claim("run", NEW);
    desk.manifest("run.partial", true);
    desk.write("run/chapter.tex", b"years of work");
    let answer = place.finish().expect_err("the name is taken").to_string();
    assert!(answer.contains("run exists and is not a run of lumley"), "{answer}");
    assert_eq!(desk.names("run.partial"), [LOCK, "manifest.json"]);
    assert_eq!(desk.names("run"), ["chapter.tex"]);
}

/// The same, but by another run: the way out keeps the work.
#[test]
fn a_run_that_finds_another_at_its_end_says_how_to_go_on() {
    let desk = Desk::new();
    let place = desk.claim("run", NEW);
    desk.manifest("run.partial", true);
    desk.manifest("run", true);
    let answer = place.finish().expect_err("the name is taken").to_string();
    assert!(answer.contains("--resume --force"), "{answer}");
}

#[test]
fn an_empty_directory_is_taken_and_no_lock_is_left() {
    let desk = Desk::new();
    fs::create_dir(desk.path("run")).expect("a folder");
    desk.run("run", "new", NEW);
    assert_eq!(desk.names("run"), ["manifest.json", "summary.json"]);
    assert_eq!(desk.names(""), ["run"]);
}

#[test]
fn two_processes_do_not_share_a_directory() {
    let desk = Desk::new();
    let _place = desk.claim("run", NEW);
    for existing in [FORCE, RESUME] {
        assert!(desk.refused("run", existing).contains("another process"));
    }
}
