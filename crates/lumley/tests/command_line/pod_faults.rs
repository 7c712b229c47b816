//! Decompositions that are killed or run out of disk lose nothing and go on, with the same bytes.

use crate::{Answer, Desk};
use faer::Mat;
use lumley::format::npy::{write_matrix, write_vector};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// A note of how far it is after every group of rows.
pub(super) const POD: [&str; 12] = [
    "pod",
    "x.npy",
    "--weights",
    "w.npy",
    "--method",
    "svd",
    "--threads",
    "1",
    "--checkpoint",
    "0",
    "-o",
    "out",
];

/// Snapshots of eight standing waves of falling size on a line of `unknowns`, with weights.
pub(super) fn desk(snapshots: usize, unknowns: usize) -> Desk {
    let desk = Desk::new();
    write_waves(&desk, snapshots, unknowns, 1.0);
    let weights: Vec<f64> = (0..unknowns).map(|i| 1.0 + (i % 3) as f64).collect();
    write_vector(desk.path("w.npy"), &weights).expect("a file");
    desk
}

pub(super) fn write_waves(desk: &Desk, snapshots: usize, unknowns: usize, size: f64) {
    let wave = |n: usize, at: f64| (n as f64 * std::f64::consts::PI * at).sin();
    let of_time = Mat::from_fn(snapshots, 8, |k, n| {
        size * wave(2 * n + 1, (k + 1) as f64 / snapshots as f64) / ((n + 1) as f64).powi(4)
    });
    let in_space = Mat::from_fn(8, unknowns, |n, i| wave(n + 1, i as f64 / unknowns as f64));
    write_matrix(desk.path("x.npy"), (of_time * in_space).as_ref()).expect("a file");
}

pub(super) fn pod(desk: &Desk, more: &[&str]) -> Answer {
    desk.lumley(&[&POD, more].concat())
}

pub(super) fn modes(desk: &Desk) -> Vec<u8> {
    fs::read(desk.path("out/pod.npz")).expect("modes")
}

/// What `pod` gives that nothing stops.
pub(super) fn whole(desk: &Desk, more: &[&str]) -> Vec<u8> {
    pod(desk, more).good();
    let modes = modes(desk);
    fs::remove_dir_all(desk.path("out")).expect("removed");
    modes
}

/// Kills a decomposition as soon as `sign` stands in its directory.
pub(super) fn kill_at(desk: &Desk, more: &[&str], sign: &str) {
    let mut command = desk.command(&[&POD, more].concat());
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("starts");
    let started = Instant::now();
    let shown = || desk.path("out.partial").join(sign).exists() || desk.path("out").exists();
    while !shown() {
        assert!(started.elapsed() < Duration::from_secs(60), "no {sign} in a minute");
        assert!(child.try_wait().expect("its state").is_none(), "it ended before {sign}");
        sleep(Duration::from_micros(200));
    }
    child.kill().expect("killed");
    child.wait().expect("gone");
}

/// In each of three passes over 64 MB, between them, and when the modes are written.
#[test]
fn a_killed_decomposition_resumes_bit_for_bit() {
    let desk = desk(100, 80_000);
    let more = ["--modes", "6"];
    let expected = whole(&desk, &more);
    let signs = [
        "work/1-sketch-0-of-1.sum",
        "work/1-sketch.sum",
        "work/2-refinement-0-of-1.sum",
        "work/3-modes-0-of-1.sum",
        "work/3-modes.sum",
        "pod.npz",
    ];
    for sign in signs {
        kill_at(&desk, &more, sign);
        // Once the modes are there, the rest may be done before it is killed.
        if desk.path("out.partial").exists() {
            assert!(!desk.path("out").exists(), "an unfinished run does not look finished");
            pod(&desk, &[&more[..], &["--resume"]].concat()).good();
        }
        assert!(modes(&desk) == expected, "killed at {sign}: other bytes");
        assert_eq!(names(&desk.path("out")), FILES, "killed at {sign}");
        fs::remove_dir_all(desk.path("out")).expect("removed");
    }
}

const FILES: [&str; 5] = ["figures", "manifest.json", "pod.npz", "report.html", "summary.json"];

pub(super) fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let name = |entry: fs::DirEntry| entry.file_name().to_string_lossy().into_owned();
    let mut names: Vec<_> = entries.map(|entry| name(entry.expect("an entry"))).collect();
    names.sort();
    names
}

/// Killed before it wrote anything but its lock.
#[test]
fn what_has_hardly_begun_goes_on_too() {
    let desk = desk(10, 50);
    desk.write("out.partial/.lumley-lock", b"");
    pod(&desk, &["--resume"]).good();
}

/// Where files may have no more than some blocks of 512 bytes, every kind of file is in turn the one that
/// is too long: what failed is named, the older run stands, and without the limit the work goes on.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_named_and_costs_nothing() {
    let scratch = 20_000 * 6 * 8 / 512;
    let table = [
        (20_000, 1, "manifest.json"),
        (20_000, 8, "1-sketch"),
        (20_000, scratch / 2, "modes.scratch"),
        (20_000, scratch, "pod.npz"),
        (60, 32, "report.html"),
    ];
    for (unknowns, blocks, file) in table {
        let desk = desk(40, unknowns);
        let expected = whole(&desk, &["--modes", "6"]);
        pod(&desk, &["--modes", "2"]).good();
        let older = desk.files("out");
        let force = ["--modes", "6", "--force"];
        limited(&desk, blocks, &force).refused(2, &[file, "File too large", "free space"]);
        assert!(desk.files("out") == older, "{file}: the older run has changed");
        let unfinished = desk.path("out.partial").exists();
        assert_eq!(unfinished, file != "1-sketch", "{file}: what can go on is kept");
        let resume = if unfinished { &["--resume"][..] } else { &[] };
        pod(&desk, &[&force, resume].concat()).good();
        assert!(modes(&desk) == expected, "{file}: other bytes");
        assert_eq!(names(&desk.path("out")), FILES, "{file}");
    }
}

/// `pod` where no file may be longer than `blocks` of 512 bytes.
#[cfg(target_os = "linux")]
fn limited(desk: &Desk, blocks: usize, more: &[&str]) -> Answer {
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" \"$@\"");
    let mut shell = Command::new("sh");
    shell.args(["-c", &script, env!("CARGO_BIN_EXE_lumley")]).args(POD).args(more);
    Answer::of(&shell.current_dir(desk.0.path()).output().expect("sh starts"))
}

/// Progress that goes to a log on a full disk.
#[cfg(target_os = "linux")]
#[test]
fn words_that_nobody_can_hear_do_not_stop_the_work() {
    let desk = desk(10, 50);
    let full = fs::File::options().write(true).open("/dev/full").expect("a full device");
    let status = desk.command(&POD).stderr(full).status().expect("lumley starts");
    assert!(status.success(), "{status}");
    assert!(desk.path("out/pod.npz").is_file());
}

/// A launcher that starts several processes of a lumley that knows no MPI, or of another MPI.
#[test]
fn processes_that_cannot_share_the_work_refuse_it() {
    let desk = desk(10, 50);
    let output = desk.command(&POD).env("PMI_SIZE", "3").output().expect("lumley starts");
    let help = if cfg!(feature = "mpi") { "mpirun" } else { "--features mpi" };
    Answer::of(&output).refused(2, &["3 processes were started", help]);
    assert!(!desk.path("out").exists());
}
