//! `lumley pod` under `mpirun`.

use super::{mpirun, stderr};
use faer::Mat;
use lumley::format::npy::{write_matrix, write_vector};
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use std::time::{Duration, Instant};
use tempfile::TempDir;

const LUMLEY: &str = env!("CARGO_BIN_EXE_lumley");

/// A directory with snapshots of `unknowns` and weights.
fn desk(unknowns: usize) -> TempDir {
    let desk = tempfile::tempdir().expect("a temporary directory");
    let of_time = Mat::from_fn(40, 8, |k, n| ((k * (n + 1)) as f64).cos() / 10_f64.powf(n as f64));
    let in_space = Mat::from_fn(8, unknowns, |n, i| (1e-3 * (i * (2 * n + 1)) as f64).sin());
    write_matrix(desk.path().join("x.npy"), (of_time * in_space).as_ref()).expect("a file");
    let weights: Vec<f64> = (0..unknowns).map(|i| 1.0 + (i % 3) as f64).collect();
    write_vector(desk.path().join("w.npy"), &weights).expect("a file");
    desk
}

/// A job of `count` ranks of the shell's `command`, in which `"$0"` is lumley.
fn job(desk: &Path, count: usize, command: &str) -> Command {
    let mut mpirun = mpirun(count);
    mpirun.args(["sh", "-c", command, LUMLEY]).current_dir(desk);
    mpirun
}

fn finished(desk: &Path, count: usize, command: &str) -> Output {
    job(desk, count, command).output().expect("mpirun starts")
}

/// A job that ends with code 2, soon, and says all of these things.
fn refused(desk: &Path, count: usize, command: &str, words: &[&str]) {
    let started = Instant::now();
    let output = finished(desk, count, command);
    let (took, said) = (started.elapsed(), stderr(&output));
    assert!(took < Duration::from_secs(15), "{command} took {took:?}: {said}");
    assert_eq!(output.status.code(), Some(2), "{command}: {said}");
    for word in words {
        assert!(said.contains(word), "no {word:?} in: {said}");
    }
    assert_eq!(said.matches("error:").count(), 1, "{said}");
}

fn good(output: &Output) {
    assert!(output.status.success(), "{}", stderr(output));
}

const POD: &str = "exec \"$0\" pod x.npy --weights w.npy --modes 6 --method svd --threads 1";

/// The modes and the summary do not depend on the number of ranks.
pub fn any_number_of_ranks_gives_the_same_bytes() {
    let desk = desk(20_011);
    let files = |count: usize| {
        good(&finished(desk.path(), count, &format!("{POD} -o out-{count}")));
        let out = desk.path().join(format!("out-{count}"));
        let summary = fs::read_to_string(out.join("summary.json")).expect("a summary");
        let summary = summary.replace(&format!("out-{count}"), "out");
        (fs::read(out.join("pod.npz")).expect("modes"), summary)
    };
    let alone = files(1);
    for count in 2..=4 {
        let (modes, summary) = files(count);
        assert!(modes == alone.0, "{count} ranks: other modes");
        assert_eq!(summary, alone.1, "{count} ranks");
    }
}

/// Of the old basis, whose mean was subtracted, one rank reads all and the others their rows.
pub fn any_number_of_ranks_updates_a_basis() {
    let desk = desk(20_011);
    good(&finished(desk.path(), 1, &format!("{POD} --center -o old")));
    let update = "exec \"$0\" pod x.npy --weights w.npy --update old --modes 6 --threads 1";
    for count in [1, 3] {
        good(&finished(desk.path(), count, &format!("{update} -o {count}")));
    }
    assert!(modes(desk.path(), "1") == modes(desk.path(), "3"), "other modes");
}

/// One rank without its file ends the job, and says which file; so do all of them, once.
pub fn a_missing_file_ends_the_job() {
    let desk = desk(100);
    let second = "[ $OMPI_COMM_WORLD_RANK = 2 ] && exec \"$0\" pod gone.npy -o out;";
    let all = format!("{second} {POD} -o out");
    refused(desk.path(), 4, &all, &["rank 2: ", "gone.npy", "No such file"]);
    refused(desk.path(), 3, "exec \"$0\" pod gone.npy -o out", &["gone.npy", "No such file"]);
    assert!(!desk.path().join("out").exists() && !desk.path().join("out.partial").exists());
}

/// What one rank alone writes fails on a full disk, here behind 8 MiB, which is room for MPI's own files:
/// what was done is kept, and gone on with.
pub fn a_full_disk_under_one_rank_is_kept_for_resume() {
    let desk = desk(200_003);
    let full = "[ $OMPI_COMM_WORLD_RANK = 2 ] && trap '' XFSZ && ulimit -f 16384;";
    refused(desk.path(), 3, &format!("{full} {POD} -o out"), &["rank 2: ", "modes.scratch"]);
    good(&finished(desk.path(), 3, &format!("{POD} -o out --resume")));
    good(&finished(desk.path(), 1, &format!("{POD} -o whole")));
    assert!(modes(desk.path(), "out") == modes(desk.path(), "whole"), "other modes");
}

fn modes(desk: &Path, out: &str) -> Vec<u8> {
    fs::read(desk.join(out).join("pod.npz")).expect("modes")
}

/// A job of which a rank is killed ends, and goes on where it was, also with another number of ranks.
pub fn a_killed_job_resumes() {
    let desk = desk(200_003);
    good(&finished(desk.path(), 1, &format!("{POD} -o whole")));
    let table = [
        (1, 4, "1-sketch-1-of-4"),
        (0, 4, "1-sketch-0-of-4"),
        (1, 4, "2-refinement-3-of-4"),
        (0, 2, "2-refinement"),
        (1, 2, "3-modes"),
    ];
    for (rank, count, entry) in table {
        kill_at(desk.path(), rank, entry);
        // After the last pass, what is left may be done before the job is.
        if desk.path().join("out.partial").exists() {
            good(&finished(desk.path(), count, &format!("{POD} -o out --resume")));
        }
        assert!(modes(desk.path(), "out") == modes(desk.path(), "whole"), "killed at {entry}");
        fs::remove_dir_all(desk.path().join("out")).expect("removed");
    }
    // It was killed as it was about to take its name: the summary is that of the whole run.
    fs::rename(desk.path().join("whole"), desk.path().join("out.partial")).expect("renamed");
    let output = finished(desk.path(), 3, &format!("{POD} -o out --resume"));
    good(&output);
    assert!(String::from_utf8_lossy(&output.stdout).contains("6 modes"), "{output:?}");
    assert_eq!(stderr(&output), "", "nothing is computed");
}

/// A job of four ranks, of which this one is killed as soon as the journal has this entry.
fn kill_at(desk: &Path, rank: usize, entry: &str) {
    // The shell's number, `$$`, is lumley's after exec.
    let kill = format!("[ -e out.partial/work/{entry}.sum ] && kill -9 $$");
    let watch = format!("(while kill -0 $$ 2>/dev/null; do {kill}; done) &");
    let pod = format!("{POD} --checkpoint 0 -o out");
    let one = format!("[ $OMPI_COMM_WORLD_RANK = {rank} ] && {{ {watch} }}");
    let output = finished(desk, 4, &format!("{one}; {pod}"));
    assert!(!output.status.success(), "not killed at {entry}: {}", stderr(&output));
}

/// What is wrong for all of them is said once.
pub fn what_all_ranks_see_is_said_once() {
    let desk = desk(20_011);
    write_matrix(desk.path().join("zero.npy"), Mat::<f64>::zeros(4, 5000).as_ref()).expect("zeros");
    let table: [(&str, &[&str]); 4] = [
        ("x.npy --modes 0", &["--modes 0", "at least 1"]),
        ("x.npy --method incremental", &["3 ranks share the rows"]),
        ("x.npy --memory 1kB", &["the limit is 1000"]),
        ("zero.npy", &["zero.npy", "no energy"]),
    ];
    for (arguments, words) in table {
        refused(desk.path(), 3, &format!("exec \"$0\" pod {arguments} -o out"), words);
        assert!(!desk.path().join("out.partial").exists(), "{arguments}");
    }
}

/// A weight that cannot be is found by the rank whose share it is in.
pub fn each_rank_checks_a_share_of_the_weights() {
    let desk = desk(20_011);
    for (index, rank) in [(0, 0), (9_999, 1), (20_010, 3)] {
        let mut weights = vec![1.0; 20_011];
        weights[index] = -1.0;
        write_vector(desk.path().join("w.npy"), &weights).expect("a file");
        let words = [&format!("rank {rank}: "), "w.npy", &format!("weight {index}")];
        refused(desk.path(), 4, &format!("{POD} -o out"), &words);
    }
}

/// Commands that cannot share their work say so, once.
pub fn other_commands_refuse() {
    let desk = desk(100);
    for command in ["cases", "info x.npy", "verify"] {
        let words = ["only `lumley pod`", "without mpirun"];
        refused(desk.path(), 2, &format!("exec \"$0\" {command}"), &words);
    }
}
