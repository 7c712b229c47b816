//! What `pod --resume` goes on with, and what it refuses and keeps.

use crate::Desk;
use crate::pod::{desk_with_waves, waves};
use crate::pod_faults::{POD, desk, kill_at, modes, names, pod, whole, write_waves};
use faer::Mat;
use lumley::format::npy::{write_matrix, write_vector};
use lumley::manifest::Manifest;
use std::fs::{self, File};
use std::process::Stdio;
use std::time::{Duration, SystemTime};

const OTHER: &str = "was begun with other snapshots, weights or options";

/// Memory and threads change no bit. A refusal costs nothing of what the passes before it found.
#[test]
fn memory_and_threads_may_differ_and_too_little_memory_loses_nothing() {
    let desk = desk(100, 40_000);
    let more = ["--modes", "6"];
    let expected = whole(&desk, &more);
    kill_at(&desk, &more, "work/1-sketch.sum");
    let resume = |memory| pod(&desk, &["--modes", "6", "--resume", "--memory", memory]);
    resume("1kB").refused(2, &["the limit is 1000", "raise the limit"]);
    assert!(desk.path("out.partial/work/1-sketch.sum").is_file());
    resume("20MB").good();
    assert!(modes(&desk) == expected, "other memory: other bytes");
    fs::remove_dir_all(desk.path("out")).expect("removed");

    kill_at(&desk, &more, "work/1-sketch-0-of-1.sum");
    let mut threads = [&POD[..], &more, &["--resume"]].concat();
    let one = threads.iter().position(|word| *word == "--threads").expect("there are some") + 1;
    threads[one] = "2";
    desk.lumley(&threads).good();
    assert!(modes(&desk) == expected, "other threads: other bytes");
}

/// What differs is said, as it was and as it is.
#[test]
fn an_unfinished_decomposition_goes_on_with_what_it_was_begun_with_alone() {
    let desk = desk(100, 40_000);
    let begun = ["--modes", "6"];
    kill_at(&desk, &begun, "work/1-sketch.sum");
    pod(&desk, &begun).refused(2, &["out.partial", "--resume", "--force"]);
    write_vector(desk.path("t.npy"), &(0..100).map(f64::from).collect::<Vec<_>>()).expect("a file");
    let table: [(&[&str], [&str; 2]); 3] = [
        (&["--modes", "5"], ["then Modes(6)", "now Modes(5)"]),
        (&["--modes", "6", "--center"], ["then --center false", "now --center true"]),
        (&["--modes", "6", "--times", "t.npy"], ["then no --times", "now --times t.npy"]),
    ];
    for (more, words) in table {
        let words = [&["out.partial", OTHER, "--force"], &words[..]].concat();
        pod(&desk, &[more, &["--resume"]].concat()).refused(2, &words);
    }
    let entry = desk.path("out.partial/work/1-sketch.sum");
    let mut bytes = fs::read(&entry).expect("an entry");
    bytes[100] ^= 1;
    fs::write(&entry, &bytes).expect("written");
    let resume = ["--modes", "6", "--resume"];
    pod(&desk, &resume).refused(2, &["1-sketch.sum", "damaged", "--force"]);

    touch(&desk, "w.npy");
    pod(&desk, &resume).refused(2, &[OTHER, "then --weights w.npy"]);
    write_waves(&desk, 100, 40_000, 2.0);
    pod(&desk, &resume).refused(2, &[OTHER, "then snapshots x.npy"]);
    pod(&desk, &["--modes", "6", "--force"]).good();
}

/// Other processors round otherwise: a pass is not ended on one.
#[test]
fn another_processor_does_not_go_on() {
    let desk = desk(40, 20_000);
    let more = ["--modes", "2"];
    kill_at(&desk, &more, "work/1-sketch.sum");
    let path = desk.path("out.partial/manifest.json");
    let written = fs::read_to_string(&path).expect("a manifest");
    let other = written.replacen("\"processor ", "\"processor Analytical Engine ", 1);
    assert_ne!(other, written);
    fs::write(&path, other).expect("a manifest");
    pod(&desk, &[&more[..], &["--resume"]].concat())
        .refused(2, &[OTHER, "then processor Analytical Engine"]);
}

/// Where the checksum of a long file does not look.
#[test]
fn a_change_in_the_middle_of_a_long_file_is_noticed() {
    let desk = desk(100, 90_000);
    let more = ["--modes", "2"];
    kill_at(&desk, &more, "work/1-sketch-0-of-1.sum");
    let before = manifest(&desk, "out.partial");
    let mut bytes = fs::read(desk.path("x.npy")).expect("snapshots");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    desk.write("x.npy", &bytes);
    pod(&desk, &[&more[..], &["--resume"]].concat()).refused(2, &[OTHER, "x.npy"]);
    assert!(before.inputs[0].crc32c.contains("first and last MiB"), "{:?}", before.inputs[0]);
}

/// A record is named, with its checksum, and another one is not taken for it.
#[test]
fn a_record_is_an_input() {
    let desk = Desk::new();
    desk.quick_run();
    let record = |run: &str, more: &[&str]| {
        desk.lumley(&[&["pod", run, "--modes", "3", "-o", "out"], more].concat())
    };
    record("run", &[]).good();
    let inputs = manifest(&desk, "out").inputs;
    assert_eq!(
        inputs.iter().map(|input| &input.name).collect::<Vec<_>>(),
        ["run/record/zarr.json"]
    );
    fs::rename(desk.path("out"), desk.path("out.partial")).expect("as if it were unfinished");
    desk.lumley(&["run", "piston/case.toml", "--quick", "-o", "twin"]).good();
    record("twin", &["--resume"])
        .refused(2, &[OTHER, "then snapshots run/", "now snapshots twin/"]);
    touch(&desk, "run/record/zarr.json");
    record("run", &["--resume"]).refused(2, &[OTHER, "run/record/zarr.json"]);
}

/// What is read is not replaced by what is made of it.
#[test]
fn a_decomposition_does_not_replace_its_own_snapshots() {
    let desk = Desk::new();
    desk.quick_run();
    let before = desk.files("run");
    for source in ["run", "run/record", "run/../run"] {
        desk.lumley(&["pod", source, "-o", "run", "--force"]).refused(2, &["run", "outside"]);
    }
    assert!(desk.files("run") == before, "the run has changed");
    fs::rename(desk.path("run"), desk.path("a.partial")).expect("as if it were unfinished");
    desk.lumley(&["pod", "a.partial", "-o", "a", "--force"]).refused(2, &["a.partial", "outside"]);
    assert!(desk.path("a.partial/record/zarr.json").is_file());
    desk.write("a.partial/w.npy", b"");
    let weights = ["pod", "a.partial", "--weights", "a.partial/w.npy"];
    desk.lumley(&[&weights[..], &["-o", "a", "--force"]].concat()).refused(2, &["outside"]);
}

/// Something stands at the run's name when the work is done: it is done once for all.
#[test]
fn a_run_that_lacks_its_name_alone_is_not_computed_again() {
    let desk = desk(100, 80_000);
    let arguments = [&POD[..], &["--modes", "6"]].concat();
    let mut command = desk.command(&arguments);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("starts");
    while !desk.path("out.partial/work").exists() {
        assert!(child.try_wait().expect("its state").is_none(), "it ended before it began");
        std::thread::sleep(Duration::from_micros(200));
    }
    desk.write("out/notes.txt", b"mine");
    assert_eq!(child.wait().expect("its end").code(), Some(2));
    let made = fs::read(desk.path("out.partial/pod.npz")).expect("modes");
    let at = changed(&desk, "out.partial/pod.npz");
    pod(&desk, &["--modes", "6", "--resume"]).refused(2, &["out", "not a run of lumley"]);
    fs::remove_dir_all(desk.path("out")).expect("removed");
    pod(&desk, &["--modes", "5", "--resume"]).refused(2, &[OTHER]);
    let answer = pod(&desk, &["--modes", "6", "--resume"]).good();
    assert!(answer.stdout.contains("6 modes"), "{}", answer.stdout);
    assert!(modes(&desk) == made && changed(&desk, "out/pod.npz") == at, "it was made again");
    assert!(!names(&desk.path("out")).contains(&"work".into()));
}

/// The pass that looks for what to leave out is one of those that are counted.
#[test]
fn the_pass_that_skips_is_counted() {
    let desk = desk_with_waves();
    let mut x: Mat<f64> = waves();
    x[(7, 11)] = f64::NAN;
    write_matrix(desk.path("nan.npy"), x.as_ref()).expect("a file");
    let passes = |arguments: &[&str]| {
        let answer = desk.lumley(&[&["pod", "--modes", "2"], arguments].concat()).good();
        let (_, rest) = answer.stderr.split_once(" in ").expect("passes are counted");
        rest.split(' ').next().and_then(|n| n.parse::<usize>().ok()).expect("a number")
    };
    let all = passes(&["x.npy", "-o", "all"]);
    assert_eq!(passes(&["nan.npy", "--skip-non-finite", "-o", "some"]), all + 1);
}

fn manifest(desk: &Desk, run: &str) -> Manifest {
    Manifest::read(&desk.path(run)).expect("a manifest")
}

/// Gives a file another time, and nothing else.
fn touch(desk: &Desk, name: &str) {
    let file = File::options().write(true).open(desk.path(name)).expect("a file");
    file.set_modified(SystemTime::UNIX_EPOCH + Duration::from_secs(1)).expect("its time");
}

fn changed(desk: &Desk, name: &str) -> SystemTime {
    fs::metadata(desk.path(name)).and_then(|file| file.modified()).expect("its time")
}
