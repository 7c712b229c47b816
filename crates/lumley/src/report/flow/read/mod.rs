//! A flow's report from the directory of its run, and from nothing else.
//!
//! | file | what the report takes from it |
//! |---|---|
//! | `manifest.json` | provenance |
//! | `summary.json` | every number |
//! | `case.toml` | the fluid, its boundaries, the bodies |
//! | `mesh.npz` | the mesh where it was at first |
//! | `loads.csv`, `probes.csv`, `steps.csv` | curves over time |
//! | `bodies.csv` | the motion of the bodies |
//! | `pictures` | the frame `picture` |
//! | `record` | the grid of the modes |
//! | `basis/fixed.npz` | the modes |
//!
//! All but the first three may be missing, and what they show is then left out.

mod bodies;
mod case;
mod mesh;
mod numbers;
mod record;
mod tables;

use super::rings::{is_of_bodies, rings};
use super::{BoundaryLoads, FlowReport, FlowSettings, History};
use crate::Error;
use crate::directory::DirectoryError;
use crate::manifest::Manifest;
use crate::report::Provenance;
use case::CaseView;
use lumley_fem::PlanarMesh;
use lumley_fom::signal::{Signal, Window};
use numbers::Numbers;
use std::fs;
use std::path::Path;
use tables::Table;

impl FlowReport {
    /// Everything that the report shows of the flow whose run is in `folder`.
    ///
    /// # Errors
    /// A file of the run that is missing or damaged.
    pub fn of_run(folder: &Path) -> Result<Self, Error> {
        let manifest = Manifest::read(folder).map_err(DirectoryError::from)?;
        let numbers = Numbers::read(folder)?;
        let text = text(&folder.join("case.toml"))?;
        let case = CaseView::parse(&folder.join("case.toml"), &text)?;
        let mesh = mesh::read(&folder.join("mesh.npz"))?;
        let settings = case.settings();
        let recorded = record::Recorded::read(folder)?;
        let bodies = bodies::read(folder, &case, &numbers)?;
        let (load_times, loads) = loads(folder, &numbers, &settings, mesh.as_ref())?;
        let history = History { residuals: numbers.residuals(), ..tables::history(folder)? };
        Ok(Self {
            name: manifest.case.clone(),
            modes: record::modes(folder, &recorded, &numbers)?,
            scene: recorded.scene(mesh),
            bodies,
            transfer: numbers.transfer(),
            settings,
            load_times,
            loads,
            pressure_difference: numbers.pressure_difference,
            history,
            work: numbers.work(),
            warnings: numbers.warnings,
            provenance: Provenance::of(&manifest, text),
        })
    }
}

fn text(path: &Path) -> Result<String, Error> {
    let unreadable = |source| DirectoryError::Io { action: "read", path: path.to_owned(), source };
    Ok(fs::read_to_string(path).map_err(unreadable)?)
}

/// Times and loads, the bodies first, the other boundaries behind them.
fn loads(
    folder: &Path,
    numbers: &Numbers,
    settings: &FlowSettings,
    mesh: Option<&PlanarMesh>,
) -> Result<(Vec<f64>, Vec<BoundaryLoads>), Error> {
    let [drag, lift] = if settings.reference.is_some() { ["cd", "cl"] } else { ["fx", "fy"] };
    let components = [drag, lift, "moment"];
    let table =
        Table::read(&folder.join("loads.csv"), |_, quantity| components.contains(&quantity))?;
    let rings = mesh.map(rings).unwrap_or_default();
    let order: Vec<&str> = mesh.map_or_else(Vec::new, |mesh| {
        mesh.topology().boundaries().iter().map(|b| b.name.as_str()).collect()
    });
    let of = |name: &str| {
        let place = order.iter().position(|n| *n == name);
        let is_body = place.is_some_and(|k| is_of_bodies(&rings, k));
        let [drag, lift, moment] = components.map(|quantity| table.column(name, quantity));
        let numbers = numbers.of_loads(name);
        let spectrum = numbers.window.filter(|_| is_body && numbers.periods > 0);
        let spectrum = spectrum.and_then(|window| spectrum_of(&table.times, &lift, window));
        BoundaryLoads { name: name.into(), is_body, numbers, drag, lift, moment, spectrum }
    };
    let mut loads: Vec<BoundaryLoads> = numbers.boundaries().map(of).collect();
    let place = |loads: &BoundaryLoads| order.iter().position(|name| *name == loads.name);
    loads.sort_by_key(|loads| (!loads.is_body, place(loads)));
    Ok((table.times, loads))
}

/// Frequencies and amplitudes of the lift over a window.
fn spectrum_of(
    times: &[f64],
    lift: &[f64],
    [start, end]: [f64; 2],
) -> Option<(Vec<f64>, Vec<f64>)> {
    let spectrum = Signal::new(times, lift).ok()?.spectrum(Window { start, end });
    Some((spectrum.frequencies, spectrum.amplitudes))
}
