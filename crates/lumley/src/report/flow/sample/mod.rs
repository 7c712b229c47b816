//! The directory of a run, made from formulas, for tests.

mod bodies;

use crate::format::csv::write_columns;
use crate::format::npz::NpzWriter;
use crate::manifest::{MANIFEST, Manifest, Stage};
use crate::record::{Description, FrameDescription, Quantity, RecordWriter, Snapshot, Support};
use crate::run::BasisFile;
use crate::summary::SUMMARY;
use bodies::{BODIES, lift, numbers_of_bodies, write_bodies};
use faer::Mat;
use lumley_fem::generate::Channel;
use lumley_fem::{MeshDescription, Point, UniformGrid};
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

pub(super) type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Frequency of the street, in Hz.
const FREQUENCY: f64 = 3.0;

/// Which run is to be made.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    /// Nodes of the pictures.
    pub picture: [usize; 2],
    /// Snapshots, over three seconds.
    pub snapshots: usize,
    /// Whether the cylinder moves up and down.
    pub moves: bool,
}

impl Default for Sample {
    fn default() -> Self {
        Self { picture: [67, 13], snapshots: 12, moves: false }
    }
}

pub(super) const CASE: &str = r#"
title = "A vortex street"
[flow]
density = 1.0
viscosity = 0.001
[flow.boundaries.left]
kind = "velocity"
profile = "parabolic"
peak = 1.5
[flow.boundaries.cylinder]
kind = "no-slip"
[flow.reference]
velocity = 1.0
length = 0.1
[time]
end = 3.0
step = 0.005
"#;

impl Sample {
    /// Makes the directory.
    pub(super) fn write(&self, folder: &Path) -> Outcome {
        let mut manifest = Manifest::new("cylinder-2d2", "lumley run cases/cylinder-2d2/case.toml");
        manifest.stages = vec![Stage { name: "full-order model".into(), seconds: 12.5 }];
        manifest.complete = true;
        fs::write(folder.join(MANIFEST), manifest.to_json())?;
        let bodies = if self.moves { BODIES } else { "" };
        fs::write(folder.join("case.toml"), format!("{CASE}{bodies}"))?;
        fs::write(folder.join(SUMMARY), self.summary().to_string())?;
        if self.moves {
            write_bodies(&folder.join("bodies.csv"))?;
        }
        write_mesh(&folder.join("mesh.npz"), &mesh()?)?;
        write_tables(folder)?;
        self.write_records(folder)?;
        write_basis(folder)
    }

    fn displacement(&self, time: f64) -> f64 {
        if self.moves { lift(time) } else { 0.0 }
    }

    /// The summary, with what there is of bodies where they move.
    fn summary(&self) -> Value {
        let mut summary = summary();
        if self.moves {
            summary.as_object_mut().expect("an object").extend(numbers_of_bodies());
        }
        summary
    }

    /// The snapshots on the fixed grid, and the pictures.
    fn write_records(&self, folder: &Path) -> Outcome {
        let quantities = |names: &[&str]| names.iter().map(|n| Quantity::new(*n, "1")).collect();
        let description = |name: &str, nodes, components: &[&str]| Description {
            frames: vec![FrameDescription {
                name: name.into(),
                support: Support::Grid(grid(nodes)),
                length_unit: "m".into(),
                components: quantities(components),
            }],
            ..Description::default()
        };
        let fixed = description("fixed", FIXED, &["u", "v"]);
        let picture = description("picture", self.picture, &["u", "v", "p", "vorticity"]);
        for (name, description, nodes) in
            [("record", fixed, FIXED), ("pictures", picture, self.picture)]
        {
            let mut writer = RecordWriter::create(folder.join(name), &description)?;
            let components = description.frames[0].components.len();
            for k in 0..self.snapshots {
                let time = 3.0 * k as f64 / (self.snapshots.max(2) - 1) as f64;
                let y = self.displacement(time);
                let field = field(&grid(nodes), time, y, components);
                writer.append(&Snapshot { time, series: &[], fields: &[&field] })?;
            }
            writer.finish()?;
        }
        Ok(())
    }
}

fn grid(nodes: [usize; 2]) -> UniformGrid {
    UniformGrid::rectangle([0.0, 0.0], [2.2, 0.41], nodes)
}

/// Nodes of the fixed grid.
const FIXED: [usize; 2] = [45, 9];

pub(super) fn summary() -> Value {
    let still = json!({ "drag_coefficient_max": null, "force_mean": [0.031, 0.0] });
    json!({
        "case": "cylinder-2d2",
        "fom": { "steps": 600, "step_ms": 4.25, "unknowns": 40_321, "iterations_mean": 3.4 },
        "loads": {
            "bottom": still,
            "cylinder": {
                "drag_coefficient_max": 3.221_87,
                "drag_coefficient_mean": 3.190_12,
                "lift_coefficient_max": 0.982_34,
                "lift_coefficient_rms": 0.694_62,
                "strouhal": 0.300_13,
                "frequency": 3.001_3,
                "force_mean": [0.159_506, -0.000_912],
                "periods": 8,
                "window": [0.3, 2.965],
            },
        },
        "pressure_difference": 2.481_93,
        "projection": { "res_percent": [41.0, 12.0, 5.1, 2.2] },
        "warnings": [],
    })
}

fn mesh() -> Result<MeshDescription, Box<dyn std::error::Error>> {
    let channel: Channel = toml::from_str(
        "x = [0, 2.2]\ny = [0, 0.41]\nsize = 0.05\n[[bodies]]\nname = 'cylinder'\nsize = 0.012\n\
         shape = { kind = 'disc', centre = [0.2, 0.2], radius = 0.05 }\n\
         layers = { first = 0.004, growth = 1.5, count = 3 }",
    )?;
    Ok(channel.mesh()?)
}

fn write_mesh(path: &Path, mesh: &MeshDescription) -> Outcome {
    let mut npz = NpzWriter::create(path)?;
    npz.matrix("points", Mat::from_fn(mesh.points.len(), 2, |i, d| mesh.points[i][d]).as_ref())?;
    npz.matrix("triangles", rows(&mesh.triangles).as_ref())?;
    npz.matrix("quadrilaterals", rows(&mesh.quadrilaterals).as_ref())?;
    for boundary in &mesh.boundaries {
        npz.matrix(&format!("boundaries/{}", boundary.name), rows(&boundary.edges).as_ref())?;
    }
    Ok(npz.finish()?)
}

fn rows<const N: usize>(rows: &[[usize; N]]) -> Mat<f64> {
    Mat::from_fn(rows.len(), N, |i, k| rows[i][k] as f64)
}

fn write_tables(folder: &Path) -> Outcome {
    let times: Vec<f64> = (1..=600).map(|k| 0.005 * f64::from(k)).collect();
    let of = |f: fn(f64) -> f64| times.iter().map(|&t| f(t)).collect::<Vec<f64>>();
    let grown = |t: f64| 1.0 - (-2.0 * t).exp();
    let drag = of(|t| 3.19 + 0.03 * (2.0 * TAU * FREQUENCY * t).cos() + 9.0 * (-t / 0.02).exp());
    let lift: Vec<f64> =
        times.iter().map(|t| 0.98 * grown(*t) * (TAU * FREQUENCY * t).sin()).collect();
    let zero = vec![0.0; times.len()];
    let columns = [
        ("time", &times),
        ("bottom.fx", &zero),
        ("bottom.fy", &zero),
        ("cylinder.fx", &drag),
        ("cylinder.fy", &lift),
        ("cylinder.moment", &lift),
        ("cylinder.cd", &drag),
        ("cylinder.cl", &lift),
    ];
    write_columns(&folder.join("loads.csv"), &columns.map(|(name, x)| (name, &x[..])))?;
    let cfl = of(|t| 0.8 + 0.1 * (TAU * t).sin());
    let iterations = of(|t| 3.0 + (3.0 * (t / 0.3).fract()).round());
    let columns = [("time", &times), ("cfl", &cfl), ("iterations", &iterations)];
    write_columns(&folder.join("steps.csv"), &columns.map(|(name, x)| (name, &x[..])))?;
    let columns = [
        ("time", &times),
        ("wake.u", &drag),
        ("wake.v", &lift),
        ("wake.p", &zero),
        ("side.u", &lift),
        ("side.v", &zero),
        ("side.p", &lift),
        ("pressure_difference", &drag),
    ];
    write_columns(&folder.join("probes.csv"), &columns.map(|(name, x)| (name, &x[..])))?;
    Ok(())
}

fn write_basis(folder: &Path) -> Outcome {
    let record = crate::record::Record::open(folder.join("record"))?;
    let frame = record.frame("fixed")?;
    if record.len() < 2 {
        return Ok(());
    }
    let options = lumley_pod::Options::default();
    let basis =
        lumley_pod::auto(&frame, &lumley_pod::Identity::new(2 * FIXED[0] * FIXED[1]), &options)?;
    fs::create_dir(folder.join("basis"))?;
    Ok(BasisFile::save(&folder.join("basis").join("fixed.npz"), &basis)?)
}

/// A stream with a wake of vortices behind a cylinder that is `y` above its place: the first `components` of
/// u, v, p and vorticity at all nodes.
fn field(grid: &UniformGrid, time: f64, y: f64, components: usize) -> Vec<f64> {
    let values: Vec<[f64; 4]> = (0..grid.len()).map(|k| at(grid.point(k), time, y)).collect();
    (0..components).flat_map(|c| values.iter().map(move |v| v[c])).collect()
}

fn at([x, y]: Point, time: f64, lifted: f64) -> [f64; 4] {
    let profile = 6.0 * y * (0.41 - y) / (0.41 * 0.41);
    let shear = -6.0 * (0.41 - 2.0 * y) / (0.41 * 0.41);
    let (dx, dy) = (x - 0.2, y - 0.2 - lifted);
    let r2 = dx * dx + dy * dy;
    let layer = (-(r2.sqrt() - 0.05).max(0.0) / 0.01).exp();
    let mut flow = [
        profile * (1.0 - layer),
        0.0,
        1.2 * (1.1 - x / 2.0) + layer,
        shear - 60.0 * layer * dy.signum(),
    ];
    for k in -2..9_i32 {
        let centre =
            [0.35 + 0.8 * (time % (2.0 / FREQUENCY)) + 0.27 * f64::from(k), 0.2 + 0.04 * sign(k)];
        if centre[0] < 0.3 {
            continue;
        }
        let (dx, dy) = (x - centre[0], y - centre[1]);
        let width = 0.0012 + 0.0015 * (centre[0] - 0.3);
        let bump = (-(dx * dx + dy * dy) / width).exp();
        let strength = -sign(k) * 14.0 * (-0.6 * (centre[0] - 0.3)).exp();
        flow[0] -= 0.5 * strength * dy * bump;
        flow[1] += 0.5 * strength * dx * bump;
        flow[2] -= 0.4 * bump;
        flow[3] += strength * bump;
    }
    if r2 < 0.05 * 0.05 { [0.0; 4] } else { flow }
}

fn sign(k: i32) -> f64 {
    if k % 2 == 0 { 1.0 } else { -1.0 }
}
