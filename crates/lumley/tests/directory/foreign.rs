//! Files that lumley did not make.

use crate::{BOTH, Desk, FORCE, LOCK, NEW, RESUME};
use lumley::directory::Workplace;

/// What stood beside a run has nothing to do with replacing it, whatever its name.
#[test]
fn a_neighbour_called_old_survives_a_replacement() {
    let desk = Desk::new();
    desk.write("run.old/chapter.tex", b"years of work");
    desk.run("run", "first", NEW);
    desk.run("run", "second", FORCE);
    assert_eq!(desk.read("run/summary.json"), "second");
    assert_eq!(desk.read("run.old/chapter.tex"), "years of work");
    assert_eq!(desk.names(""), ["run", "run.old"]);
}

/// Many programs have a `manifest.json`.
#[test]
fn only_a_manifest_of_lumley_makes_a_run() {
    for manifest in ["{\"name\": \"app\"}", "{\"program\": \"npm\"}", "[]", "no JSON", "", "7"] {
        let desk = Desk::new();
        desk.write("app/manifest.json", manifest.as_bytes());
        desk.write("app/index.html", b"<html>");
        for existing in [NEW, FORCE] {
            let answer = desk.refused("app", existing);
            assert!(answer.contains("is not a run of lumley"), "{manifest}: {answer}");
        }
        assert_eq!(desk.names("app"), ["index.html", "manifest.json"]);
        assert_eq!(desk.names(""), ["app"]);
    }
}

/// The manifest of another version of lumley may have other fields: still a run, and replaced.
#[test]
fn a_manifest_of_another_version_is_ours() {
    let desk = Desk::new();
    desk.write("run/manifest.json", b"{\"program\": \"lumley\", \"version\": \"9\"}");
    desk.run("run", "new", FORCE);
    assert_eq!(desk.names("run"), ["manifest.json", "summary.json"]);
}

/// A lock alone does not make the files beside it ours.
#[test]
fn a_partial_directory_of_somebody_else_is_kept() {
    for manifest in [None, Some("{\"name\": \"app\"}")] {
        let desk = Desk::new();
        desk.write(&format!("run.partial/{LOCK}"), b"");
        desk.write("run.partial/chapter.tex", b"years of work");
        if let Some(manifest) = manifest {
            desk.write("run.partial/manifest.json", manifest.as_bytes());
        }
        for existing in [NEW, FORCE, RESUME, BOTH] {
            let answer = desk.refused("run", existing);
            assert!(answer.contains("run.partial exists and is not a run of lumley"), "{answer}");
        }
        assert_eq!(desk.read("run.partial/chapter.tex"), "years of work");
    }
}

/// A run that was killed before it wrote its manifest.
#[test]
fn a_partial_directory_with_nothing_but_its_lock_is_ours() {
    let desk = Desk::new();
    desk.write(&format!("run.partial/{LOCK}"), b"");
    desk.write("run.partial/.case.toml.71-0.tmp", b"");
    assert!(desk.refused("run", NEW).contains("unfinished run"));
    desk.run("run", "new", FORCE);
    assert_eq!(desk.names("run"), ["manifest.json", "summary.json"]);
}

/// Notes that somebody put into a run are not removed with it.
#[test]
fn notes_inside_of_a_run_are_kept() {
    let desk = Desk::new();
    desk.manifest("run", true);
    desk.write("run/notes.txt", b"years of work");
    let error = Workplace::claim(&desk.path("run"), FORCE).expect_err("there are notes");
    assert!(error.to_string().contains("notes.txt"), "{error}");
    assert!(desk.path("run/notes.txt").exists() && !desk.path("run.partial").exists());
}
