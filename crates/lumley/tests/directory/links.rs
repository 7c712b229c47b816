//! Symbolic links are never followed to what they point at.

use crate::{BOTH, Desk, FORCE, LOCK, NEW, RESUME, refused};
use std::fs;
use std::os::unix::fs::symlink;

#[test]
fn a_link_is_no_place_for_a_run() {
    for pointed_at in ["kept", "empty", "nothing"] {
        for name in ["run", "run.partial"] {
            let desk = Desk::new();
            desk.run("kept", "old", NEW);
            fs::create_dir(desk.path("empty")).expect("a folder");
            symlink(pointed_at, desk.path(name)).expect("a link");
            for existing in [NEW, FORCE, RESUME, BOTH] {
                let nothing = name == "run" && existing.resume;
                let words = if nothing { "no unfinished run" } else { "is a symbolic link" };
                // A trailing slash would follow it.
                for target in [desk.path("run"), desk.path("run/")] {
                    let answer = refused(&target, existing);
                    assert!(answer.contains(words), "{name} -> {pointed_at}: {answer}");
                }
            }
            assert_eq!(desk.names("kept"), ["manifest.json", "summary.json"]);
            assert!(desk.names("empty").is_empty());
            assert!(desk.path(name).is_symlink() && !desk.path("nothing").exists());
        }
    }
}

/// Links inside of a run are removed, not what is behind them.
#[test]
fn a_cleared_directory_keeps_what_its_links_point_at() {
    let desk = Desk::new();
    desk.write("thesis/chapter.tex", b"years of work");
    desk.manifest("run.partial", false);
    symlink("../thesis", desk.path("run.partial/record")).expect("a link");
    symlink("../thesis/chapter.tex", desk.path("run.partial/checkpoint")).expect("a link");
    symlink("../thesis/chapter.tex", desk.path("run.partial").join(LOCK)).expect("a link");
    let place = desk.claim("run", FORCE);
    symlink("../thesis", desk.path("run.partial/basis")).expect("a link");
    let folder = place.fresh_folder("basis").expect("made");
    assert!(!folder.is_symlink());
    assert_eq!(desk.read("thesis/chapter.tex"), "years of work");
}
