//! Run directories: what is ours is replaced or taken up again, what is not is never touched.

mod foreign;
mod leftovers;
#[cfg(unix)]
mod links;
mod replace;
mod state;

use lumley::directory::{Existing, Workplace};
use lumley::manifest::{MANIFEST, Manifest};
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

const NEW: Existing = Existing { replace: false, resume: false };
const FORCE: Existing = Existing { replace: true, resume: false };
const RESUME: Existing = Existing { replace: false, resume: true };
const BOTH: Existing = Existing { replace: true, resume: true };

const LOCK: &str = ".lumley-lock";

/// A directory to make runs in.
struct Desk(TempDir);

impl Desk {
    fn new() -> Self {
        Self(tempfile::tempdir().expect("a temporary directory"))
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.path(name);
        fs::create_dir_all(path.parent().expect("inside of the desk")).expect("a folder");
        fs::write(&path, bytes).expect("a file");
        path
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).expect("a file")
    }

    /// Names in the folder `name`, hidden ones too.
    fn names(&self, name: &str) -> Vec<String> {
        let entries = fs::read_dir(self.path(name)).expect("a folder");
        let name = |entry: fs::DirEntry| entry.file_name().to_string_lossy().into_owned();
        let mut names: Vec<_> = entries.map(|entry| name(entry.expect("an entry"))).collect();
        names.sort();
        names
    }

    /// The manifest of a run in `name`.
    fn manifest(&self, name: &str, complete: bool) {
        let manifest = Manifest { complete, ..Manifest::new("piston", "") };
        self.write(&format!("{name}/{MANIFEST}"), manifest.to_json().as_bytes());
    }

    fn claim(&self, name: &str, existing: Existing) -> Workplace {
        Workplace::claim(&self.path(name), existing).expect("nothing is in the way")
    }

    /// A whole run in `name` with a file `word` in it.
    fn run(&self, name: &str, word: &str, existing: Existing) {
        let place = self.claim(name, existing);
        self.manifest(&format!("{name}.partial"), true);
        place.write("summary.json", word.as_bytes()).expect("written");
        place.finish().expect("finished");
    }

    /// What [`Workplace::claim`] answers to what it may not touch.
    fn refused(&self, name: &str, existing: Existing) -> String {
        refused(&self.path(name), existing)
    }
}

fn refused(target: &Path, existing: Existing) -> String {
    Workplace::claim(target, existing).expect_err("something is in the way").to_string()
}
