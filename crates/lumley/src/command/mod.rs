//! The command line: arguments in, one exit code out. Results on stdout, everything else on stderr.

mod cases;
mod check;
mod info;
mod pod;
mod report;
mod rom;
mod run;
mod verify;

use crate::Error;
use crate::case::{Case, CaseError};
use crate::directory::Existing;
use crate::progress::{Progress, tell};
use crate::ranks::{Job, together};
use clap::{Args, Parser, Subcommand};
use std::io::{self, Write as _};
use std::path::PathBuf;
use std::process::ExitCode;

/// Proper orthogonal decomposition and reduced-order models of flows with moving bodies.
#[derive(Parser)]
#[command(name = "lumley", version, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Run a case: full-order model, record, POD, reduced models, report
    Run(run::Arguments),
    /// Say what a case would do (unknowns, memory, time, disk) and run nothing
    Check(check::Arguments),
    /// POD of snapshots alone: an NPY file or the record of a run
    Pod(pod::Arguments),
    /// Run the reduced models of a run again, with other parameters or for a longer time
    Rom(rom::Arguments),
    /// Write the report of a run again
    Report(report::Arguments),
    /// Tell what a file or a run directory holds
    Info(info::Arguments),
    /// List the cases that come with lumley, or print one
    Cases(cases::Arguments),
    /// Compute the reference numbers and compare: exit code 1 when one is missed
    Verify(verify::Arguments),
}

/// A case file and what is laid over it.
#[derive(Args)]
struct CaseArguments {
    /// The case file
    #[arg(value_name = "CASE.toml")]
    case: PathBuf,
    /// Set a key of the case, such as piston.mass=0.6; may be given again and again
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Lay the case's [quick] table over it: a coarse run for a first look
    #[arg(long)]
    quick: bool,
}

impl CaseArguments {
    fn load(&self) -> Result<Case, CaseError> {
        Case::load(&self.case, self.quick, &self.set)
    }
}

/// Where a command writes, and what it may replace.
#[derive(Args)]
struct Output {
    /// Directory to write; an existing one is an error
    #[arg(short = 'o', long = "output", value_name = "DIR")]
    directory: Option<PathBuf>,
    /// Replace a run of lumley that stands there
    #[arg(long)]
    force: bool,
    /// Print the summary as one JSON object on stdout
    #[arg(long)]
    json: bool,
}

impl Output {
    fn existing(&self, resume: bool) -> Existing {
        Existing { replace: self.force, resume }
    }
}

/// Runs the command line of this process.
pub fn main() -> ExitCode {
    let cli = Cli::parse();
    let job = match Job::join() {
        Ok(job) => job,
        Err(error) => return ExitCode::from(report_failure("", &error.into())),
    };
    let (rank, count) = (job.ranks().rank(), job.ranks().count());
    let who = if count > 1 { format!("rank {rank}: ") } else { String::new() };
    match dispatch(cli.command, &job) {
        Ok(()) => job.end(0),
        // That process says why, and ends them all.
        Err(Error::Elsewhere(failure)) => job.wait_for_end_by(failure.rank),
        Err(error) => job.end(report_failure(&who, &error)),
    }
}

fn report_failure(who: &str, error: &Error) -> u8 {
    tell(&format!("error: {who}{error}"));
    error.exit_code()
}

fn dispatch(command: Command, job: &Job) -> Result<(), Error> {
    let ranks = job.ranks();
    let first = ranks.rank() == 0;
    let mut progress = if first { Progress::stderr() } else { Progress::silent() };
    match command {
        Command::Pod(arguments) => arguments.execute(job, &mut progress),
        _ if ranks.count() > 1 => {
            together(ranks, if first { Err(Error::OneProcess) } else { Ok(()) })
        }
        Command::Run(arguments) => arguments.execute(&mut progress),
        Command::Check(arguments) => arguments.execute(),
        Command::Rom(arguments) => arguments.execute(&mut progress),
        Command::Report(arguments) => arguments.execute(&mut progress),
        Command::Info(arguments) => arguments.execute(),
        Command::Cases(arguments) => arguments.execute(),
        Command::Verify(arguments) => arguments.execute(&mut progress),
    }
}

/// Prints a line of a command's result; a reader that went away is not an error.
fn say(line: &str) -> Result<(), Error> {
    match writeln!(io::stdout(), "{line}") {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(error.into()),
        _ => Ok(()),
    }
}
