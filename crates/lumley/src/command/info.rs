use super::say;
use crate::Error;
use crate::directory::DirectoryError;
use crate::format::npy::NpyMatrix;
use crate::format::npz::NpzReader;
use crate::manifest::MANIFEST;
use crate::record::{Record, Support};
use crate::run;
use clap::Args;
use std::path::{Path, PathBuf};

#[derive(Args)]
pub(super) struct Arguments {
    /// A run directory, a record, an NPY or an NPZ file
    #[arg(value_name = "FILE|DIR")]
    path: PathBuf,
}

impl Arguments {
    pub(super) fn execute(&self) -> Result<(), Error> {
        let path = &self.path;
        let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        if path.join("zarr.json").is_file() {
            record(path)
        } else if path.is_dir() && path.join(MANIFEST).is_file() {
            run_directory(path)
        } else if path.is_dir() {
            Err(DirectoryError::NotARun { path: path.clone() }.into())
        } else if ending.as_deref() == Some("npz") {
            archive(path)
        } else {
            array(&NpyMatrix::open(path)?, "array")
        }
    }
}

fn run_directory(path: &Path) -> Result<(), Error> {
    let (manifest, summary) = run::read_summary(path)?;
    let state = if manifest.complete { "complete" } else { "unfinished" };
    say(&format!(
        "run             {} of case {}, lumley {}",
        state, manifest.case, manifest.version
    ))?;
    for stage in &manifest.stages {
        say(&format!("{:<15} {:.2} s", stage.name, stage.seconds))?;
    }
    super::run::headline(&summary)?;
    let inner = path.join("record");
    if inner.is_dir() { record(&inner) } else { Ok(()) }
}

fn record(path: &Path) -> Result<(), Error> {
    let record = Record::open(path)?;
    let blocks = record.verify()?;
    let times = record.times();
    let (first, last) = (times.first().copied(), times.last().copied());
    let span = first.zip(last).map_or(String::new(), |(a, b)| format!(", t = {a} to {b} s"));
    say(&format!("record          {} snapshots{span}; {blocks} blocks, all whole", times.len()))?;
    for frame in &record.description().frames {
        let support = match &frame.support {
            Support::Grid(grid) => {
                let [nx, ny] = grid.nodes();
                format!("a uniform grid of {nx} x {ny} nodes")
            }
            Support::Nodes(nodes) => format!("{} nodes", nodes.len()),
        };
        let names: Vec<String> =
            frame.components.iter().map(|c| format!("{} in {}", c.name, c.unit)).collect();
        say(&format!("frame           {}: {} on {support}", frame.name, names.join(", ")))?;
    }
    for series in &record.description().series {
        let names: Vec<String> =
            series.entries.iter().map(|c| format!("{} in {}", c.name, c.unit)).collect();
        say(&format!("series          {}: {}", series.name, names.join(", ")))?;
    }
    Ok(())
}

fn archive(path: &Path) -> Result<(), Error> {
    let archive = NpzReader::open(path)?;
    for name in archive.names() {
        array(&archive.matrix(name)?, name)?;
    }
    Ok(())
}

fn array(matrix: &NpyMatrix, name: &str) -> Result<(), Error> {
    say(&format!("{name:<15} shape {:?}, {}", matrix.shape(), matrix.dtype()))
}
