use super::{Output, say};
use crate::Error;
use crate::case::PodChoice;
use crate::directory::default_target;
use crate::format::npy::SnapshotLayout;
use crate::progress::Progress;
use crate::ranks::{Job, path_of_first, together};
use crate::report::FieldGrid;
use crate::run::{PodInput, Task, decompose_snapshots};
use crate::summary::Summary;
use clap::{Args, ValueEnum};
use lumley_pod::{ALGORITHMS, APPROXIMATIONS, Ranks, Truncation};
use std::path::{Path, PathBuf};
use std::time::Duration;

#[derive(Args)]
pub(super) struct Arguments {
    /// Snapshots: a matrix in an NPY file, a run directory or its record
    #[arg(value_name = "X.npy|RECORD")]
    snapshots_file: PathBuf,
    /// Weights of the inner product, one for each unknown (or each node)
    #[arg(long, value_name = "W.npy")]
    weights: Option<PathBuf>,
    /// Whether a row of the file is a snapshot or a column is
    #[arg(long, value_enum, default_value = "rows")]
    snapshots: Layout,
    /// Times of the snapshots, in s; where the steps differ, the trapezoid rule weighs them
    #[arg(long, value_name = "T.npy")]
    times: Option<PathBuf>,
    /// Nodes of the uniform grid that the unknowns stand for, to draw the modes
    #[arg(long, value_name = "NX[,NY[,NZ]]", value_delimiter = ',', num_args = 1..=3)]
    grid: Vec<usize>,
    /// Components at each node, one after the other in a snapshot
    #[arg(long, value_name = "K", default_value_t = 1)]
    components: usize,
    /// Number of modes
    #[arg(long, value_name = "N", conflicts_with = "energy")]
    modes: Option<usize>,
    /// Share of the energy that the modes hold; 0.9999 unless given
    #[arg(long, value_name = "F")]
    energy: Option<f64>,
    /// A basis that the snapshots update: POD of what it was made of and of these
    #[arg(long, value_name = "OLD.npz|DIR")]
    update: Option<PathBuf>,
    /// Algorithm; auto unless given, and incremental to update
    #[arg(long, value_parser = methods())]
    method: Option<String>,
    /// Subtract the mean over time
    #[arg(long)]
    center: bool,
    /// Most memory for each process to take, such as 200MB or 4GiB; by default all those on a machine
    /// share a quarter of its memory
    #[arg(long, value_name = "SIZE", value_parser = size)]
    memory: Option<u64>,
    /// Leave out snapshots that hold NaN or infinity; else they are an error
    #[arg(long)]
    skip_non_finite: bool,
    /// Go on with an unfinished decomposition
    #[arg(long)]
    resume: bool,
    /// Threads; by default all
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// Least time between notes of how far it is, in s, for --resume
    #[arg(long, value_name = "SECONDS", default_value_t = 5)]
    checkpoint: u64,
    #[command(flatten)]
    output: Output,
}

#[derive(Clone, Copy, ValueEnum)]
enum Layout {
    Rows,
    Columns,
}

/// Bytes of a size with its unit.
fn size(text: &str) -> Result<u64, String> {
    const UNITS: [(&str, f64); 9] = [
        ("kib", 1024.0),
        ("mib", 1_048_576.0),
        ("gib", 1_073_741_824.0),
        ("tib", 1_099_511_627_776.0),
        ("kb", 1e3),
        ("mb", 1e6),
        ("gb", 1e9),
        ("tb", 1e12),
        ("b", 1.0),
    ];
    let text = text.to_ascii_lowercase();
    let unit = UNITS.iter().find_map(|(name, unit)| Some((text.strip_suffix(name)?, unit)));
    let (number, unit) = unit.ok_or("expected a number with its unit, such as 200MB or 4GiB")?;
    match number.trim().parse::<f64>() {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a checked range"
        )]
        Ok(number) if number * unit >= 1.0 && number * unit < 1e18 => Ok((number * unit) as u64),
        _ => Err("expected a positive number with its unit, such as 200MB or 4GiB".into()),
    }
}

fn methods() -> clap::builder::PossibleValuesParser {
    clap::builder::PossibleValuesParser::new(
        ALGORITHMS.iter().chain(APPROXIMATIONS).map(|a| a.name),
    )
}

impl Arguments {
    pub(super) fn execute(&self, job: &Job, progress: &mut Progress) -> Result<(), Error> {
        let ranks = job.ranks();
        let input = together(ranks, self.input())?;
        let mut task = Task::new(&self.target(ranks)?, self.output.existing(self.resume));
        task.threads = self.threads.map_or(task.threads, usize::from);
        task.neighbours = job.neighbours();
        task.checkpoint = Duration::from_secs(self.checkpoint);
        let (directory, summary) = decompose_snapshots(&input, &task, ranks, progress)?;
        if ranks.rank() > 0 {
            return Ok(());
        }
        if self.output.json { say(&summary.to_json()) } else { tell_result(&directory, &summary) }
    }

    fn input(&self) -> Result<PodInput, Error> {
        Ok(PodInput {
            path: self.snapshots_file.clone(),
            weights: self.weights.clone(),
            layout: match self.snapshots {
                Layout::Rows => SnapshotLayout::Rows,
                Layout::Columns => SnapshotLayout::Columns,
            },
            times: self.times.clone(),
            grid: self.field_grid()?,
            components: self.components,
            choice: self.choice()?,
            memory: self.memory,
            skip_non_finite: self.skip_non_finite,
            update: self.update.clone(),
        })
    }

    /// The run directory: the one that is named, or one that is named after the snapshots.
    fn target(&self, ranks: &dyn Ranks) -> Result<PathBuf, Error> {
        if let Some(directory) = &self.output.directory {
            return Ok(directory.clone());
        }
        path_of_first(ranks, || {
            // `.` and `..` have a name elsewhere only.
            let whole = self.snapshots_file.canonicalize().unwrap_or_default();
            let stem = self.snapshots_file.file_stem().or(whole.file_stem()).unwrap_or_default();
            default_target(&format!("{}-pod", stem.to_string_lossy()), self.resume)
        })
    }

    fn choice(&self) -> Result<PodChoice, Error> {
        let refuse = |argument, value: String, expected: &str| {
            Err(Error::Argument { argument, value, expected: expected.into() })
        };
        let truncation = match (self.modes, self.energy) {
            (Some(0), _) => return refuse("--modes", "0".into(), "at least 1"),
            (Some(modes), _) => Truncation::Modes(modes),
            (None, Some(share)) if !(share > 0.0 && share <= 1.0) => {
                let expected = "a share of the energy above 0 and at most 1, such as 0.9999";
                return refuse("--energy", share.to_string(), expected);
            }
            (None, share) => Truncation::Energy(share.unwrap_or(0.9999)),
        };
        let unset = if self.update.is_some() { "incremental" } else { "auto" };
        let method = self.method.clone().unwrap_or_else(|| unset.into());
        Ok(PodChoice { method, truncation, center: self.center, every: None })
    }

    fn field_grid(&self) -> Result<Option<FieldGrid>, Error> {
        let mut nodes = [1; 3];
        let Some(given) = nodes.get_mut(..self.grid.len()) else {
            let value = self.grid.iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
            let expected = "one to three numbers of nodes".into();
            return Err(Error::Argument { argument: "--grid", value, expected });
        };
        given.copy_from_slice(&self.grid);
        let components = self.components;
        Ok((!self.grid.is_empty()).then_some(FieldGrid { nodes, components }))
    }
}

/// What came of it, for people.
fn tell_result(directory: &Path, summary: &Summary) -> Result<(), Error> {
    let energy = summary.pod.cumulative_percent.last().copied().unwrap_or_default();
    let bound = summary.pod.error_bound.map(|bound| format!(", error bound {bound:.1e}"));
    let bound = bound.unwrap_or_default();
    say(&format!("{} modes, {energy:.4} % of the energy{bound}", summary.pod.modes))?;
    say(&format!("{}", directory.join("pod.npz").display()))?;
    say(&format!("{}", directory.join("report.html").display()))
}
