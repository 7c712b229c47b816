//! The command line as people use it: in a directory of its own, by its exit code, its words and its files.

mod bad_input;
mod body_cases;
mod flow;
mod flow_bodies;
mod flow_check;
mod flow_interrupted;
mod interrupted;
mod pod;
mod pod_faults;
mod pod_resume;
mod rom;
mod run;
mod update;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

/// A directory with the canonical case in it.
struct Desk(TempDir);

/// What a command left behind.
struct Answer {
    code: i32,
    stdout: String,
    stderr: String,
}

impl Desk {
    fn new() -> Self {
        let desk = Self(tempfile::tempdir().expect("a temporary directory"));
        let canonical = lumley::cases::find("piston").expect("it comes with lumley").text;
        desk.write("piston/case.toml", canonical.as_bytes());
        desk
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, bytes: &[u8]) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().expect("inside of the desk")).expect("a folder");
        fs::write(path, bytes).expect("a file");
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lumley"));
        command.args(arguments).current_dir(self.0.path());
        command
    }

    fn lumley(&self, arguments: &[&str]) -> Answer {
        Answer::of(&self.command(arguments).output().expect("lumley starts"))
    }

    /// A coarse run of the canonical case into `run`.
    fn quick_run(&self) -> Answer {
        self.lumley(&["run", "piston/case.toml", "--quick", "-o", "run"]).good()
    }

    /// Every file below `name`, with its content.
    fn files(&self, name: &str) -> Vec<(PathBuf, Vec<u8>)> {
        let mut found = Vec::new();
        collect(&self.path(name), &mut found);
        found.sort();
        found
    }
}

fn collect(folder: &Path, found: &mut Vec<(PathBuf, Vec<u8>)>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            collect(&path, found);
        } else {
            let content = fs::read(&path).expect("a file");
            found.push((path, content));
        }
    }
}

impl Answer {
    fn of(output: &Output) -> Self {
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let answer = Self {
            code: output.status.code().expect("it ends by itself"),
            stdout: text(&output.stdout),
            stderr: text(&output.stderr),
        };
        assert!(!answer.stderr.contains("panicked"), "a panic reached the user: {}", answer.stderr);
        answer
    }

    fn good(self) -> Self {
        assert_eq!(self.code, 0, "{}", self.stderr);
        self
    }

    /// Ended with this code, and said all of these things.
    fn refused(&self, code: i32, words: &[&str]) {
        assert_eq!(self.code, code, "{}{}", self.stdout, self.stderr);
        for word in words {
            assert!(self.stderr.contains(word), "no {word:?} in:\n{}", self.stderr);
        }
        assert!(self.stderr.len() < 1500, "an error should be short:\n{}", self.stderr);
    }
}
