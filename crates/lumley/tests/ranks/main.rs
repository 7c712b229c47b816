//! Ranks over MPI. Each test starts this program again under `mpirun`, as the ranks of one job, or lumley.

mod pod;

use lumley::ranks::{Job, RanksError};
use lumley_pod::Ranks;
use std::env;
use std::process::{Command, ExitCode, Output};
use std::time::{Duration, Instant};

type Program = fn(Job) -> ExitCode;

/// What a rank can be told to do.
const PROGRAMS: [(&str, Program); 4] = [
    ("exchange", exchange),
    ("panic", panic_on_rank_2),
    ("abort", abort_on_rank_1),
    ("leave", leave_on_rank_1),
];

const TESTS: [(&str, fn()); 13] = [
    ("messages arrive whole and in order", messages_arrive_whole_and_in_order),
    ("a panic ends the job", a_panic_ends_the_job),
    ("an error ends the job with its status", an_error_ends_the_job_with_its_status),
    ("a rank that leaves ends the job", a_rank_that_leaves_ends_the_job),
    ("a foreign launcher is noticed", a_foreign_launcher_is_noticed),
    ("any number of ranks gives the same bytes", pod::any_number_of_ranks_gives_the_same_bytes),
    ("any number of ranks updates a basis", pod::any_number_of_ranks_updates_a_basis),
    ("a missing file ends the job", pod::a_missing_file_ends_the_job),
    ("a full disk under one rank is kept", pod::a_full_disk_under_one_rank_is_kept_for_resume),
    ("a killed job resumes", pod::a_killed_job_resumes),
    ("what all ranks see is said once", pod::what_all_ranks_see_is_said_once),
    ("each rank checks its weights", pod::each_rank_checks_a_share_of_the_weights),
    ("other commands refuse", pod::other_commands_refuse),
];

fn main() -> ExitCode {
    let asked = env::args().nth(1);
    if let Some((_, program)) = PROGRAMS.iter().find(|(name, _)| asked.as_deref() == Some(*name)) {
        return start(*program);
    }
    for (name, test) in TESTS {
        test();
        eprintln!("test {name} ... ok");
    }
    ExitCode::SUCCESS
}

fn start(program: Program) -> ExitCode {
    match Job::join() {
        Ok(job) => program(job),
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

fn messages_arrive_whole_and_in_order() {
    for count in 1..=4 {
        let output = run(count, "exchange");
        assert!(output.status.success(), "{count} ranks: {}", stderr(&output));
        assert_eq!(stderr(&output), "", "{count} ranks");
    }
}

fn a_panic_ends_the_job() {
    let said = failing(4, "panic", 1);
    assert!(said.contains("rank 2 panics"), "{said}");
}

fn an_error_ends_the_job_with_its_status() {
    let said = failing(3, "abort", 2);
    assert!(said.contains("data.npy is truncated"), "{said}");
}

fn a_rank_that_leaves_ends_the_job() {
    failing(3, "leave", 1);
}

/// MPICH's launcher announces itself by `PMI_SIZE`, which Open MPI does not read.
fn a_foreign_launcher_is_noticed() {
    let expected = RanksError::Launcher { started: 4, joined: 1 }.to_string();
    let output = this_program().env("PMI_SIZE", "4").arg("exchange").output();
    let output = output.expect("this program starts");
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(stderr(&output).trim_end(), expected);
}

/// Messages of every length that is special: none, short, one piece, one piece and a byte, several.
const LENGTHS: [usize; 6] = [0, 1, 1000, 1 << 24, (1 << 24) + 1, 40_000_000];

fn exchange(job: Job) -> ExitCode {
    assert_eq!(job.neighbours(), job.ranks().count(), "all of them are on this machine");
    up_the_tree(job.ranks());
    down_the_tree(job.ranks());
    job.end(0)
}

fn up_the_tree(ranks: &dyn Ranks) {
    for length in LENGTHS {
        for child in children(ranks) {
            assert!(ranks.receive(child) == pattern(child, length), "{length} bytes upwards");
        }
        if let Some(parent) = parent(ranks) {
            ranks.send(parent, &pattern(ranks.rank(), length));
        }
    }
}

fn down_the_tree(ranks: &dyn Ranks) {
    for length in LENGTHS {
        if let Some(parent) = parent(ranks) {
            assert!(ranks.receive(parent) == pattern(parent, length), "{length} bytes downwards");
        }
        children(ranks).for_each(|child| ranks.send(child, &pattern(ranks.rank(), length)));
    }
}

fn parent(ranks: &dyn Ranks) -> Option<usize> {
    Some(ranks.rank().checked_sub(1)? / 2)
}

fn children(ranks: &dyn Ranks) -> impl Iterator<Item = usize> {
    let count = ranks.count();
    (2 * ranks.rank() + 1..=2 * ranks.rank() + 2).filter(move |&child| child < count)
}

/// Bytes that show where they belong: their period, a prime, does not divide the length of a piece.
fn pattern(rank: usize, length: usize) -> Vec<u8> {
    let first = u8::try_from(rank).expect("a handful of ranks");
    let period: Vec<u8> = (0..251).map(|byte: u8| byte.wrapping_add(first)).collect();
    let mut bytes = period.repeat(length.div_ceil(period.len()));
    bytes.truncate(length);
    bytes
}

fn panic_on_rank_2(job: Job) -> ExitCode {
    assert!(job.ranks().rank() != 2, "rank 2 panics");
    wait_for(2, job)
}

fn abort_on_rank_1(job: Job) -> ExitCode {
    if job.ranks().rank() == 1 {
        eprintln!("data.npy is truncated");
        return job.end(2);
    }
    wait_for(1, job)
}

fn leave_on_rank_1(job: Job) -> ExitCode {
    if job.ranks().rank() == 1 {
        return ExitCode::SUCCESS;
    }
    wait_for(1, job)
}

/// Waits for what never comes.
fn wait_for(rank: usize, job: Job) -> ExitCode {
    job.ranks().receive(rank);
    job.end(0)
}

/// Checks that a job ends with `status`, long before `mpirun` would end it, and gives what it said.
fn failing(count: usize, program: &str, status: i32) -> String {
    let started = Instant::now();
    let output = run(count, program);
    let (took, said) = (started.elapsed(), stderr(&output));
    assert!(took < Duration::from_secs(15), "{program} took {took:?}: {said}");
    assert_eq!(output.status.code(), Some(status), "{program}: {said}");
    said
}

/// More ranks than cores, and at most a minute.
fn mpirun(count: usize) -> Command {
    let mut mpirun = Command::new("mpirun");
    mpirun.env("OMPI_MCA_rmaps_base_oversubscribe", "1").env("MPIEXEC_TIMEOUT", "60");
    mpirun.args(["-n", &count.to_string()]);
    mpirun
}

fn run(count: usize, program: &str) -> Output {
    let mut mpirun = mpirun(count);
    mpirun.arg(this_program().get_program()).arg(program);
    mpirun.output().expect("mpirun is in the PATH, with the MPI that lumley was built with")
}

fn this_program() -> Command {
    Command::new(env::current_exe().expect("the path of this program"))
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}
