//! From what a piston's case file says to what it means.

use super::PistonCase;
use super::raw::{InitialFlowSection, PistonFile};
use crate::case::ask::{Ask, Number, Transfers};
use crate::case::{CaseError, Document, Schedule};
use crate::format::csv;
use lumley_body::joint::Prismatic;
use lumley_fem::UniformGrid;
use lumley_fom::{InitialFlow, PistonParameters};
use lumley_rom::ReducedError;
use std::path::Path;

/// Most snapshots, and most steps between two.
const MOST: f64 = 1e9;
/// Most cells of a line: beyond it, a slip of the pen is likelier than a wish.
const MOST_CELLS: usize = 1_000_000;

/// Turns what was written into what is meant.
pub(in crate::case) fn check(
    document: &Document,
    file: PistonFile,
    name: &str,
    folder: &Path,
) -> Result<PistonCase, CaseError> {
    let ask = Ask(document);
    let piston = piston(&ask, &file, folder)?;
    let rom_schedule = schedule(&ask, &file, "rom.step", file.rom.step)?;
    let schedule = schedule(&ask, &file, "time.step", file.time.step)?;
    sizes(&ask, &file, &schedule)?;
    let nodes = file.mesh.cells.saturating_mul(file.mesh.degree).saturating_add(1);
    let Transfers { chosen: transfer, inverse_distance } = ask.transfer(&file.transfer, nodes)?;
    models(&ask, &file)?;
    Ok(PistonCase {
        name: name.to_owned(),
        piston,
        scheme: file.time.scheme,
        cells: file.mesh.cells,
        degree: file.mesh.degree,
        schedule,
        grid: UniformGrid::line(0.0, file.piston.domain_length, file.grid.nodes),
        transfer,
        inverse_distance,
        pod: ask.pod(&file.pod, schedule.snapshots())?,
        rom_schedule,
        integrator: file.rom.integrator,
        models: file.rom.models.clone(),
        file,
    })
}

fn piston(ask: &Ask, file: &PistonFile, folder: &Path) -> Result<PistonParameters, CaseError> {
    let p = &file.piston;
    ask.positive("piston.viscosity", p.viscosity, "m²/s")?;
    ask.positive("piston.mass", p.mass, "kg")?;
    ask.not_negative("piston.stiffness", p.stiffness, "N/m")?;
    ask.not_negative("piston.damping", p.damping, "N s/m")?;
    ask.not_negative("piston.force_factor", p.force_factor, "kg/m")?;
    ask.finite("piston.spring_length", p.spring_length, "m")?;
    ask.finite("piston.initial_velocity", p.initial_velocity, "m/s")?;
    ask.positive("piston.domain_length", p.domain_length, "m")?;
    let inside = format!("the piston inside the domain: 0 < X(0) < {} m", p.domain_length);
    let x = p.initial_position;
    ask.that(x > 0.0 && x < p.domain_length, "piston.initial_position", Number(x), &inside)?;
    Ok(PistonParameters {
        viscosity: p.viscosity,
        domain_length: p.domain_length,
        force_factor: p.force_factor,
        joint: Prismatic {
            mass: p.mass,
            stiffness: p.stiffness,
            damping: p.damping,
            rest_length: p.spring_length,
        },
        initial_position: p.initial_position,
        initial_velocity: p.initial_velocity,
        initial_flow: initial_flow(ask, &p.initial_flow, folder)?,
    })
}

fn initial_flow(
    ask: &Ask,
    flow: &InitialFlowSection,
    folder: &Path,
) -> Result<InitialFlow, CaseError> {
    let key = "piston.initial_flow";
    Ok(match flow {
        InitialFlowSection::Zero => InitialFlow::Zero,
        InitialFlowSection::Linear => InitialFlow::Linear,
        InitialFlowSection::Sine(amplitude) => {
            ask.finite(key, *amplitude, "m/s")?;
            InitialFlow::Sine(*amplitude)
        }
        InitialFlowSection::Table(name) => {
            let rows = csv::read_rows(&folder.join(name));
            let rows = rows.map_err(|e| ask.refuse(key, name, &format!("a table: {e}")))?;
            InitialFlow::Table(rows.into_iter().map(|(x, [u])| (x, u)).collect())
        }
    })
}

fn schedule(ask: &Ask, file: &PistonFile, key: &str, step: f64) -> Result<Schedule, CaseError> {
    let (end, interval) = (file.time.end, file.record.interval);
    ask.positive("record.interval", interval, "s")?;
    ask.positive("time.end", end, "s")?;
    ask.positive(key, step, "s")?;
    let most = format!("at most {MOST:e} times record.interval = {interval:?} s");
    ask.that(end / interval <= MOST, "time.end", Number(end), &most)?;
    let least = format!("at least {:e} times record.interval = {interval:?} s", 1.0 / MOST);
    ask.that(interval / step <= MOST, key, Number(step), &least)?;
    if Schedule::new(interval, interval, end).is_none() {
        let near = end / (end / interval).ceil();
        let expected = format!("a whole fraction of time.end = {end:?} s, such as {near:?}");
        return Err(ask.refuse("record.interval", Number(interval), &expected));
    }
    Schedule::new(step, interval, end).ok_or_else(|| {
        let near = interval / (interval / step).ceil();
        let expected =
            format!("a whole fraction of record.interval = {interval:?} s, such as {near:?}");
        ask.refuse(key, Number(step), &expected)
    })
}

fn models(ask: &Ask, file: &PistonFile) -> Result<(), CaseError> {
    let integrator = file.rom.integrator.validate();
    integrator.map_err(|e| ask.refuse("rom.integrator", "out of range", &e.to_string()))?;
    for (k, model) in file.rom.models.iter().enumerate() {
        model.validate().map_err(|error| match error {
            ReducedError::Parameter { name, value, unit, expected } => {
                let key = format!("rom.models.{k}.{name}");
                ask.refuse(&key, Number(value), &format!("a number in {unit}, {expected}"))
            }
            other => {
                ask.refuse(&format!("rom.models.{k}"), model.projection.name(), &other.to_string())
            }
        })?;
    }
    Ok(())
}

fn sizes(ask: &Ask, file: &PistonFile, schedule: &Schedule) -> Result<(), CaseError> {
    let (cells, degree, nodes) = (file.mesh.cells, file.mesh.degree, file.grid.nodes);
    ask.that((1..=2).contains(&degree), "mesh.degree", degree, "1 or 2")?;
    ask.that(
        (2..=MOST_CELLS).contains(&cells),
        "mesh.cells",
        cells,
        &format!("2 to {MOST_CELLS}"),
    )?;
    ask.that(nodes >= 3, "grid.nodes", nodes, "at least 3")?;
    // The record and two copies of it are in memory when models are compared.
    let memory = crate::manifest::memory();
    let fits = |count: usize| 24.0 * count as f64 * schedule.snapshots() as f64 <= memory;
    let most = format!("a record of at most a third of this machine's {:.0} GB", memory / 1e9);
    ask.that(fits(1), "record.interval", Number(schedule.interval), &most)?;
    ask.that(fits(cells.saturating_mul(degree)), "mesh.cells", cells, &most)?;
    ask.that(fits(nodes), "grid.nodes", nodes, &most)
}
