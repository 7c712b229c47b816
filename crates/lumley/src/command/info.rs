use super::say;
use crate::Error;
use crate::directory::DirectoryError;
use crate::format::gmsh;
use crate::format::npy::NpyMatrix;
use crate::format::npz::NpzReader;
use crate::manifest::MANIFEST;
use crate::record::{Record, Support};
use crate::run;
use clap::Args;
use lumley_fem::quadrature::gauss_legendre;
use lumley_fem::{MeshDescription, Point};
use std::path::{Path, PathBuf};

#[derive(Args)]
pub(super) struct Arguments {
    /// A run directory, a record, an NPY or an NPZ file, a mesh of gmsh
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
        } else if ending.as_deref() == Some("msh") {
            mesh(path)
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
    let records = ["record", "pictures"].map(|name| path.join(name));
    records.iter().filter(|folder| folder.is_dir()).try_for_each(|folder| record(folder))
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

fn mesh(path: &Path) -> Result<(), Error> {
    let mesh = gmsh::read(path)?;
    let (triangles, quadrilaterals) = (mesh.triangles.len(), mesh.quadrilaterals.len());
    say(&format!("mesh            {triangles} triangles, {quadrilaterals} quadrilaterals"))?;
    say(&format!("nodes           {}", mesh.points.len()))?;
    for boundary in &mesh.boundaries {
        let length: f64 = boundary.edges.iter().map(|edge| edge_length(&mesh, *edge)).sum();
        let (name, edges) = (&boundary.name, boundary.edges.len());
        say(&format!("boundary        {name}: {edges} edges, {length:.6} m"))?;
    }
    Ok(())
}

/// Length of a quadratic edge, in m.
fn edge_length(mesh: &MeshDescription, edge: [usize; 3]) -> f64 {
    let [a, b, middle]: [Point; 3] = edge.map(|node| mesh.points[node]);
    let speed = |t: f64| {
        let slope = |d: usize| {
            (4.0 * t - 3.0) * a[d] + (4.0 * t - 1.0) * b[d] + (4.0 - 8.0 * t) * middle[d]
        };
        slope(0).hypot(slope(1))
    };
    gauss_legendre(5).into_iter().map(|(t, weight)| weight * speed(t)).sum()
}
